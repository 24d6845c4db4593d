// First and second derivatives of an oriented distance, against differences of the distance projected again.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/fit/quadratic_model.hpp"
#include "core/geometry/nearest/global_projection.hpp"
#include "tests/support/made_surface.hpp"
#include "tests/unit/core/brute_force.hpp"
#include "tools/design/image/image_writer.hpp"

namespace bladefit::testing {
namespace {

/// One measured point near a design, at a pose.
class Situation {
 public:
  Situation(const Surface& surface, const Vec3& r, double radius, std::mt19937_64& random)
      : surface_(surface), radius_(radius), frame_{Vec3::Zero(), surface.half_diagonal()} {
    const ImageHeader& h = surface.image().header();
    for (int k = 0; k < 3; ++k) frame_.pivot[k] = 0.5 * (h.box_min[k] + h.box_max[k]);
    pose_ = {rotation_exp(random_direction_in_space(random)), 30.0 * random_direction_in_space(random)};
    machine_ = pose_.rotation.transpose() * (r - pose_.translation);
    projection_ = project_global(surface_, {r, Vec3::Zero(), 0.0}, nullptr).nearest;
    foot_ = foot_of(surface_, projection_, radius_);
  }

  [[nodiscard]] const Projection& projection() const { return projection_; }
  [[nodiscard]] const Foot& foot() const { return foot_; }
  [[nodiscard]] const MotionFrame& frame() const { return frame_; }
  [[nodiscard]] Pose pose_at(const Vec6& x) const { return moved(pose_, x, frame_); }

  [[nodiscard]] DistanceRow row() const { return row_at(Vec6::Zero()); }
  [[nodiscard]] DistanceRow row_at(const Vec6& x) const {
    const Vec3 r = apply(pose_at(x), machine_);
    const Projection p = project_local(surface_, r, projection_.place);
    return distance_row(p, foot_of(surface_, p, radius_), r, x, frame_);
  }

  /// The distance after the motion x, its foot searched again.
  [[nodiscard]] double distance(const Vec6& x) const { return foot_of(surface_, moved_foot(x), radius_).distance; }

  /// All feet within `reach` [mm of x] of here are of one kind, so that the distance is smooth there. 24 directions.
  [[nodiscard]] bool smooth_within(double reach, const Vec6& x, std::mt19937_64& random) const {
    for (int k = 0; k < 24; ++k) {
      const Projection p = moved_foot(x + reach * random_direction_6(random));
      const bool same = p.converged && p.fixed_u == projection_.fixed_u && p.fixed_v == projection_.fixed_v;
      if (!same || (p.at.s - projection_.at.s).norm() > 0.2 * frame_.length) return false;
    }
    return true;
  }

  static Vec6 random_direction_6(std::mt19937_64& random) {
    Vec6 direction;
    direction << random_vector(random), random_vector(random);
    return direction.normalized();
  }

  /// Length over which the distance bends: differences are taken over a small part of it.
  [[nodiscard]] double bend_length() const {
    const double curvature = std::abs(strongest_curvature(surface_, projection_.place));
    const double free = std::abs(1.0 / curvature - std::abs(projection_.offset.norm()));
    return std::min({0.05 * frame_.length, 1.0 / curvature, free, off_surface()});
  }

 private:
  [[nodiscard]] Projection moved_foot(const Vec6& x) const {
    return project_local(surface_, apply(pose_at(x), machine_), projection_.place);
  }

  /// An edge's or corner's distance bends with the distance itself.
  [[nodiscard]] double off_surface() const {
    return foot_.kind == FootKind::interior ? frame_.length : projection_.offset.norm();
  }

  const Surface& surface_;
  double radius_;
  MotionFrame frame_;
  Pose pose_;
  Vec3 machine_;
  Projection projection_;
  Foot foot_;
};

void assert_gradient(const Situation& s) {
  const DistanceRow row = s.row();
  const double h = 2e-3 * s.bend_length();
  RC_ASSERT(row.distance == s.distance(Vec6::Zero()));
  for (int k = 0; k < 6; ++k) {
    const auto at = [&](double t) { return s.distance(t * h * Vec6::Unit(k)); };
    const double slope = (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * h);
    RC_ASSERT(std::abs(slope - row.gradient[k]) < 1e-5);
  }
}

/// Second differences along random directions, which see every element.
void assert_bend(const Situation& s, std::mt19937_64& random) {
  const DistanceRow row = s.row();
  const double length = s.bend_length(), h = 3e-3 * length;
  for (int k = 0; k < 8; ++k) {
    const Vec6 direction = Situation::random_direction_6(random);
    const auto at = [&](double t) { return s.distance(t * h * direction); };
    const double second = (16.0 * (at(1) + at(-1)) - (at(2) + at(-2)) - 30.0 * at(0)) / (12.0 * h * h);
    RC_ASSERT(std::abs(second - direction.dot(row.bend * direction)) < 1e-2 / length);
  }
  RC_ASSERT((row.bend - row.bend.transpose()).norm() <= 1e-9 * row.bend.norm());
}

/// Differences see neither a kink nor the end of an edge.
bool smooth(const Situation& s, const Vec6& x, double size, std::mt19937_64& random) {
  return s.projection().converged && s.bend_length() > 1e-4 * size &&
         s.smooth_within(0.02 * s.bend_length(), x, random);
}

/// A place inside, on an edge or at a corner of a patch.
SurfacePlace random_place_of(const Surface& surface, FootKind kind, std::mt19937_64& random) {
  SurfacePlace place = random_place(surface, random);
  if (kind == FootKind::interior) return place;
  const bool at_u = kind == FootKind::corner || random() % 2 == 0;
  if (at_u) place.u = static_cast<double>(random() % 2);
  if (!at_u || kind == FootKind::corner) place.v = static_cast<double>(random() % 2);
  surface.settle(place);
  return place;
}

void check_rows(const CompiledDesign& design, FootKind kind, const char* what) {
  int seen = 0;
  EXPECT_TRUE(rc::check(what, [&] {
    std::mt19937_64 random(*rc::gen::noShrink(rc::gen::arbitrary<std::uint64_t>()));
    const Surface& surface = design.surface();
    for (int k = 0; k < 5; ++k) {
      const SurfacePlace place = random_place_of(surface, kind, random);
      const SurfacePoint p = surface.evaluate(place);
      const Vec3 off = kind == FootKind::interior ? surface.normal(place, p) : random_direction_in_space(random);
      const double distance = uniform(random, 1e-3, 0.05) * design.size() * (random() % 2 == 0 ? 1.0 : -1.0);
      const Situation s(surface, p.s + distance * off, random() % 2 == 0 ? 0.0 : 1.5, random);
      if (s.foot().kind != kind || !smooth(s, Vec6::Zero(), design.size(), random)) continue;
      ++seen;
      assert_gradient(s);
      assert_bend(s, random);
    }
  }));
  EXPECT_GT(seen, 30) << what;
}

const CompiledDesign& sheet() {
  static const CompiledDesign design(write_image({random_surface({5, 1}, {5, 1}, true, 41)}, DesignUnit::mm, 1));
  return design;
}

TEST(DistanceRow, InteriorFootOnASheet) { check_rows(sheet(), FootKind::interior, "interior, sheet"); }
TEST(DistanceRow, InteriorFootOnABlade) {
  check_rows(reference_design("dtmb4119"), FootKind::interior, "interior, blade");
}
TEST(DistanceRow, EdgeFootOnASheet) { check_rows(sheet(), FootKind::edge, "edge, sheet"); }
TEST(DistanceRow, CornerFootOnASheet) { check_rows(sheet(), FootKind::corner, "corner, sheet"); }
TEST(DistanceRow, EdgeFootOnABlade) { check_rows(reference_design("dtmb4119"), FootKind::edge, "edge, blade"); }
TEST(DistanceRow, CornerFootOnABlade) { check_rows(reference_design("dtmb4119"), FootKind::corner, "corner, blade"); }

/// Away from the reference pose the gradient is right to the second order of the turn.
RC_GTEST_PROP(DistanceRow, GradientAwayFromTheReference, ()) {
  std::mt19937_64 random(*rc::gen::noShrink(rc::gen::arbitrary<std::uint64_t>()));
  const Surface& surface = sheet().surface();
  const SurfacePlace place = random_place(surface, random);
  const SurfacePoint p = surface.evaluate(place);
  const Situation s(surface, p.s + 0.5 * surface.normal(place, p), 0.0, random);
  const double turn = 1e-3;
  Vec6 x;
  x << turn * s.frame().length * random_direction_in_space(random), Vec3::Zero();
  RC_PRE(s.foot().kind == FootKind::interior && smooth(s, x, sheet().size(), random));
  const DistanceRow row = s.row_at(x);
  const double h = 2e-3 * s.bend_length();
  for (int k = 0; k < 6; ++k) {
    const auto at = [&](double t) { return s.distance(x + t * h * Vec6::Unit(k)); };
    const double slope = (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * h);
    RC_ASSERT(std::abs(slope - row.gradient[k]) < turn * turn);
  }
}

/// Rows with made-up numbers.
DistanceRow random_row(std::mt19937_64& random) {
  DistanceRow row;
  row.distance = uniform(random, -1, 1);
  for (int i = 0; i < 6; ++i) {
    row.gradient[i] = uniform(random, -1, 1);
    for (int j = 0; j <= i; ++j) row.bend(i, j) = row.bend(j, i) = uniform(random, -0.1, 0.1);
  }
  return row;
}

/// Wherever it was taken, a row gives back its distance there, and its gradient.
RC_GTEST_PROP(QuadraticModel, ReproducesARowWhereItWasTaken, ()) {
  std::mt19937_64 random(*rc::gen::noShrink(rc::gen::arbitrary<std::uint64_t>()));
  const DistanceRow row = random_row(random);
  const Vec6 x = Vec6::NullaryExpr([&] { return uniform(random, -0.5, 0.5); });
  QuadraticModel model;
  model.add(row, x, 1.0, loss_terms(Loss::none, 1.0, row.distance));
  RC_ASSERT(std::abs(model.value_at(x) - 0.5 * row.distance * row.distance) < 1e-13);
  const Vec6 slope = model.gradient + (model.gauss + model.bend) * x;
  RC_ASSERT((slope - row.distance * row.gradient).norm() < 1e-13);
  RC_ASSERT(model.count == 1U);
}

/// Shifted it is the same function: in value and gradient after any motion, whole after a translation.
RC_GTEST_PROP(QuadraticModel, ShiftedIsTheSameFunction, ()) {
  std::mt19937_64 random(*rc::gen::noShrink(rc::gen::arbitrary<std::uint64_t>()));
  const MotionFrame frame{Vec3(10, 20, 30), 100.0};
  const double turn = random() % 2 == 0 ? 0.0 : 0.02;
  QuadraticModel model;
  model.reference = {rotation_exp(random_direction_in_space(random)), Vec3(1, 2, 3)};
  for (int k = 0; k < 10; ++k) {
    const DistanceRow row = random_row(random);
    model.add(row, Vec6::Zero(), 1.0, loss_terms(Loss::none, 1.0, row.distance));
  }
  Vec6 shift, y;
  shift << turn * frame.length * random_direction_in_space(random), random_direction_in_space(random);
  y << random_direction_in_space(random), random_direction_in_space(random);
  const Pose other = moved(model.reference, shift, frame);
  const QuadraticModel there = shifted(model, other, frame);
  const auto direct = [&](double step) {
    return model.value_at(motion_between(model.reference, moved(other, step * y, frame), frame));
  };
  const double size = model.half_square + model.gradient.norm() + model.gauss.norm() + model.bend.norm();
  RC_ASSERT(std::abs(there.half_square - model.value_at(shift)) < 1e-11 * size);
  constexpr double kStep = 1e-3;
  const double slope = (direct(kStep) - direct(-kStep)) / (2.0 * kStep);
  if (direct(0.0) > 1e-3 * size) RC_ASSERT(std::abs(there.gradient.dot(y) - slope) < 1e-8 * size);
  if (turn == 0.0) RC_ASSERT(std::abs(there.value_at(0.1 * y) - direct(0.1)) < 1e-4 * size);
  RC_ASSERT(there.count == model.count);
}

}  // namespace
}  // namespace bladefit::testing

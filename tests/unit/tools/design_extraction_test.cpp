#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "tests/unit/tools/design_fixtures.hpp"
#include "tests/unit/tools/design_image_reading.hpp"
#include "tools/design/image/image_writer.hpp"
#include "tools/design/image/tree_builder.hpp"
#include "tools/design/nurbs/bezier_extraction.hpp"

namespace bladefit {
namespace {

using testing::DirectionPlan;
using testing::evaluate_span;
using testing::evaluate_surface;
using testing::open_image;
using testing::random_surface;

/// Largest distance between image and surface at `tries` random parameters of random spans, over the size.
double extraction_error(const NurbsSurface& surface, const DesignImage& image, int tries, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  double error = 0;
  for (int k = 0; k < tries; ++k) {
    const ImageSpan& span =
        image.spans()[std::uniform_int_distribution<std::size_t>(0, image.spans().size() - 1)(random)];
    const ImagePatch& patch = image.patches()[span.patch];
    const double* u = &image.breaks()[patch.first_break_u + span.iu];
    const double* v = &image.breaks()[patch.first_break_v + span.iv];
    const double s = unit(random);
    const double t = unit(random);
    const Eigen::Vector3d expected = evaluate_surface(surface, u[0] + s * (u[1] - u[0]), v[0] + t * (v[1] - v[0]));
    error = std::max(error, (evaluate_span(image, span, s, t).point - expected).norm());
  }
  return error / testing::image_size(image);
}

std::vector<std::byte> compile_checked(NurbsSurface& surface) {
  EXPECT_TRUE(check_surface(surface, "test").empty());
  return write_image({surface}, DesignUnit::mm, 1);
}

RC_GTEST_PROP(DesignExtraction, AnySplineEqualsDeBoor, ()) {
  const auto plan = [] {
    DirectionPlan made;
    made.degree = *rc::gen::inRange(1, 10);
    made.spans = *rc::gen::inRange(1, 6);
    made.clamped = *rc::gen::arbitrary<bool>();
    made.sub_range = *rc::gen::arbitrary<bool>();
    made.multiple_knots = *rc::gen::arbitrary<bool>();
    return made;
  };
  const DirectionPlan plan_u = plan();
  const DirectionPlan plan_v = plan();
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  NurbsSurface surface = random_surface(plan_u, plan_v, *rc::gen::arbitrary<bool>(), seed);
  const std::vector<std::byte> bytes = compile_checked(surface);
  DesignImage image;
  RC_ASSERT(DesignImage::open(bytes, image) == Status::ok);
  RC_ASSERT(extraction_error(surface, image, 40, seed) < 1e-13);
}

TEST(DesignExtraction, EveryDegreeEqualsDeBoor) {
  for (int degree = 1; degree <= 9; ++degree) {
    NurbsSurface surface = random_surface({degree, 3, true, false, true}, {10 - degree, 4}, true, 7);
    const std::vector<std::byte> bytes = compile_checked(surface);
    EXPECT_LT(extraction_error(surface, open_image(bytes), 200, 1), 1e-13) << "degree " << degree;
  }
}

TEST(DesignExtraction, HundredsOfSpans) {
  NurbsSurface surface = random_surface({3, 520}, {3, 2}, false, 11);
  const std::vector<std::byte> bytes = compile_checked(surface);
  const DesignImage image = open_image(bytes);
  EXPECT_EQ(image.patches()[0].spans_u, 520U);
  EXPECT_LT(extraction_error(surface, image, 2000, 2), 1e-13);
}

TEST(DesignExtraction, UnclampedSubRangeKeepsTheEnds) {
  NurbsSurface surface = random_surface({3, 5, false, true}, {4, 3, false, true}, true, 5);
  const std::vector<std::byte> bytes = compile_checked(surface);
  const DesignImage image = open_image(bytes);
  const Eigen::Vector3d first = evaluate_span(image, image.spans().front(), 0, 0).point;
  const Eigen::Vector3d last = evaluate_span(image, image.spans().back(), 1, 1).point;
  EXPECT_LT((first - evaluate_surface(surface, 0, 0)).norm(), 1e-12);
  EXPECT_LT((last - evaluate_surface(surface, 1, 1)).norm(), 1e-12);
}

TEST(DesignExtraction, EqualWeightsMakeAPolynomialPatch) {
  NurbsSurface surface = random_surface({}, {}, false, 3);
  std::fill(surface.weights.begin(), surface.weights.end(), 2.5);
  const std::vector<std::byte> bytes = compile_checked(surface);
  const DesignImage image = open_image(bytes);
  EXPECT_EQ(image.patches()[0].rational, 0U);
  EXPECT_LT(extraction_error(surface, image, 100, 3), 1e-13);
}

TEST(DesignExtraction, NearlyEqualKnotsMakeNoSliver) {
  NurbsSurface surface = random_surface({3, 4}, {3, 4}, false, 3);
  surface.u.knots[5] = std::nextafter(surface.u.knots[4], 10.0);
  EXPECT_EQ(check_surface(surface, "test").size(), 1U);
  const std::vector<std::byte> bytes = write_image({surface}, DesignUnit::mm, 1);
  const DesignImage image = open_image(bytes);
  EXPECT_EQ(image.patches()[0].spans_u, 3U);
  EXPECT_LT(extraction_error(surface, image, 100, 3), 1e-13);
}

TEST(DesignExtraction, ConesHoldEveryNormal) {
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    const int degree = 1 + static_cast<int>(seed % 9);
    const NurbsSurface surface = random_surface({degree, 6, true, false, true}, {3, 6}, seed % 2 == 0, seed);
    const int sign = seed % 3 == 0 ? -1 : 1;
    const std::vector<std::byte> bytes = write_image({surface}, DesignUnit::mm, sign);
    testing::check_cones(open_image(bytes), 8);
  }
}

TEST(DesignExtraction, ConeOfAFlatSheetIsNarrow) {
  NurbsSurface surface = random_surface({2, 2}, {2, 2}, true, 1);
  for (Eigen::Vector3d& point : surface.control_points) point.z() = 4;
  for (const int sign : {1, -1}) {
    const std::vector<std::byte> bytes = write_image({surface}, DesignUnit::mm, sign);
    for (const ImageSpan& span : open_image(bytes).spans()) {
      EXPECT_NEAR(span.cone_axis[2], sign, 1e-12);
      EXPECT_GT(span.cone_cosine, 1 - 1e-12);
    }
  }
}

TEST(DesignExtraction, DegenerateSpanHasNoCone) {
  NurbsSurface surface = random_surface({2, 1}, {2, 1}, false, 1);
  for (Eigen::Vector3d& point : surface.control_points) point = Eigen::Vector3d(point.x(), 0, 0);
  const std::vector<std::byte> bytes = write_image({surface}, DesignUnit::mm, 1);
  EXPECT_EQ(open_image(bytes).spans()[0].cone_cosine, -1);
}

std::vector<Box> scattered_boxes(std::size_t count, double spread) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-100, 100);
  std::vector<Box> boxes(count);
  for (Box& box : boxes) {
    for (int axis = 0; axis < 3; ++axis) {
      box.min[axis] = std::exp(spread * place(random) / 100.0);
      box.max[axis] = box.min[axis] + 1;
    }
  }
  return boxes;
}

/// Levels of the tree, and how often each leaf stands in it.
int depth_of(const std::vector<ImageNode>& nodes, std::size_t node, std::vector<int>& met) {
  int below = 0;
  for (const std::uint32_t child : nodes[node].child) {
    if (child == kNoChild) continue;
    if ((child & kLeafChild) != 0) {
      ++met[child & ~kLeafChild];
    } else {
      below = std::max(below, depth_of(nodes, child, met));
    }
  }
  return 1 + below;
}

/// However the boxes lie: each leaf once, and no deeper than an image may be.
TEST(DesignExtraction, TreeHoldsEveryLeafAndIsNotDeep) {
  for (const std::size_t count : {1U, 2U, 4U, 5U, 1000U}) {
    for (const double spread : {0.01, 1.0, 10.0, 300.0}) {
      const std::vector<Box> boxes = scattered_boxes(count, spread);
      const std::vector<ImageNode> nodes = build_bounding_tree(boxes, box_around(boxes));
      std::vector<int> met(count, 0);
      EXPECT_LE(depth_of(nodes, 0, met), count <= 4 ? 1 : 26) << count << " boxes, spread " << spread;
      EXPECT_EQ(met, std::vector<int>(count, 1));
    }
  }
}

TEST(DesignExtraction, SameDesignSameBytes) {
  const NurbsSurface surface = random_surface({3, 5}, {3, 5}, true, 9);
  EXPECT_EQ(write_image({surface, surface}, DesignUnit::inch, -1),
            write_image({surface, surface}, DesignUnit::inch, -1));
}

TEST(DesignExtraction, TurningTheSideEqualsCompilingForIt) {
  const NurbsSurface surface = random_surface({3, 5}, {3, 5}, true, 9);
  std::vector<std::byte> turned = write_image({surface}, DesignUnit::mm, 1);
  set_outward(turned, -1);
  const DesignImage image = open_image(turned);
  EXPECT_EQ(image.header().outward, -1);
  testing::check_cones(image, 4);
}

}  // namespace
}  // namespace bladefit

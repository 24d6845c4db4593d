#include "tests/bench/bench_case.hpp"
#include "core/geometry/nearest/global_projection.hpp"
#include "tests/support/json_file.hpp"
#include "tools/design/read_design.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>

namespace bladefit::bench {
namespace {

using testing::ReferenceCase;

void normalise(SurfaceDirection& d) {
  for (double& knot : d.knots) knot = (knot - d.start) / (d.end - d.start);
  const auto first = static_cast<std::size_t>(d.degree), last = static_cast<std::size_t>(d.control_points);
  d.start = 0.0;
  d.end = 1.0;
  if (d.knots[first] != 0.0 || d.knots[last] != 1.0) throw std::runtime_error("the design's surface is not used whole");
}

UnitSurface unit_surface(const ReferenceCase& c) {
  DesignFile file = read_design(c.folder / "design.igs");
  if (file.surfaces.size() != 1) throw std::runtime_error("a design of one patch is needed");
  normalise(file.surfaces.front().u);
  normalise(file.surfaces.front().v);
  return file.surfaces.front();
}

FitProblem problem_of(const std::vector<ProbePoint>& probes, bool use_approach) {
  FitProblem problem;
  for (const ProbePoint& probe : probes) {
    problem.points.emplace_back(probe.position.data());
    if (use_approach) problem.approaches.emplace_back(probe.approach.data());
  }
  return problem;
}

/// Smooth over the blade, about 0.05 mm.
double form_error(double u, double v) {
  using std::numbers::pi;
  return 0.03 * std::sin(2 * pi * (1.5 * u + 0.3)) * std::cos(pi * (1.2 * v + 0.1)) +
         0.02 * std::sin(2 * pi * (0.7 * v - 0.4 * u));
}

}  // namespace

BenchDesign::BenchDesign(const std::string& name)
    : reference(testing::read_case(name)),
      design(testing::reference_design(name)),
      surface(unit_surface(reference)),
      textbook(surface),
      peers(all_peers(surface, reference.normal_sign)) {}

FitProblem at_pose(const BenchDesign& design, const FitCase& fit, const Pose& pose) {
  FitProblem problem = fit.problem;
  problem.start = pose;
  problem.feet.clear();
  problem.weights.clear();
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    ProjectionQuery query;
    query.point = apply(pose, problem.points[i]);
    if (!problem.approaches.empty()) query.approach = pose.rotation * problem.approaches[i];
    const SurfacePlace place = project_global(design.design.surface(), query, nullptr).nearest.place;
    problem.feet.push_back({place.u, place.v});
    const Region region = region_at(fit.config.tolerance, 0, place.u, place.v);
    problem.weights.push_back(region == Region::leading_edge ? 1.0 : fit.config.ratio);
  }
  return problem;
}

FitCase measured_case(const BenchDesign& design, const std::string& name) {
  const ReferenceCase& c = design.reference;
  FitCase fit;
  fit.name = name;
  fit.probes = testing::points_of(c, "full");
  fit.config = testing::config_of(c, fit.probes.size());
  fit.problem = problem_of(fit.probes, c.use_approach);
  const nlohmann::json truth = testing::read_json(c.folder / "truth" / "full.json");
  const nlohmann::json& pose = truth.at("least_squares").at("pose");
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) fit.least_squares.rotation(i, j) = pose.at("rotation").at(i).at(j);
    fit.least_squares.translation[i] = pose.at("translation").at(i).get<double>() * c.mm_per_unit;
  }
  fit.problem.feet = at_pose(design, fit, fit.least_squares).feet;
  fit.tolerance_mm = truth.at("min_tolerance").at("epsilon").get<double>() * c.mm_per_unit;
  return fit;
}

FitCase made_case(const BenchDesign& design, const std::string& name, std::size_t count) {
  constexpr double kNoise = 0.005;  // [mm]
  const Pose motion{rotation_exp(Vec3(0.006, -0.008, 0.009)), Vec3(1.2, -1.0, 1.5)};
  std::mt19937_64 random(20240607);
  std::normal_distribution<double> normal;
  FitCase fit;
  fit.name = name;
  fit.known = false;
  fit.config = testing::config_of(design.reference, count);
  std::vector<Parameters> places;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = testing::uniform(random, 0.06, 0.94), v = testing::uniform(random, 0.06, 0.94);
    const TextbookPoint p = design.textbook.evaluate({u, v});
    const Eigen::Vector3d outward = design.reference.normal_sign * p.s_u.cross(p.s_v).normalized();
    const Vec3 r = p.s + (form_error(u, v) + kNoise * normal(random)) * outward;
    const Vec3 machine = motion.rotation.transpose() * (r - motion.translation);
    ProbePoint probe;
    probe.sequence = static_cast<std::uint32_t>(i + 1);
    for (std::size_t k = 0; k < 3; ++k) probe.position[k] = machine[static_cast<Eigen::Index>(k)];
    fit.probes.push_back(probe);
    places.push_back({u, v});
  }
  fit.problem = problem_of(fit.probes, false);
  fit.problem.feet = std::move(places);
  return fit;
}

}  // namespace bladefit::bench

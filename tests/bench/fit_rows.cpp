// Whole fits: least squares with the feet known and from cold, and min_tolerance from the least-squares pose on.

#include <cstdio>
#include <limits>
#include <stdexcept>

#include "tests/bench/fit_check.hpp"

namespace bladefit::bench {
namespace {

/// A pose of least squares may be off by this share of the size of the points, a tolerance by this share of itself.
constexpr double kPoseLimit = 1e-8, kToleranceLimit = 1e-8;
const Effort kFitEffort{15, 3, 1.5};

/// One solver's pose, and how it comes to it.
struct Solver {
  std::string name;
  std::function<void()> prepare;
  std::function<Pose()> solve;
  Pose pose;
};

std::vector<Timing> timed(std::vector<Solver>& solvers) {
  std::vector<Contestant> contestants;
  for (Solver& solver : solvers) {
    contestants.push_back({solver.name, solver.prepare, [&solver] { solver.pose = solver.solve(); }});
  }
  return timed_in_turn(contestants, kFitEffort);
}

/// bladefit on a case.
class OurFit {
 public:
  OurFit(const BenchDesign& design, const FitCase& fit, FitMode mode)
      : probes_(fit.probes), localizer_(design.design.image(), config_of(fit, mode)) {}

  void stage_all() {
    localizer_->reset();
    for (const ProbePoint& probe : probes_) {
      if (localizer_->stage(probe) < Status::ok) throw std::runtime_error("point refused");
    }
    localizer_->conclude();
  }

  /// One sweep over all points. False when it was the last.
  bool sweep() {
    status_ = localizer_->refine(static_cast<std::uint32_t>(probes_.size()));
    return status_ == Status::more_work;
  }

  /// A fit that does not converge has no pose: nothing is near to it.
  Pose refined() {
    while (sweep()) {
    }
    Pose pose = localizer_->fit().pose;
    if (status_ != Status::ok) pose.translation.setConstant(std::numeric_limits<double>::infinity());
    return pose;
  }

 private:
  static LocalizerConfig config_of(const FitCase& fit, FitMode mode) {
    LocalizerConfig config = fit.config;
    config.mode = mode;
    config.regions = RegionPolicy::fixed;
    config.further_starts = 0;  // as the peers, which go down from one start
    return config;
  }

  const std::vector<ProbePoint>& probes_;
  testing::OwnedLocalizer localizer_;
  Status status_ = Status::ok;
};

std::vector<Solver> peers_for(const BenchDesign& design, std::function<Pose(const FitProblem&)> Peer::*task,
                              const FitProblem& problem) {
  std::vector<Solver> solvers;
  for (const Peer& peer : design.peers) {
    if (peer.*task) solvers.push_back({peer.name, {}, [&peer, task, &problem] { return (peer.*task)(problem); }, {}});
  }
  return solvers;
}

Row row_for(const FitCase& fit, const char* task, const Solver& solver, const Timing& timing, const Timing& base) {
  Row row = row_of(timing, base, 1.0);
  row.task = task;
  row.design = fit.name;
  row.solver = solver.name;
  row.count = fit.problem.points.size();
  return row;
}

/// Rows of least squares, not yet checked; the poses go to `poses` in the same order.
std::vector<Row> least_squares_rows(const BenchDesign& design, const FitCase& fit, bool cold,
                                    std::vector<Pose>& poses) {
  const char* task = cold ? "least squares, cold" : "least squares, feet known";
  std::fprintf(stderr, "  %s, %s\n", task, fit.name.c_str());
  FitProblem problem = fit.problem;
  if (cold) problem.feet.clear();
  OurFit ours(design, fit, FitMode::least_squares);
  std::vector<Solver> solvers = peers_for(design, &Peer::least_squares, problem);
  Solver bladefit{"bladefit", {}, [&ours] { return ours.refined(); }, {}};
  if (cold) {
    bladefit.solve = [&ours] {
      ours.stage_all();
      return ours.refined();
    };
  } else {
    bladefit.prepare = [&ours] { ours.stage_all(); };
  }
  solvers.insert(solvers.begin(), bladefit);
  const std::vector<Timing> timings = timed(solvers);
  std::vector<Row> rows;
  for (std::size_t s = 0; s < solvers.size(); ++s) {
    rows.push_back(row_for(fit, task, solvers[s], timings[s], timings[0]));
    poses.push_back(solvers[s].pose);
  }
  return rows;
}

void check_poses(const FitCase& fit, const std::vector<Pose>& poses, std::vector<Row>& rows) {
  Vec3 low = fit.problem.points.front(), high = low;
  for (const Vec3& point : fit.problem.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].error_mm = displacement(fit.problem, poses[k], fit.least_squares);
    rows[k].wrong = !(rows[k].error_mm <= kPoseLimit * (high - low).norm());
  }
}

/// Sweeps that bladefit's least squares takes: the same come first in every other mode.
int least_squares_sweeps(const BenchDesign& design, const FitCase& fit) {
  OurFit ours(design, fit, FitMode::least_squares);
  ours.stage_all();
  int sweeps = 1;
  while (ours.sweep()) ++sweeps;
  return sweeps;
}

std::vector<Row> tolerance_rows(const BenchDesign& design, FitCase& fit) {
  const char* task = "min_tolerance after least squares";
  std::fprintf(stderr, "  %s, %s\n", task, fit.name.c_str());
  const FitProblem problem = at_pose(design, fit, fit.least_squares);
  const int sweeps = least_squares_sweeps(design, fit);
  OurFit ours(design, fit, FitMode::min_tolerance);
  std::vector<Solver> solvers = peers_for(design, &Peer::min_tolerance, problem);
  const auto prepare = [&ours, sweeps] {
    ours.stage_all();
    for (int k = 0; k < sweeps; ++k) ours.sweep();
  };
  solvers.insert(solvers.begin(), {"bladefit", prepare, [&ours] { return ours.refined(); }, {}});
  const std::vector<Timing> timings = timed(solvers);
  std::vector<double> tolerances;
  for (const Solver& solver : solvers) tolerances.push_back(tolerance_at(design, fit, solver.pose, problem.weights));
  if (fit.tolerance_mm == 0.0) fit.tolerance_mm = least(tolerances);
  std::vector<Row> rows;
  for (std::size_t s = 0; s < solvers.size(); ++s) {
    rows.push_back(row_for(fit, task, solvers[s], timings[s], timings[0]));
    rows.back().error_mm = tolerances[s] - fit.tolerance_mm;
    rows.back().wrong = !(std::abs(rows.back().error_mm) <= kToleranceLimit * fit.tolerance_mm);
  }
  return rows;
}

}  // namespace

std::vector<Row> fit_rows(const BenchDesign& design, FitCase fit) {
  std::vector<Pose> poses;
  std::vector<Row> rows = least_squares_rows(design, fit, false, poses);
  const std::vector<Row> cold = least_squares_rows(design, fit, true, poses);
  rows.insert(rows.end(), cold.begin(), cold.end());
  if (!fit.known) fit.least_squares = best_of(design, fit, poses);
  check_poses(fit, poses, rows);
  const std::vector<Row> tolerance = tolerance_rows(design, fit);
  rows.insert(rows.end(), tolerance.begin(), tolerance.end());
  return rows;
}

}  // namespace bladefit::bench

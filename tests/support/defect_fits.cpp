#include "tests/support/defect_fits.hpp"

#include <cmath>
#include <ctime>
#include <limits>

#include "tests/support/owned_localizer.hpp"

namespace bladefit::testing {
namespace {

double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Returns the time that refine() took.
double run(Localizer& fit, const std::vector<ProbePoint>& points, WayIn way, Status& status) {
  Verdict verdict;
  for (const ProbePoint& point : points) {
    (void)(way == WayIn::batch ? fit.stage(point) : fit.push(point, verdict));
  }
  const double began = cpu_s();
  fit.conclude();
  status = refine_fully(fit);
  return cpu_s() - began;
}

Pose least_squares_pose(const CompiledDesign& design, LocalizerConfig config, const std::vector<ProbePoint>& points) {
  config.mode = FitMode::least_squares;
  OwnedLocalizer fit(design.image(), config);
  Status status;
  (void)run(*fit, points, WayIn::batch, status);
  return fit->fit().pose;
}

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", x);
  return text;
}

/// Sums and maxima of distances that are proven to 1e-10 of the design's half diagonal.
bool close(double a, double b, double rounding) { return std::abs(a - b) <= 1e-7 * std::abs(b) + rounding; }

void check(const ModeValue& objective, double rounding, DefectFit& out) {
  const FitReport& report = out.report;
  const FitMode mode = objective.config().mode;
  const auto complain = [&out](const std::string& what) {
    out.complaint += (out.complaint.empty() ? "" : "; ") + what;
  };
  if (mode != FitMode::constrained && !close(out.value, report.mode_value_mm, rounding))
    complain("told " + number(report.mode_value_mm) + ", is " + number(out.value));
  if (out.value > out.least_squares_value * (1.0 + 1e-9) + rounding && report.status != FitStatus::infeasible)
    complain("value " + number(out.value) + " above " + number(out.least_squares_value) + " at the least-squares pose");
  if (mode == FitMode::constrained && report.status == FitStatus::converged &&
      objective.largest_ratio(report.pose) > 1.0 + 1e-7)
    complain("a bound is broken: " + number(objective.largest_ratio(report.pose)));
  if (report.stationarity > 1e-8) complain("stationarity " + number(report.stationarity));
}

}  // namespace

bool DefectFit::answered() const {
  return report.status == FitStatus::converged || report.status == FitStatus::infeasible;
}

std::vector<ProbePoint> counted(const Localizer& fit, const std::vector<ProbePoint>& points) {
  std::vector<ProbePoint> out;
  Verdict verdict;
  for (const ProbePoint& point : points) {
    if (fit.verdict_of(point.sequence, verdict) == Status::ok && verdict.state != PointState::rejected)
      out.push_back(point);
  }
  return out;
}

DefectFit fit_defects(const CompiledDesign& design, const LocalizerConfig& config,
                      const std::vector<ProbePoint>& points, WayIn way) {
  DefectFit out;
  OwnedLocalizer fit(design.image(), config);
  const double began = cpu_s();
  out.refine_s = run(*fit, points, way, out.status);
  out.push_s = cpu_s() - began - out.refine_s;
  out.report = fit->fit();
  out.least_squares = least_squares_pose(design, config, points);
  out.counted = counted(*fit, points);
  const ModeValue objective(design, config, out.counted);
  for (const ProbePoint& point : out.counted) {
    Verdict verdict;
    (void)fit->verdict_of(point.sequence, verdict);
    out.weights.push_back(objective.weight(verdict.region));
  }
  const bool unmet = config.mode == FitMode::constrained && objective.largest_ratio(out.least_squares) > 1.0;
  out.least_squares_value = unmet ? std::numeric_limits<double>::infinity() : objective.at(out.least_squares);
  out.value = objective.at(out.report.pose);
  if (out.answered()) check(objective, 1e-9 * design.size(), out);
  return out;
}

}  // namespace bladefit::testing

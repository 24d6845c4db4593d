#include "tools/fit_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>

namespace bladefit {
namespace {

/// A localizer in memory of its own.
class OwnedLocalizer {
 public:
  OwnedLocalizer(const DesignImage& design, LocalizerConfig config, std::size_t points) {
    config.capacity = static_cast<std::uint32_t>(std::max<std::size_t>(points, 6));
    const std::size_t size = Localizer::memory_required(config);
    memory_.reset(static_cast<std::byte*>(::operator new(size, std::align_val_t(64))));
    const Status status = Localizer::create({memory_.get(), size}, design, config, localizer_);
    if (status != Status::ok) throw DesignError(fmt::format("the fit cannot start: {}", status_text(status)));
  }
  Localizer* operator->() const { return localizer_; }

 private:
  struct Release {
    void operator()(std::byte* p) const { ::operator delete(p, std::align_val_t(64)); }
  };
  std::unique_ptr<std::byte, Release> memory_;
  Localizer* localizer_ = nullptr;
};

void stage_all(OwnedLocalizer& localizer, const std::vector<ProbePoint>& points, const std::string& name) {
  for (const ProbePoint& point : points) {
    if (const Status status = localizer->stage(point); status != Status::ok)
      throw DesignError(fmt::format("{}: point {} cannot be used: {}", name, point.sequence, status_text(status)));
  }
}

std::vector<Verdict> verdicts_of(const OwnedLocalizer& localizer, const std::vector<ProbePoint>& points) {
  std::vector<Verdict> verdicts(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (localizer->verdict_of(points[i].sequence, verdicts[i]) != Status::ok)
      throw std::logic_error("a staged point is missing");
  }
  return verdicts;
}

class Summing {
 public:
  explicit Summing(BeforeAfter& sums) : sums_(sums) {}
  ~Summing() {
    if (sums_.count == 0) return;
    sums_.rms_before = std::sqrt(square_before_ / sums_.count);
    sums_.rms_after = std::sqrt(square_after_ / sums_.count);
  }
  Summing(const Summing&) = delete;
  Summing& operator=(const Summing&) = delete;
  void add(double before, double after) {
    ++sums_.count;
    square_before_ += before * before;
    square_after_ += after * after;
    sums_.max_before = std::max(sums_.max_before, std::abs(before));
    sums_.max_after = std::max(sums_.max_after, std::abs(after));
  }

 private:
  BeforeAfter& sums_;
  double square_before_ = 0, square_after_ = 0;
};

void sum_up(FitResult& result, const std::vector<Verdict>& before) {
  Summing all(result.all), leading_edge(result.leading_edge), rest(result.rest);
  for (std::size_t i = 0; i < result.verdicts.size(); ++i) {
    const Verdict& after = result.verdicts[i];
    if (after.state == PointState::rejected) continue;
    all.add(before[i].foot.distance, after.foot.distance);
    (after.region == Region::leading_edge ? leading_edge : rest).add(before[i].foot.distance, after.foot.distance);
  }
}

std::string status_of(const FitReport& report) {
  switch (report.status) {
    case FitStatus::converged:
      return "converged";
    case FitStatus::underdetermined:
      return "underdetermined";
    case FitStatus::infeasible:
      return "infeasible";
    case FitStatus::tracking:
      break;
  }
  return "not_converged";
}

}  // namespace

FitResult fit_points(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points,
                     const std::string& name) {
  OwnedLocalizer localizer(design, plan.localizer, points.size());
  stage_all(localizer, points, name);
  const std::vector<Verdict> before = verdicts_of(localizer, points);
  localizer->conclude();
  // The refinement has its own cap on sweeps, so this ends.
  while (localizer->refine(static_cast<std::uint32_t>(points.size())) == Status::more_work) {
  }
  FitResult result;
  result.report = localizer->fit();
  result.status = status_of(result.report);
  result.verdicts = verdicts_of(localizer, points);
  sum_up(result, before);
  result.aberrant = aberrant_points(result.report, plan.localizer, result.verdicts, points);
  if (result.all.count < 6) {
    throw DesignError(
        fmt::format("{}: {} points count in the fit, at least 6 are needed ({} of {} are outside the window or at an "
                    "edge); probe more points",
                    name, result.all.count, points.size() - result.all.count, points.size()));
  }
  return result;
}

FitResult result_of(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points,
                    const FitReport& report, std::vector<Verdict> verdicts) {
  OwnedLocalizer start(design, plan.localizer, points.size());
  stage_all(start, points, "the session");
  FitResult result;
  result.report = report;
  result.status = status_of(report);
  result.verdicts = std::move(verdicts);
  sum_up(result, verdicts_of(start, points));
  result.aberrant = aberrant_points(report, plan.localizer, result.verdicts, points);
  return result;
}

int exit_code_of(const FitResult& result) {
  if (result.report.status == FitStatus::infeasible) return 1;
  const bool out = std::any_of(result.verdicts.begin(), result.verdicts.end(),
                               [](const Verdict& v) { return v.state == PointState::out; });
  return out ? 1 : 0;
}

}  // namespace bladefit

// The time of each push() over a whole stream: median and p99.9.

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "tests/bench/fit_check.hpp"

namespace bladefit::bench {
namespace {

constexpr int kStreams = 15;
constexpr double kPoseLimit = 1e-8;  // share of the size of the points, after refine()

/// Least and median time of each push over the streams: the least leaves out what other programs did meanwhile.
struct Pushes {
  std::vector<double> least_s, median_s;
  Timing stream;  ///< of whole streams, for the calibration
};

Pushes pushed(testing::OwnedLocalizer& localizer, const std::vector<ProbePoint>& probes) {
  std::vector<std::vector<double>> times(probes.size());
  const auto stream = [&] {
    localizer->reset();
    Verdict verdict;
    for (std::size_t k = 0; k < probes.size(); ++k) {
      const double begin = processor_seconds();
      const Status status = localizer->push(probes[k], verdict);
      times[k].push_back(processor_seconds() - begin);
      if (!succeeded(status)) throw std::runtime_error("point refused");
    }
  };
  Pushes pushes;
  pushes.stream = timed_in_turn({{"bladefit", {}, stream}}, {kStreams, kStreams, 0.0}).front();
  for (const std::vector<double>& of_one : times) {
    pushes.least_s.push_back(least(of_one));
    pushes.median_s.push_back(median(of_one));
  }
  return pushes;
}

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

}  // namespace

std::vector<Row> push_rows(const BenchDesign& design, const FitCase& fit) {
  std::fprintf(stderr, "  push\n");
  testing::OwnedLocalizer localizer(design.design.image(), fit.config);
  const Pushes pushes = pushed(localizer, fit.probes);
  localizer->conclude();
  const bool converged = testing::refine_fully(*localizer) == Status::ok;
  const double size = displacement(fit.problem, Pose{}, Pose{Mat3::Zero(), Vec3::Zero()});
  std::vector<Row> rows;
  for (const double q : {0.5, 0.999}) {
    Row row = row_of(pushes.stream, pushes.stream, 1.0);
    row.task = q == 0.5 ? "push, median" : "push, p99.9";
    row.design = fit.name;
    row.solver = "bladefit";
    row.count = fit.probes.size();
    row.median_s = quantile(pushes.median_s, q);
    row.least_s = quantile(pushes.least_s, q);
    row.error_mm = displacement(fit.problem, localizer->fit().pose, fit.least_squares);
    row.wrong = !converged || !(row.error_mm <= kPoseLimit * size);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace bladefit::bench

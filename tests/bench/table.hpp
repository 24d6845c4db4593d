#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/bench/timing.hpp"

namespace bladefit::bench {

/// One line of the table: one solver at one task.
struct Row {
  std::string task, design, solver;
  std::size_t count = 0;  ///< queries of a nearest-point task, points of a fit
  double median_s = 0, least_s = 0;
  int repetitions = 0;
  double ratio = std::numeric_limits<double>::quiet_NaN();  ///< time / bladefit's; of bladefit itself: none
  double error_mm = 0;                                      ///< what it measures is said in the task's note
  int misses = -1;     ///< answers that are wrong beyond the limit; -1: the task has one answer only
  bool wrong = false;  ///< error_mm is above what the task allows
  double calibration_ns = 0, calibration_spread = 0;

  [[nodiscard]] bool ours() const { return solver.starts_with("bladefit"); }
};

/// A row of `timing`, `runs` being the units in one repetition. `base` is bladefit's timing.
Row row_of(const Timing& timing, const Timing& base, double runs);

enum class TableForm { text, markdown };

std::string table_of(const std::vector<Row>& rows, TableForm form);

/// What instructions.sh counted, one line a figure.
std::string instructions_of(const nlohmann::json& counts, TableForm form);

nlohmann::json json_of(const std::vector<Row>& rows);

}  // namespace bladefit::bench

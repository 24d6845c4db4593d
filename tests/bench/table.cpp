#include "tests/bench/table.hpp"

#include <fmt/format.h>

#include <array>

namespace bladefit::bench {
namespace {

std::string time_text(double seconds) {
  if (seconds < 1e-6) return fmt::format("{:.0f} ns", seconds * 1e9);
  if (seconds < 1e-3) return fmt::format("{:.3g} us", seconds * 1e6);
  if (seconds < 1.0) return fmt::format("{:.3g} ms", seconds * 1e3);
  return fmt::format("{:.3g} s", seconds);
}

std::string ratio_text(const Row& row) {
  if (std::isnan(row.ratio)) return "";
  return fmt::format("{:.{}f}", row.ratio, row.ratio < 10.0 ? 2 : 0);
}

using Cells = std::array<std::string, 9>;

Cells cells_of(const Row& row) {
  return {fmt::format("{}, {}", row.task, row.design),
          row.solver,
          time_text(row.median_s),
          time_text(row.least_s),
          ratio_text(row),
          fmt::format("{:.0e}{}", row.error_mm, row.wrong ? " WRONG" : ""),
          row.misses < 0 ? "" : fmt::format("{}/{}", row.misses, row.count),
          fmt::format("{}", row.repetitions),
          fmt::format("{:.2f} ns {:.0f} %", row.calibration_ns, 100.0 * row.calibration_spread)};
}

const Cells kHeads = {"task, design", "solver", "median", "minimum",    "ratio",
                      "error [mm]",   "misses", "runs",   "calibration"};

/// "SISL 19", and what is wrong with its answers.
std::string beside(const Row& row) {
  std::string text = fmt::format("{} **{}**", row.solver, ratio_text(row));
  if (row.misses > 0) text += fmt::format(" ({} of {} missed)", row.misses, row.count);
  if (row.wrong && row.misses <= 0) text += fmt::format(" (wrong by {:.0e} mm)", row.error_mm);
  return text;
}

/// One line a task: bladefit's figures, then the ratios of the others.
std::string markdown_of(const std::vector<Row>& rows) {
  std::string text =
      "| task, design | bladefit, median (minimum) | error [mm] | calibration | time of others / bladefit's |\n"
      "|---|---|---|---|---|";
  std::string task;
  bool alone = true;
  for (const Row& row : rows) {
    const Cells cells = cells_of(row);
    if (cells[0] != task) {
      if (!task.empty()) text += " |";
      text += fmt::format("\n| {} | {} ({}) | {} | {} |", cells[0], cells[2], cells[3], cells[5], cells[8]);
      alone = true;
    } else {
      text += fmt::format("{}{}", alone ? " " : "; ", beside(row));
      alone = false;
    }
    task = cells[0];
  }
  return text + " |\n";
}

/// The task is a heading, the rest one line a solver.
std::string text_of(const std::vector<Row>& rows) {
  constexpr const char* kLine = "  {:<38}{:>10}{:>10}{:>8}{:>14}{:>10}{:>6}  {}\n";
  const auto line = [&](const Cells& c) {
    return fmt::format(fmt::runtime(kLine), c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8]);
  };
  std::string text = line(kHeads), task;
  for (const Row& row : rows) {
    const Cells cells = cells_of(row);
    if (cells[0] != task) text += fmt::format("{}\n", cells[0]);
    task = cells[0];
    text += line(cells);
  }
  return text;
}

}  // namespace

Row row_of(const Timing& timing, const Timing& base, double runs) {
  Row row;
  row.median_s = median(timing.seconds) / runs;
  row.least_s = least(timing.seconds) / runs;
  row.repetitions = static_cast<int>(timing.seconds.size());
  if (&timing != &base) row.ratio = ratio(timing, base);
  row.calibration_ns = 1e9 * median(timing.calibration);
  row.calibration_spread = spread(timing.calibration);
  return row;
}

std::string table_of(const std::vector<Row>& rows, TableForm form) {
  return form == TableForm::markdown ? markdown_of(rows) : text_of(rows);
}

std::string instructions_of(const nlohmann::json& counts, TableForm form) {
  const bool markdown = form == TableForm::markdown;
  std::string text = markdown ? "| instructions | |\n|---|---:|\n" : "instructions\n";
  for (const auto& [name, count] : counts.items()) {
    text += fmt::format(fmt::runtime(markdown ? "| {} | {} |\n" : "  {:<38}{:>12}\n"), name, count.get<long>());
  }
  return text;
}

nlohmann::json json_of(const std::vector<Row>& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const Row& row : rows) {
    nlohmann::json entry = {{"task", row.task},
                            {"design", row.design},
                            {"solver", row.solver},
                            {"count", row.count},
                            {"median_s", row.median_s},
                            {"minimum_s", row.least_s},
                            {"repetitions", row.repetitions},
                            {"error_mm", row.error_mm},
                            {"wrong", row.wrong},
                            {"calibration_ns", row.calibration_ns},
                            {"calibration_spread", row.calibration_spread}};
    if (!std::isnan(row.ratio)) entry["ratio"] = row.ratio;
    if (row.misses >= 0) entry["misses"] = row.misses;
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace bladefit::bench

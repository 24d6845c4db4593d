#include "tools/reproduce/thesis_tables.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "drivers/text/units.hpp"
#include "tools/results/words.hpp"

namespace bladefit {
namespace {

/// Printed changes that are off the printed distances by more than this are no rounding [per cent].
constexpr double kRoundingOfChanges = 0.15;

constexpr const char* kSmallest = "bladefit, smallest";
constexpr const char* kOptimum = "bladefit, optimum";

const char* const kCpuNote =
    "CPU times of bladefit are measured here, in ms, from the points to the optimum with every foot proven; those of "
    "the thesis are of a machine of 1.6 MFLOPS.";
const char* const kMotionNote =
    "The stand-in blades lie otherwise on their machine than the thesis' did: motions can be compared in size only.";
const char* const kConstraintNote =
    "thesis: the tolerance at which, raised by steps, its optimiser first met every bound, and some motion that does. "
    "smallest: the least tolerance that any motion meets, found at once and proven, and the motion that meets it. "
    "optimum: least squares within 1.1 times that tolerance (six digits). Elsewhere 10 times the tolerance. Before: at "
    "the unconstrained optimum.";

double change(double before, double after) { return 100.0 * (after - before) / before; }

TableColumn before_column() { return {"rms_before", "RMS Distance", "Before (in)", Figure::length}; }
TableColumn after_column() { return {"rms_after", "RMS Distance", "After (in)", Figure::length}; }
TableColumn change_column() { return {"change_percent", "Per Cent", "Change", Figure::percent}; }
TableColumn time_column() { return {"cpu_s", "Computation", "Time (CPU)", Figure::time}; }

std::vector<TableColumn> motion_columns() {
  return {{"tx", "Translation", "tx (in)", Figure::motion},
          {"ty", "", "ty", Figure::motion},
          {"tz", "", "tz", Figure::motion},
          {"phi", "Rotation", "phi (rad)", Figure::motion},
          {"theta", "", "theta", Figure::motion},
          {"psi", "", "psi", Figure::motion}};
}

std::vector<double> motion_values(const PrintedMotion& m) { return {m.tx, m.ty, m.tz, m.phi, m.theta, m.psi}; }

std::vector<double> motion_values(const Pose& pose) {
  const EulerAngles e = euler_angles(pose.rotation);
  const Vec3 t = pose.translation / kMmPerInch;
  return {t.x(), t.y(), t.z(), e.phi, e.theta, e.psi};
}

std::vector<double> joined(std::vector<double> left, const std::vector<double>& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

ReportTable table_of(const ThesisStudy& study, int number, const char* kind) {
  ReportTable table;
  table.number = number;
  table.label = "Table " + roman(number);
  table.title =
      fmt::format("{} {}{} Propeller", kind, study.three_patches ? "Three Patches from " : "", study.propeller);
  table.over = "Number";
  table.head = "of Points";
  return table;
}

/// Adds a row under the number of points of the thesis' row.
template <class Figures>
void add(ReportTable& table, const ThesisStudy& study, const Figures& row, const char* source,
         std::vector<double> values) {
  const bool thesis = source == kThesisSource;
  table.rows.push_back({std::to_string(row.points), source, thesis ? "" : study.data, row.subset, std::move(values)});
}

/// Says of each printed change of the thesis that does not follow from its printed distances what would.
void check_changes(ReportTable& table) {
  std::size_t before = 0;
  while (table.columns[before].key != "rms_before") ++before;
  for (const TableRow& row : table.rows) {
    if (row.source != kThesisSource || row.label == "mean" || !std::isfinite(row.values[before])) continue;
    const double printed = row.values[before + 2], own = change(row.values[before], row.values[before + 1]);
    if (std::abs(printed - own) <= kRoundingOfChanges) continue;
    table.notes.push_back(fmt::format("{} points: the thesis prints {:+.1f} per cent; its distances give {:+.1f}.",
                                      row.label, printed, own));
  }
}

/// Mean of a column over the rows of `source`, that of all points left out. Nothing where there is no such row.
std::optional<double> mean_of(const ReportTable& table, std::size_t column, const std::string& source) {
  double sum = 0;
  int count = 0;
  for (const TableRow& row : table.rows) {
    if (row.source != source || row.subset == "full") continue;
    sum += row.values[column];
    ++count;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

/// Adds the mean of the changes: what the thesis' text says, and those of our rows of the sets it is over.
void add_means(ReportTable& table, const ThesisStudy& study, double thesis) {
  std::size_t column = 0;
  while (table.columns[column].key != "change_percent") ++column;
  const auto row = [&](const std::string& source, double value) {
    std::vector<double> values(table.columns.size(), kNotGiven);
    values[column] = value;
    return TableRow{"mean", source, source == kThesisSource ? "" : study.data, "", values};
  };
  std::vector<TableRow> means{row(kThesisSource, thesis)};
  for (const char* source : {"bladefit", kSmallest, kOptimum}) {
    if (const auto mean = mean_of(table, column, source)) means.push_back(row(source, *mean));
  }
  const double own = mean_of(table, column, kThesisSource).value_or(thesis);
  if (std::abs(own - thesis) > kRoundingOfChanges) {
    table.notes.push_back(
        fmt::format("mean: the text of the thesis says {:+.1f} per cent; its rows give {:+.1f}.", thesis, own));
  }
  table.rows.insert(table.rows.end(), means.begin(), means.end());
}

void note_status(ReportTable& table, int points, const Result& fit) {
  if (fit.status != word_of(FitStatus::converged))
    table.notes.push_back(fmt::format("{} points: bladefit: {}.", points, fit.status));
}

ReportTable rms_table(const ThesisStudy& study, const std::vector<UnconstrainedPair>& rows) {
  ReportTable table =
      table_of(study, study.rms_table, "RMS Distances and Computation Times for Unconstrained Localization of");
  table.columns = {before_column(), after_column(), change_column(), time_column()};
  for (const auto& [thesis, ours] : rows) {
    add(table, study, thesis, kThesisSource,
        {thesis.rms_before, thesis.rms_after, thesis.change_percent, thesis.cpu_s});
    const Result& fit = ours.least_squares.result;
    add(table, study, thesis, "bladefit",
        {fit.all.rms_before / kMmPerInch, fit.all.rms_after / kMmPerInch, change(fit.all.rms_before, fit.all.rms_after),
         ours.least_squares.fit.cpu_s});
    note_status(table, thesis.points, fit);
  }
  check_changes(table);
  add_means(table, study, study.mean.unconstrained);
  if (study.rms_note != nullptr) table.notes.emplace_back(study.rms_note);
  table.notes.emplace_back(kCpuNote);
  return table;
}

ReportTable motion_table(const ThesisStudy& study, const std::vector<UnconstrainedPair>& rows) {
  ReportTable table =
      table_of(study, study.motion_table, "Translations and Rotations for Unconstrained Localization of");
  table.columns = motion_columns();
  for (const auto& [thesis, ours] : rows) {
    if (std::isinf(thesis.motion.tx)) continue;
    add(table, study, thesis, kThesisSource, motion_values(thesis.motion));
    add(table, study, thesis, "bladefit", motion_values(ours.least_squares.result.pose));
  }
  if (study.motion_note != nullptr) table.notes.emplace_back(study.motion_note);
  table.notes.emplace_back(kMotionNote);
  return table;
}

/// One of our two constrained fits.
struct Bounded {
  const char* source;
  const Result& fit;
  double tolerance_mm, cpu_s;
};

std::vector<Bounded> bounded_fits(const SubsetRuns& runs) {
  std::vector<Bounded> fits;
  if (runs.smallest) fits.push_back({kSmallest, runs.smallest->result, runs.smallest_mm, runs.smallest->fit.cpu_s});
  if (runs.optimum) fits.push_back({kOptimum, runs.optimum->result, runs.epsilon_mm, runs.optimum->fit.cpu_s});
  return fits;
}

ReportTable region_table(const ThesisStudy& study, const std::vector<ConstrainedPair>& rows, bool leading_edge) {
  ReportTable table = table_of(study, leading_edge ? study.leading_edge_table : study.rest_table,
                               "RMS Distances and Computation Times for Constrained Localization of");
  table.title += leading_edge ? " (Leading Edge)" : " (Non-Leading Edge)";
  table.columns = {{"constraint", leading_edge ? "Leading Edge" : "Non-Leading Edge", "Constraint (in)", Figure::bound},
                   before_column(),
                   after_column(),
                   change_column(),
                   time_column()};
  const auto region = leading_edge ? &Result::leading_edge : &Result::rest;
  for (const auto& [thesis, ours] : rows) {
    const RegionFigures& printed = leading_edge ? thesis.leading_edge : thesis.rest;
    add(table, study, thesis, kThesisSource,
        {printed.constraint, printed.rms_before, printed.rms_after, printed.change_percent, thesis.cpu_s});
    const double before = (ours.least_squares.result.*region).rms_after;
    for (const auto& [source, fit, tolerance, cpu_s] : bounded_fits(ours)) {
      const double after = (fit.*region).rms_after;
      add(table, study, thesis, source,
          {(leading_edge ? 1.0 : 10.0) * tolerance / kMmPerInch, before / kMmPerInch, after / kMmPerInch,
           change(before, after), cpu_s});
      note_status(table, thesis.points, fit);
    }
  }
  check_changes(table);
  add_means(table, study, leading_edge ? study.mean.leading_edge : study.mean.rest);
  table.notes.emplace_back(kConstraintNote);
  table.notes.emplace_back(kCpuNote);
  table.notes.emplace_back(
      "Times of the thesis begin at the unconstrained optimum; ours contain that fit, and the optimum's also the "
      "smallest tolerance.");
  return table;
}

ReportTable constrained_motion_table(const ThesisStudy& study, const std::vector<ConstrainedPair>& rows) {
  ReportTable table = table_of(study, study.constrained_motion_table,
                               "Translations, Rotations and Maximum Distances for Constrained Localization of");
  table.columns = motion_columns();
  table.columns.push_back({"max_leading_edge", "Leading Edge", "Max Distance (in)", Figure::length});
  table.columns.push_back({"max_rest", "Non-Leading Edge", "Max Distance (in)", Figure::length});
  for (const auto& [thesis, ours] : rows) {
    add(table, study, thesis, kThesisSource,
        joined(motion_values(thesis.motion), {thesis.max_leading_edge, thesis.max_rest}));
    for (const auto& [source, fit, tolerance, cpu_s] : bounded_fits(ours)) {
      add(table, study, thesis, source,
          joined(motion_values(fit.pose), {fit.leading_edge.max_after / kMmPerInch, fit.rest.max_after / kMmPerInch}));
    }
  }
  if (study.constrained_motion_note != nullptr) table.notes.emplace_back(study.constrained_motion_note);
  table.notes.emplace_back(kMotionNote);
  return table;
}

ReportTable global_table(const ThesisStudy& study, const std::vector<ConstrainedPair>& rows) {
  ReportTable table =
      table_of(study, study.global_table, "Global Localization Effects for Constrained Localization of");
  table.columns = {before_column(), after_column(), change_column()};
  for (const auto& [thesis, ours] : rows) {
    add(table, study, thesis, kThesisSource, {thesis.global_before, thesis.global_after, thesis.global_change_percent});
    const double before = ours.least_squares.result.all.rms_after;
    for (const auto& [source, fit, tolerance, cpu_s] : bounded_fits(ours)) {
      add(table, study, thesis, source,
          {before / kMmPerInch, fit.all.rms_after / kMmPerInch, change(before, fit.all.rms_after)});
    }
  }
  check_changes(table);
  add_means(table, study, study.mean.global);
  table.notes.emplace_back(kConstraintNote);
  return table;
}

}  // namespace

std::string roman(int number) {
  constexpr std::array<std::pair<int, const char*>, 5> marks{{{10, "X"}, {9, "IX"}, {5, "V"}, {4, "IV"}, {1, "I"}}};
  std::string text;
  for (const auto& [value, mark] : marks) {
    for (; number >= value; number -= value) text += mark;
  }
  return text;
}

std::vector<ReportTable> thesis_tables(const ThesisStudy& study, const std::set<int>& wanted,
                                       const std::vector<UnconstrainedPair>& unconstrained,
                                       const std::vector<ConstrainedPair>& constrained) {
  std::vector<ReportTable> tables;
  if (wanted.count(study.rms_table) > 0) tables.push_back(rms_table(study, unconstrained));
  if (wanted.count(study.motion_table) > 0) tables.push_back(motion_table(study, unconstrained));
  if (wanted.count(study.leading_edge_table) > 0) tables.push_back(region_table(study, constrained, true));
  if (wanted.count(study.rest_table) > 0) tables.push_back(region_table(study, constrained, false));
  if (wanted.count(study.constrained_motion_table) > 0) tables.push_back(constrained_motion_table(study, constrained));
  if (wanted.count(study.global_table) > 0) tables.push_back(global_table(study, constrained));
  return tables;
}

}  // namespace bladefit

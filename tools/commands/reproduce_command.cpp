#include "tools/commands/reproduce_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "tools/commands/progress_line.hpp"
#include "tools/files/output_file.hpp"
#include "tools/reproduce/start_costs.hpp"
#include "tools/reproduce/table_json.hpp"
#include "tools/reproduce/table_text.hpp"
#include "tools/reproduce/thesis_tables.hpp"
#include "tools/reproduce/validity_checks.hpp"

namespace bladefit {
namespace {

struct ReproduceFlags {
  std::string data, json;
  std::vector<std::string> tables;
};

constexpr const char* kReproduceDescription =
    "Run the tables of the thesis on stand-in data and print both side by side";

constexpr const char* kReproduceHelp = R"(
R. A. Jinkerson, Constrained and Unconstrained Localization for Automated Inspection of Marine Propellers (MIT 1991),
chapter 5, has sixteen tables. Each is run here by this solver, in the thesis' form, its figures above ours:
  I, II        ARL fan blade, unconstrained: RMS distances and times; motions
  III to VI    the same, constrained: leading edge, rest of the blade, motions and largest distances, whole blade
  VII to XII   the same tables for the PNSY submarine blade
  XIII, XIV    ARL blade in three patches, unconstrained; XV, XVI the PNSY blade
The thesis' own measurements are not public: the blades and points are stand-ins of the same kind, size and number, so
figures agree in size, not in digits. With all tables come the thesis' checks of validity, and what the ways of
`localize --starts` cost.

  bladefit reproduce                        everything
  bladefit reproduce --table III --table 9  the leading edges of both blades
  bladefit reproduce --json figures.json    every number in full as well; - writes JSON to standard output

Exit codes: 0 done, 2 wrong use or bad data, 3 a file cannot be read or written.)";

int table_number(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  for (int number = 1; number <= kThesisTables; ++number) {
    if (text == roman(number) || text == std::to_string(number)) return number;
  }
  throw ToolError(fmt::format("--table {}: there is no such table; give 1 to 16 or I to XVI", text));
}

std::set<int> wanted_tables(const ReproduceFlags& flags) {
  std::set<int> wanted;
  for (const std::string& text : flags.tables) wanted.insert(table_number(text));
  for (int number = 1; flags.tables.empty() && number <= kThesisTables; ++number) wanted.insert(number);
  return wanted;
}

/// tests/data in `start` or a folder above it; empty where there is none.
std::filesystem::path find_upwards(std::filesystem::path start) {
  for (;;) {
    std::error_code ignored;
    if (std::filesystem::exists(start / "tests/data/arl_fan/case.json", ignored)) return start / "tests/data";
    if (start == start.parent_path()) return {};
    start = start.parent_path();
  }
}

/// The data of the sources one stands in, or else of those that this program was built in.
std::filesystem::path default_folder() {
  std::error_code error;
  std::filesystem::path folder = find_upwards(std::filesystem::current_path(error));
  if (folder.empty()) folder = find_upwards(std::filesystem::read_symlink("/proc/self/exe", error).parent_path());
  if (folder.empty()) throw ToolError("tests/data: is neither here nor above the program; give --data FOLDER");
  return folder;
}

std::filesystem::path data_folder(const ReproduceFlags& flags) {
  const std::filesystem::path folder = flags.data.empty() ? default_folder() : std::filesystem::path(flags.data);
  for (const ThesisStudy& study : thesis_studies()) {
    if (std::filesystem::exists(folder / study.data / "case.json")) continue;
    throw ToolError(fmt::format("{}: has no {}/case.json; give --data the folder tests/data of the bladefit sources",
                                folder.string(), study.data));
  }
  return folder;
}

/// The figures must not take the place of a file of the data.
void check_figures(const ReproduceFlags& flags, const std::filesystem::path& folder) {
  if (flags.json.empty() || flags.json == "-") return;
  std::error_code none;
  for (const ThesisStudy& study : thesis_studies()) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / study.data, none))
      refuse_overwriting(flags.json, "data", entry.path());
  }
}

bool has_one_of(const std::set<int>& wanted, std::initializer_list<int> numbers) {
  return std::any_of(numbers.begin(), numbers.end(), [&](int n) { return wanted.count(n) > 0; });
}

bool wants_unconstrained(const ThesisStudy& study, const std::set<int>& wanted) {
  return has_one_of(wanted, {study.rms_table, study.motion_table});
}

bool wants_constrained(const ThesisStudy& study, const std::set<int>& wanted) {
  return has_one_of(wanted,
                    {study.leading_edge_table, study.rest_table, study.constrained_motion_table, study.global_table});
}

/// Counts the fits for the progress line.
class Rounds {
 public:
  explicit Rounds(const std::set<int>& wanted) {
    for (const ThesisStudy& study : thesis_studies()) {
      if (wants_unconstrained(study, wanted)) all_ += study.unconstrained.size();
      if (wants_constrained(study, wanted)) all_ += study.constrained.size();
    }
    line_.begin("fitting the tables");
  }

  /// Another fit begins.
  void next() { line_.count(begun_++, all_); }

 private:
  ProgressLine line_;
  std::size_t begun_ = 0, all_ = 0;
};

std::vector<ReportTable> tables_of(const ThesisStudy& study, const StudyCase& data, const std::set<int>& wanted,
                                   Rounds& rounds) {
  std::vector<UnconstrainedPair> unconstrained;
  if (wants_unconstrained(study, wanted)) {
    for (const UnconstrainedFigures& row : study.unconstrained) {
      rounds.next();
      unconstrained.push_back({row, run_subset(data, row.subset, false)});
    }
  }
  std::vector<ConstrainedPair> constrained;
  if (wants_constrained(study, wanted)) {
    for (const ConstrainedFigures& row : study.constrained) {
      rounds.next();
      constrained.push_back({row, run_subset(data, row.subset, true)});
    }
  }
  return thesis_tables(study, wanted, unconstrained, constrained);
}

bool has_any(const ThesisStudy& study, const std::set<int>& wanted) {
  return wants_unconstrained(study, wanted) || wants_constrained(study, wanted);
}

std::vector<ReportTable> all_tables(const ReproduceFlags& flags) {
  const std::set<int> wanted = wanted_tables(flags);
  const std::filesystem::path folder = data_folder(flags);
  check_figures(flags, folder);
  Rounds rounds(wanted);
  std::vector<ReportTable> tables;
  ReportTable checks = check_table(), costs = start_cost_table();
  for (const ThesisStudy& study : thesis_studies()) {
    if (!has_any(study, wanted)) continue;
    const StudyCase data = read_study_case(folder / study.data);
    const std::vector<ReportTable> own = tables_of(study, data, wanted, rounds);
    tables.insert(tables.end(), own.begin(), own.end());
    if (!flags.tables.empty() || study.three_patches) continue;
    add_validity_checks(data, study.unconstrained.front().subset, checks);
    add_start_costs(data, "full", costs);
  }
  if (flags.tables.empty()) tables.insert(tables.end(), {checks, costs});
  return tables;
}

/// Prints the tables; a note that several have is told below the first of them.
void print_tables(std::vector<ReportTable> tables, std::FILE* words) {
  std::set<std::string> told;
  for (ReportTable& table : tables) {
    std::erase_if(table.notes, [&told](const std::string& note) { return !told.insert(note).second; });
    fmt::print(words, "{}\n", table_text(table));
  }
}

void run_reproduce(const ReproduceFlags& flags) {
  const std::vector<ReportTable> tables = all_tables(flags);
  const bool json_on_stdout = flags.json == "-";
  std::FILE* words = json_on_stdout ? stderr : stdout;
  print_tables(tables, words);
  if (flags.json.empty()) return;
  write_output(flags.json, tables_json(tables));
  if (!json_on_stdout) fmt::print("Written: {}\n", flags.json);
}

}  // namespace

void add_reproduce_command(CLI::App& app, int& exit_code) {
  const auto flags = std::make_shared<ReproduceFlags>();
  CLI::App* command = app.add_subcommand("reproduce", kReproduceDescription);
  command->footer(kReproduceHelp);
  command->add_option("--data", flags->data, "Folder of the stand-in data (default: tests/data of the sources)")
      ->type_name("FOLDER");
  command
      ->add_option("--table", flags->tables, "Number of a table, 1 to 16 or I to XVI; may be repeated (default: all)")
      ->type_name("N")
      ->allow_extra_args(false);
  command->add_option("--json", flags->json, "Write every number here; - writes to standard output")
      ->type_name("OUT.json");
  command->callback([flags, &exit_code] {
    run_reproduce(*flags);
    exit_code = 0;
  });
}

}  // namespace bladefit

// The table beside the peers. Prints it, writes it as JSON, and fails where an answer of bladefit is wrong.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>

#include "tests/bench/bench_case.hpp"
#include "tests/support/json_file.hpp"

namespace bladefit::bench {
namespace {

constexpr std::size_t kMadePoints = 10000;

void append(std::vector<Row>& rows, const std::vector<Row>& more) { rows.insert(rows.end(), more.begin(), more.end()); }

std::vector<Row> rows_of(const std::string& name) {
  std::fprintf(stderr, "%s\n", name.c_str());
  const BenchDesign design(name);
  std::vector<Row> rows = nearest_rows(design);
  const FitCase measured = measured_case(design, name);
  append(rows, fit_rows(design, measured));
  if (name == "arl_fan") append(rows, fit_rows(design, made_case(design, "arl_fan made 10,000", kMadePoints)));
  append(rows, push_rows(design, measured));
  return rows;
}

std::string wrong_answers(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) {
    if (row.ours() && row.wrong) text += fmt::format("wrong: {}, {}: {} mm\n", row.task, row.design, row.error_mm);
  }
  return text;
}

int measure(const std::string& json_path, const std::string& instructions_path, TableForm form) {
  nlohmann::json instructions = nlohmann::json::object();
  if (!instructions_path.empty()) instructions = testing::read_json(instructions_path);
  std::vector<Row> rows;
  for (const char* name : {"arl_fan", "dtmb4119"}) append(rows, rows_of(name));
  std::ofstream(json_path) << nlohmann::json{{"rows", json_of(rows)}, {"instructions", instructions}}.dump(1) << "\n";
  fmt::print("{}\n{}", table_of(rows, form), instructions_of(instructions, form));
  const std::string wrong = wrong_answers(rows);
  fmt::print(stderr, "{}", wrong);
  return wrong.empty() ? 0 : 1;
}

}  // namespace
}  // namespace bladefit::bench

int main(int argc, char** argv) {
  using namespace bladefit::bench;
  CLI::App app("bladefit beside its peers");
  std::string json = "peers.json", instructions;
  bool markdown = false;
  app.add_option("--json", json, "file to write");
  app.add_option("--instructions", instructions, "what instructions.sh counted, to be shown beside");
  app.add_flag("--markdown", markdown, "print tables in markdown");
  CLI11_PARSE(app, argc, argv);
  try {
    return measure(json, instructions, markdown ? TableForm::markdown : TableForm::text);
  } catch (const std::exception& error) {
    fmt::print(stderr, "peers_bench: {}\n", error.what());
    return 2;
  }
}

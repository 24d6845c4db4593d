#include "tools/results/run_files.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <string_view>

#include "tools/files/output_file.hpp"

namespace bladefit {
namespace {

template <std::size_t count, typename Value>
std::string_view word(const std::array<std::string_view, count>& words, Value value) {
  return words.at(static_cast<std::size_t>(value));
}

constexpr std::array<std::string_view, 3> kKinds = {"interior", "edge", "corner"};
constexpr std::array<std::string_view, 2> kRegions = {"rest", "leading_edge"};
constexpr std::array<std::string_view, 4> kStates = {"pending", "in", "out", "rejected"};
constexpr std::array<std::string_view, 3> kActions = {"none", "cut", "weld"};

}  // namespace

std::string verdicts_csv(const SessionResult& result) {
  std::string text = "sequence,patch,u,v,kind,region,distance_mm,tolerance_mm,uncertainty_mm,state,action,x,y,z\n";
  for (std::size_t index = 0; index < result.verdicts.size(); ++index) {
    const Verdict& verdict = result.verdicts[index];
    const Foot& foot = verdict.foot;
    const auto& position = result.points[index].position;
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", verdict.sequence, foot.patch, foot.u, foot.v,
                        word(kKinds, foot.kind), word(kRegions, verdict.region), foot.distance, verdict.tolerance_mm,
                        verdict.uncertainty_mm, word(kStates, verdict.state), word(kActions, verdict.action),
                        position[0], position[1], position[2]);
  }
  return text;
}

std::vector<std::string> write_session_files(const std::string& session_directory, const SessionResult& result,
                                             const std::string& json) {
  const std::filesystem::path folder(session_directory);
  const std::string verdicts_path = folder / "verdicts.csv";
  const std::string result_path = folder / "result.json";
  OutputFile verdicts_file(verdicts_path, verdicts_csv(result));
  OutputFile result_file(result_path, json);
  verdicts_file.commit();
  result_file.commit();
  return {result_path, verdicts_path};
}

}  // namespace bladefit

#include "tools/screen/words.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

namespace bladefit {
namespace {

std::string word_at(std::span<const std::string_view> words, std::size_t index) {
  return std::string(index < words.size() ? words[index] : "?");
}

}  // namespace

std::string session_word(SessionState state) {
  static constexpr std::array<std::string_view, 6> kWords = {"idle",     "connecting", "collecting",
                                                             "tracking", "settled",    "FAULT"};
  return word_at(kWords, static_cast<std::size_t>(state));
}

std::string fit_word(std::uint16_t fit_status) {
  static constexpr std::array<std::string_view, 4> kWords = {"needs more points", "tracking", "converged",
                                                             "INFEASIBLE"};
  return word_at(kWords, fit_status);
}

std::string state_word(PointState state) {
  static constexpr std::array<std::string_view, 4> kWords = {"pending", "in", "OUT", "does not count"};
  return word_at(kWords, static_cast<std::size_t>(state));
}

std::string action_word(Action action) {
  static constexpr std::array<std::string_view, 3> kWords = {"-", "CUT", "WELD"};
  return word_at(kWords, static_cast<std::size_t>(action));
}

std::string region_word(Region region) {
  static constexpr std::array<std::string_view, 2> kWords = {"elsewhere", "leading edge"};
  return word_at(kWords, static_cast<std::size_t>(region));
}

std::string alarm_words(std::uint16_t alarms) {
  static constexpr std::array<std::pair<PanelAlarm, std::string_view>, 6> kWords = {
      {{kAlarmLeadingEdgeOut, "LEADING EDGE OUT"},
       {kAlarmRestOut, "point out elsewhere"},
       {kAlarmLinkLost, "LINK LOST"},
       {kAlarmDataGap, "POINTS MISSING"},
       {kAlarmMemoryFull, "memory full"},
       {kAlarmInfeasible, "INFEASIBLE"}}};
  std::string text;
  for (const auto& [bit, word] : kWords) {
    if ((alarms & bit) == 0) continue;
    if (!text.empty()) text += ", ";
    text += word;
  }
  return text;
}

std::string signed_mm(float value) {
  return std::isfinite(value) ? fmt::format("{:+.3f} mm", static_cast<double>(value)) : "-";
}

std::string tolerance_mm(float value) {
  return std::isfinite(value) ? fmt::format("{:.3f} mm", static_cast<double>(value)) : "not judged";
}

}  // namespace bladefit

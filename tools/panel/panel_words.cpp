#include "tools/panel/panel_words.hpp"

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

/// " by points 12 81", the points that no pose brings within their tolerances together; empty where not known.
std::string support_words(const PanelState& state) {
  std::string text;
  for (const std::uint32_t sequence : state.support) {
    if (sequence != 0) text += fmt::format("{}{}", text.empty() ? " by points " : " ", sequence);
  }
  return text;
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
  static constexpr std::array<std::string_view, 5> kWords = {"pending", "in", "OUT", "does not count", "undecided"};
  return word_at(kWords, static_cast<std::size_t>(state));
}

std::string action_word(Action action) {
  static constexpr std::array<std::string_view, 3> kWords = {"-", "CUT", "WELD"};
  return word_at(kWords, static_cast<std::size_t>(action));
}

std::string region_word(Region region) {
  static constexpr std::array<std::string_view, 2> kWords = {"rest of blade", "leading edge"};
  return word_at(kWords, static_cast<std::size_t>(region));
}

std::string alarm_words(const PanelState& state) {
  static constexpr std::array<std::pair<PanelAlarm, std::string_view>, 6> kWords = {
      {{kAlarmInfeasible, "INFEASIBLE"},
       {kAlarmLeadingEdgeOut, "LEADING EDGE OUT"},
       {kAlarmRestOut, "rest of blade out"},
       {kAlarmLinkLost, "LINK LOST"},
       {kAlarmDataGap, "POINTS MISSING"},
       {kAlarmMemoryFull, "memory full"}}};
  std::string text;
  for (const auto& [bit, word] : kWords) {
    if ((state.alarms & bit) == 0) continue;
    if (!text.empty()) text += ", ";
    text += word;
    if (bit == kAlarmInfeasible) text += support_words(state);
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

#include "tools/panel/panel_words.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

namespace bladefit {
namespace {

constexpr float kLongest_mm = 1e5F;
constexpr float kLongestRatio = 10;

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

std::string cell_word(EdgeCell cell) {
  static constexpr std::array<std::string_view, 7> kWords = {"not probed", "in",        "cut",         "weld",
                                                             "pending",    "undecided", "off the edge"};
  return word_at(kWords, static_cast<std::size_t>(cell));
}

std::string side_word(BladeSide side) {
  static constexpr std::array<std::string_view, 4> kWords = {"", "suction", "pressure", "nose"};
  return word_at(kWords, static_cast<std::size_t>(side));
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

// Numbers beyond what any machine measures are shown short: they are wrong, and would take the screen.
std::string signed_mm(float value) {
  if (!std::isfinite(value)) return "-";
  const auto number = static_cast<double>(value);
  return std::abs(value) < kLongest_mm ? fmt::format("{:+.3f} mm", number) : fmt::format("{:+.2g} mm", number);
}

std::string machine_mm(float value) {
  if (!std::isfinite(value)) return "-";
  const auto number = static_cast<double>(value);
  return std::abs(value) < kLongest_mm ? fmt::format("{:+.1f}", number) : fmt::format("{:+.1g}", number);
}

std::string ratio_text(float value) {
  const bool usual = value >= 0 && value < kLongestRatio;
  return usual ? fmt::format("{:.3f}", static_cast<double>(value)) : "?";
}

std::string duration_text(double seconds) {
  constexpr double kLongest_s = 1e8;
  if (!(seconds >= 0) || seconds > kLongest_s) return "?";
  constexpr long kMinute = 60, kHour = 3600;
  const long whole = std::lround(seconds);
  if (whole < kMinute) return fmt::format("{} s", whole);
  if (whole < kHour) return fmt::format("{} min {:02} s", whole / kMinute, whole % kMinute);
  return fmt::format("{} h {:02} min", whole / kHour, whole % kHour / kMinute);
}

std::string tolerance_mm(float value) {
  return std::isfinite(value) ? fmt::format("{:.3f} mm", static_cast<double>(value)) : "not judged";
}

}  // namespace bladefit

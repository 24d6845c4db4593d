#include "tools/panel/trouble_lines.hpp"

#include <fmt/format.h>

#include "tools/panel/panel_words.hpp"

namespace bladefit {
namespace {

bool has(const PanelState& state, PanelAlarm alarm) { return (state.alarms & alarm) != 0; }

std::string link_trouble(const PanelState& state) {
  std::string text = "LINK LOST";
  if (state.has_blade) text += fmt::format(" for {}: {}", duration_text(state.link_down_s), state.texts[kSourceText]);
  const std::string& why = state.texts[kFaultText];
  return text + (why.empty() ? "; check the cable and the machine" : ": " + why);
}

std::string gap_trouble(const PanelState& state) {
  std::string text = "POINTS MISSING";
  if (state.has_blade && state.lost > 0) text += fmt::format(": {}", state.lost);
  const std::string& why = state.texts[kLossText];
  return text + (why.empty() ? "; probe them again" : "; " + why);
}

std::string infeasible_trouble(const PanelState& state) {
  std::string text = "NO POSE MEETS THE TOLERANCES";
  const char* joint = ": proven by points ";
  for (const std::uint32_t sequence : state.support) {
    if (sequence == 0) continue;
    text += fmt::format("{}{}", joint, sequence);
    joint = " ";
  }
  if (state.smallest_feasible > 0.0F)
    text += fmt::format("; least tolerance {}", tolerance_mm(state.smallest_feasible));
  return text;
}

std::string otherwise_trouble(const PanelState& state) {
  const std::uint32_t count = state.otherwise_count;
  std::string text = fmt::format("A ROBUST FIT JUDGES {} {} OTHERWISE", count, count == 1 ? "POINT" : "POINTS");
  const char* joint = ": ";
  std::uint32_t listed = 0;
  for (const std::uint32_t sequence : state.otherwise) {
    if (sequence == 0) continue;
    ++listed;
    text += fmt::format("{}{}", joint, sequence);
    joint = " ";
  }
  if (listed > 0 && listed < count) text += fmt::format(" and {} more", count - listed);
  return text + "; judge again with --loss tukey";
}

}  // namespace

void put_trouble(const ScreenView& view, Page& page, int height) {
  const PanelState& state = view.state;
  const std::size_t most = height >= kScreenHeight ? 3 : 2;
  const auto put = [&](const std::string& text, std::size_t lines) {
    page.put_text("trouble", text, Style::trouble, lines);
  };
  page.group(1);
  if (!view.connected) {
    put(fmt::format("NO ANSWER from {} for {}: the numbers are that old; check host and network", view.address,
                    duration_text(view.age_s)),
        most);
  }
  if (state.session == SessionState::fault) put("FAULT: see the machine's own screen and the host's messages", 1);
  if (has(state, kAlarmLinkLost)) put(link_trouble(state), most);
  if (has(state, kAlarmDataGap) || (state.reasons & kReasonPointsMissing) != 0) put(gap_trouble(state), most - 1);
  if (has(state, kAlarmInfeasible)) put(infeasible_trouble(state), most - 1);
  if ((state.reasons & kReasonOtherwise) != 0) put(otherwise_trouble(state), most - 1);
  if (has(state, kAlarmMemoryFull))
    put("MEMORY FULL: older points follow the fit no more; raise capacity in the session file", most - 1);
}

}  // namespace bladefit

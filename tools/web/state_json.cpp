#include "tools/web/state_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "tools/panel/panel_words.hpp"
#include "tools/web/json_text.hpp"

namespace bladefit {
namespace {

std::string number(float value) { return json_number(static_cast<double>(value)); }
std::string numbers(std::span<const float> values) { return json_list(values, number); }

std::string defect_json(const BladeDefect& defect) {
  return fmt::format(R"({{"sequence":{},"from":{},"to":{},"length":{},"distance":{},"side":{},"action":{},"region":{},)"
                     R"("points":{},"machine":{}}})",
                     defect.sequence, number(defect.from_ratio), number(defect.to_ratio), number(defect.length),
                     number(defect.distance), json_text(side_word(defect.side)), json_text(action_word(defect.action)),
                     json_text(region_word(defect.region)), defect.points, numbers(defect.machine));
}

std::string next_json(const NextPlace& next) {
  if (next.reason == NextReason::none) return "null";
  return fmt::format(R"({{"reason":{},"side":{},"ratio":{},"machine":{}}})", static_cast<unsigned>(next.reason),
                     json_text(side_word(next.side)), number(next.ratio), numbers(next.machine));
}

std::string blade_json(const BladeView& blade) {
  const auto end = std::ranges::find(blade.defects, 0U, &BladeDefect::sequence);
  const std::span defects(blade.defects.begin(), end);
  return fmt::format(R"({{"edge":{},"edge_root":{},"edge_tip":{},"tip":{},"next":{},"defect_count":{},"defects":{}}})",
                     json_list(blade.edge, [](EdgeCell cell) { return std::to_string(static_cast<unsigned>(cell)); }),
                     number(blade.edge_root), number(blade.edge_tip), number(blade.tip), next_json(blade.next),
                     blade.defect_count, json_list(defects, defect_json));
}

std::string fit_json(const PanelState& state) {
  std::vector<std::uint32_t> support(state.support.begin(), state.support.end());
  std::erase(support, 0U);
  return fmt::format(
      R"({{"status":{},"determined":{},"fully":{},"rms":{},"edge_rms":{},"pose":{},"smallest_feasible":{},)"
      R"("improving":{},"support":{},"push_p99_us":{}}})",
      json_text(fit_word(state.fit_status)), state.determined, state.fit_determined, number(state.rms),
      number(state.leading_edge_rms), numbers(state.pose), number(state.smallest_feasible), state.improving,
      json_list(support, [](std::uint32_t sequence) { return std::to_string(sequence); }),
      number(state.push_latency_us));
}

std::string counts_json(const PanelState& state) {
  return fmt::format(
      R"({{"points":{},"planned":{},"edge":{},"edge_out":{},"rest_out":{},"rejected":{},"lost":{},"last":{}}})",
      state.points, state.planned, state.leading_edge_points, state.leading_edge_out, state.rest_out, state.rejected,
      state.lost, state.last_sequence);
}

std::string words_json(const PanelState& state) {
  const auto text = [&state](PanelText which) { return json_text(state.texts[which]); };
  return fmt::format(R"({{"verdict":{},"worst":{},"advice":{},"source":{},"fault":{},"loss":{},"alarms":{}}})",
                     text(kVerdictText), text(kWorstText), text(kAdviceText), text(kSourceText), text(kFaultText),
                     text(kLossText), json_text(alarm_words(state)));
}

}  // namespace

std::string state_json(const PanelState& state, bool commands) {
  return fmt::format(
      R"({{"session":{},"ended":{},"verdict":{},"reasons":{},"alarms":{},"heartbeat":{},"link_down_s":{},)"
      R"("words":{},"worst":{{"edge":{},"edge_sequence":{},"rest":{},"rest_sequence":{}}},)"
      R"("tolerance":{{"edge":{},"rest":{}}},"counts":{},"fit":{},"blade":{},"commands":{}}})",
      json_text(session_word(state.session)), state.ended, json_text(word_of(state.verdict)), state.reasons,
      state.alarms, state.heartbeat, state.link_down_s, words_json(state), number(state.worst_leading_edge),
      state.worst_leading_edge_sequence, number(state.worst_rest), state.worst_rest_sequence,
      number(state.leading_edge_tolerance), number(state.rest_tolerance), counts_json(state), fit_json(state),
      blade_json(state.blade), commands);
}

}  // namespace bladefit

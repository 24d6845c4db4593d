#include "tools/web/state_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/panel/panel_words.hpp"

namespace bladefit {
namespace {

using Json = nlohmann::json;

constexpr double kMillion = 1e6;

/// To a millionth; null where it is not finite.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::round(value * kMillion) / kMillion;
}

Json numbers(std::span<const float> values) {
  Json json = Json::array();
  for (const float value : values) json.push_back(number(static_cast<double>(value)));
  return json;
}

Json number(float value) { return number(static_cast<double>(value)); }

Json defect_json(const BladeDefect& defect) {
  return {
      {"sequence", defect.sequence},          {"from", number(defect.from_ratio)},    {"to", number(defect.to_ratio)},
      {"length", number(defect.length)},      {"distance", number(defect.distance)},  {"side", side_word(defect.side)},
      {"action", action_word(defect.action)}, {"region", region_word(defect.region)}, {"points", defect.points},
      {"machine", numbers(defect.machine)}};
}

Json blade_json(const BladeView& blade) {
  Json cells = Json::array(), defects = Json::array();
  for (const EdgeCell cell : blade.edge) cells.push_back(static_cast<unsigned>(cell));
  for (const BladeDefect& defect : blade.defects) {
    if (defect.sequence != 0) defects.push_back(defect_json(defect));
  }
  Json next = nullptr;
  if (blade.next.reason != NextReason::none) {
    next = {{"reason", static_cast<unsigned>(blade.next.reason)},
            {"side", side_word(blade.next.side)},
            {"ratio", number(blade.next.ratio)},
            {"machine", numbers(blade.next.machine)}};
  }
  return {{"edge", cells},
          {"edge_root", number(blade.edge_root)},
          {"edge_tip", number(blade.edge_tip)},
          {"tip", number(blade.tip)},
          {"next", next},
          {"defect_count", blade.defect_count},
          {"defects", defects}};
}

Json fit_json(const PanelState& state) {
  Json support = Json::array();
  for (const std::uint32_t sequence : state.support) {
    if (sequence != 0) support.push_back(sequence);
  }
  return {{"status", fit_word(state.fit_status)},
          {"determined", state.determined},
          {"fully", state.fit_determined},
          {"rms", number(state.rms)},
          {"edge_rms", number(state.leading_edge_rms)},
          {"pose", numbers(state.pose)},
          {"smallest_feasible", number(state.smallest_feasible)},
          {"improving", state.improving},
          {"support", support},
          {"push_p99_us", number(state.push_latency_us)}};
}

Json counts_json(const PanelState& state) {
  return {{"points", state.points},
          {"planned", state.planned},
          {"edge", state.leading_edge_points},
          {"edge_out", state.leading_edge_out},
          {"rest_out", state.rest_out},
          {"rejected", state.rejected},
          {"lost", state.lost},
          {"last", state.last_sequence}};
}

}  // namespace

std::string state_json(const PanelState& state, bool commands) {
  const Json json = {
      {"session", session_word(state.session)},
      {"ended", state.ended},
      {"verdict", word_of(state.verdict)},
      {"reasons", state.reasons},
      {"alarms", state.alarms},
      {"heartbeat", state.heartbeat},
      {"words",
       {{"verdict", state.texts[kVerdictText]},
        {"worst", state.texts[kWorstText]},
        {"advice", state.texts[kAdviceText]},
        {"source", state.texts[kSourceText]},
        {"fault", state.texts[kFaultText]},
        {"loss", state.texts[kLossText]},
        {"alarms", alarm_words(state)}}},
      {"link_down_s", state.link_down_s},
      {"worst",
       {{"edge", number(state.worst_leading_edge)},
        {"edge_sequence", state.worst_leading_edge_sequence},
        {"rest", number(state.worst_rest)},
        {"rest_sequence", state.worst_rest_sequence}}},
      {"tolerance", {{"edge", number(state.leading_edge_tolerance)}, {"rest", number(state.rest_tolerance)}}},
      {"counts", counts_json(state)},
      {"fit", fit_json(state)},
      {"blade", blade_json(state.blade)},
      {"commands", commands}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace bladefit

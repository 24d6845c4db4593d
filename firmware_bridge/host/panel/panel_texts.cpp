#include "firmware_bridge/host/panel/panel_texts.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>

namespace bladefit {

std::string verdict_words(const PanelState& state) {
  static constexpr std::array<std::string_view, 4> kWords = {"NOT JUDGED", "IN TOLERANCE", "OUT OF TOLERANCE",
                                                             "NOT DECIDED"};
  static constexpr std::array<std::pair<PanelReason, std::string_view>, 9> kReasons = {
      {{kReasonNotConverged, "fit not at rest"},
       {kReasonUnderdetermined, "needs more points"},
       {kReasonUnproven, "feet not proven"},
       {kReasonPointsMissing, "points missing"},
       {kReasonZoneNotProbed, "leading edge not probed"},
       {kReasonOpen, "not finished"},
       {kReasonLinkLost, "link lost"},
       {kReasonWrongWorld, "wrong units or mirrored"},
       {kReasonAmbiguous, "another fit may be as good"}}};
  const auto verdict = static_cast<std::size_t>(state.verdict);
  std::string text = std::string(verdict < kWords.size() ? kWords[verdict] : "?");
  const char* joint = ": ";
  for (const auto& [bit, word] : kReasons) {
    if ((state.reasons & bit) == 0) continue;
    text += joint;
    text += word;
    joint = ", ";
  }
  return text;
}

std::string worst_words(const Verdict* worst, double radius_mm) {
  if (worst == nullptr) return {};
  const char* const region = worst->region == Region::leading_edge ? "leading edge" : "rest";
  const char* const action = worst->action == Action::cut ? " CUT" : worst->action == Action::weld ? " WELD" : "";
  return fmt::format("point {} {} {:+.3f} mm{} radius {:.1f} mm u {:.4f} v {:.4f}", worst->sequence, region,
                     worst->foot.distance, action, radius_mm, worst->foot.u, worst->foot.v);
}

std::string advice_words(const PanelState& state) {
  static constexpr std::array<std::pair<PanelReason, std::string_view>, 8> kAdvice = {
      {{kReasonLinkLost, "link lost: check the cable and the machine"},
       {kReasonWrongWorld, "check the units and the design"},
       {kReasonUnderdetermined, "probe more points, spread over the blade"},
       {kReasonAmbiguous, "give a nearer start, or probe more of the blade"},
       {kReasonNotConverged, "go on: the fit is not at rest yet"},
       {kReasonUnproven, "go on: the fit is not proven yet"},
       {kReasonPointsMissing, "probe the missing points again"},
       {kReasonZoneNotProbed, "probe the leading edge"}}};
  if (state.session == SessionState::fault) return "fault: see the machine's own screen and the host's messages";
  const bool out = state.verdict == BladeState::out_of_tolerance;
  if (out && (state.reasons & kReasonLinkLost) == 0) return "cut or weld the points marked, then probe them again";
  for (const auto& [bit, words] : kAdvice) {
    if ((state.reasons & bit) != 0) return std::string(words);
  }
  if ((state.reasons & kReasonOpen) != 0) return "go on probing";
  if (state.verdict == BladeState::in_tolerance) return "nothing: the blade is in tolerance";
  return "set a tolerance to have the blade judged";
}

}  // namespace bladefit

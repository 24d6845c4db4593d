#include "tools/panel/screen.hpp"

#include <fmt/format.h>

#include "firmware_bridge/host/panel/panel_texts.hpp"
#include "tools/panel/big_page.hpp"
#include "tools/panel/figures_page.hpp"
#include "tools/panel/operator_page.hpp"
#include "tools/panel/page.hpp"
#include "tools/panel/panel_words.hpp"

namespace bladefit {

std::vector<std::string> draw_screen(const ScreenView& view, int width, int height) {
  switch (view.page) {
    case ScreenPage::figures:
      return figures_page(view, width, height);
    case ScreenPage::big:
      return big_page(view, width, height);
    case ScreenPage::operator_page:
      break;
  }
  return operator_page(view, width, height);
}

std::string status_line(const ScreenView& view) {
  if (!view.known) return fmt::format("{}: {}", view.address, link_word(view));
  const PanelState& state = view.state;
  std::string line = fmt::format(
      "{}; "
      "{}, {}; {} points, {:.1f} a second; fit {}, {} degrees of freedom, rms {:.4f} mm; leading edge: {} out, worst "
      "{}; rest of "
      "blade: "
      "{} out",
      state.has_extension ? verdict_words(state) : "-", session_word(state.session), link_word(view), state.points,
      view.points_per_second, fit_words(state), state.determined, static_cast<double>(state.rms),
      state.leading_edge_out, worst_words(state.worst_leading_edge, state.worst_leading_edge_sequence), state.rest_out);
  const std::string alarms = alarm_words(state);
  return alarms.empty() ? line : line + "; ALARM " + alarms;
}

}  // namespace bladefit

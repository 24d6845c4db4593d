#include "tools/panel/screen.hpp"

#include <fmt/format.h>

#include "firmware_bridge/host/panel/panel_texts.hpp"
#include "tools/panel/panel_words.hpp"
#include "tools/panel/styled_line.hpp"

namespace bladefit {
namespace {

constexpr int kValueColumn = 16;
constexpr int kSecondColumn = 48;
constexpr int kHeadingColumn = 42;

double real(float value) { return static_cast<double>(value); }

/// Collects finished lines of one screen.
class Page {
 public:
  Page(const ScreenView& view, int width) : view_(view), width_(width) {}
  [[nodiscard]] StyledLine line() const { return {width_, view_.colour}; }
  void put(const StyledLine& line) { lines_.push_back(line.text()); }
  void rule() { put(line().rule('-')); }
  [[nodiscard]] std::vector<std::string> take() { return std::move(lines_); }

 private:
  const ScreenView& view_;
  int width_;
  std::vector<std::string> lines_;
};

std::string link_word(const ScreenView& view) {
  if (!view.connected) return "NO ANSWER";
  if (view.state.session == SessionState::connecting) return "link connecting";
  return (view.state.alarms & kAlarmLinkLost) != 0 ? "link LOST" : "link up";
}

void draw_heading(const ScreenView& view, Page& page) {
  const bool trouble = !view.connected || (view.state.alarms & kAlarmLinkLost) != 0;
  const std::string session = view.known ? "session " + session_word(view.state.session) : "waiting";
  StyledLine line = page.line();
  line.add(" bladefit", Style::strong).add(" " + view.address);
  page.put(line.to(kHeadingColumn)
               .add(session, Style::strong)
               .add("   ")
               .add(link_word(view), trouble ? Style::bad : Style::good));
}

void draw_verdict(const ScreenView& view, Page& page) {
  const PanelState& state = view.state;
  StyledLine line = page.line();
  line.add(" verdict").to(kValueColumn);
  if (!view.known || !state.has_extension) return page.put(line.add("-"));
  const bool in = state.verdict == BladeState::in_tolerance, out = state.verdict == BladeState::out_of_tolerance;
  page.put(line.add(verdict_words(state), out ? Style::bad : in ? Style::good : Style::strong));
}

void draw_alarm(const ScreenView& view, Page& page) {
  const std::string alarms = alarm_words(view.state);
  StyledLine line = page.line();
  line.add(" alarm").to(kValueColumn);
  page.put(alarms.empty() ? line.add("none", Style::good) : line.add("*** " + alarms + " ***", Style::bad));
}

void draw_points(const ScreenView& view, Page& page) {
  const PanelState& state = view.state;
  page.put(page.line()
               .add(" points")
               .to(kValueColumn)
               .add(fmt::format("{}", state.points), Style::strong)
               .add(state.planned > 0 ? fmt::format(" of {}", state.planned) : "")
               .add(fmt::format("  at {:.1f} a second", view.points_per_second))
               .to(kSecondColumn)
               .add(fmt::format("{} leading edge, {} not counted", state.leading_edge_points, state.rejected)));
  const Style style = state.last_state == PointState::out ? Style::bad : Style::plain;
  StyledLine line = page.line();
  line.add(" last point").to(kValueColumn);
  if (state.last_sequence == 0) {
    page.put(line.add("-"));
    return;
  }
  line.add(fmt::format("{}  {}  ", state.last_sequence, signed_mm(state.last_distance)));
  line.to(kSecondColumn).add(region_word(state.last_region) + ": ").add(state_word(state.last_state), style);
  page.put(state.last_action == Action::none ? line : line.add(", " + action_word(state.last_action), Style::bad));
}

/// The fit's state; in the modes beside least squares also whether its optimum still moves.
std::string fit_words(const PanelState& state) {
  return fit_word(state.fit_status) + (state.improving ? ", improving" : "");
}

/// The tolerance, and the smallest one that can be met where it is known.
std::string leading_edge_tolerance_words(const PanelState& state) {
  const std::string wanted = tolerance_mm(state.leading_edge_tolerance);
  if (!(state.smallest_feasible > 0.0F)) return wanted;
  return fmt::format("{}, least {:.4f} mm", wanted, real(state.smallest_feasible));
}

void draw_fit(const ScreenView& view, Page& page) {
  const PanelState& state = view.state;
  const Style style = state.determined == 6 ? Style::good : Style::plain;
  page.put(page.line()
               .add(" fit")
               .to(kValueColumn)
               .add(fit_words(state), style)
               .to(kSecondColumn)
               .add(fmt::format("{} degrees of freedom known", state.determined)));
  page.put(page.line()
               .add(" rms")
               .to(kValueColumn)
               .add(fmt::format("{:.4f} mm all points", real(state.rms)))
               .to(kSecondColumn)
               .add(fmt::format("{:.4f} mm leading edge", real(state.leading_edge_rms))));
  const auto& pose = state.pose;
  page.put(page.line()
               .add(" pose")
               .to(kValueColumn)
               .add(fmt::format("t {:+.4f} {:+.4f} {:+.4f} mm  rot {:+.5f} {:+.5f} {:+.5f}", real(pose[0]),
                                real(pose[1]), real(pose[2]), real(pose[3]), real(pose[4]), real(pose[5]))));
}

std::string worst_words(float distance, std::uint32_t sequence) {
  return sequence == 0 ? "-" : fmt::format("{} at point {}", signed_mm(distance), sequence);
}

void draw_worst(const ScreenView& view, Page& page) {
  const PanelState& state = view.state;
  const Style style = state.leading_edge_out > 0 ? Style::bad : Style::strong;
  page.put(page.line().to(kValueColumn).add("leading edge").to(kSecondColumn).add("rest of blade"));
  page.put(page.line()
               .add(" tolerance")
               .to(kValueColumn)
               .add(leading_edge_tolerance_words(state))
               .to(kSecondColumn)
               .add(tolerance_mm(state.rest_tolerance)));
  page.put(page.line()
               .add(" worst")
               .to(kValueColumn)
               .add(worst_words(state.worst_leading_edge, state.worst_leading_edge_sequence), style)
               .to(kSecondColumn)
               .add(worst_words(state.worst_rest, state.worst_rest_sequence)));
  page.put(page.line()
               .add(" out")
               .to(kValueColumn)
               .add(fmt::format("{}", state.leading_edge_out), style)
               .to(kSecondColumn)
               .add(fmt::format("{}", state.rest_out), state.rest_out > 0 ? Style::bad : Style::plain));
}

void draw_place(const PanelPlace& place, bool has_extension, Page& page) {
  StyledLine line = page.line();
  if (place.sequence == 0) {
    page.put(line);
    return;
  }
  line.add(fmt::format(" {:>8}  {:>11}  ", place.sequence, signed_mm(place.distance)));
  if (!has_extension) {
    page.put(line.add("-").to(31).add("    -         -         -            -"));
    return;
  }
  line.add(fmt::format("{:<7}", action_word(place.action)), place.action == Action::weld ? Style::good : Style::bad);
  page.put(line.to(31).add(fmt::format("{:>5}  {:>8.4f}  {:>8.4f}  {:>8.2f} mm", place.patch, real(place.u),
                                       real(place.v), real(place.radius))));
}

void draw_places(const ScreenView& view, Page& page) {
  page.rule();
  page.put(page.line().add(" Leading-edge points out of tolerance, newest first", Style::strong));
  page.put(page.line().add("    point     distance  do       patch         u         v       radius", Style::faint));
  for (const PanelPlace& place : view.state.newest) draw_place(place, view.state.has_extension, page);
}

void draw_footing(const ScreenView& view, Page& page) {
  page.put(
      page.line()
          .add(fmt::format(" judged in {:.1f} us (99 of 100 points)", real(view.state.push_latency_us)), Style::faint)
          .to(kSecondColumn)
          .add("Ctrl-C ends", Style::faint));
}

}  // namespace

std::vector<std::string> draw_screen(const ScreenView& view, int width, int height) {
  Page page(view, width);
  draw_heading(view, page);
  draw_verdict(view, page);
  draw_alarm(view, page);
  draw_points(view, page);
  draw_fit(view, page);
  draw_worst(view, page);
  draw_places(view, page);
  draw_footing(view, page);
  std::vector<std::string> lines = page.take();
  if (lines.size() > static_cast<std::size_t>(height)) lines.resize(static_cast<std::size_t>(height));
  return lines;
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
      view.points_per_second, fit_words(state), state.determined, real(state.rms), state.leading_edge_out,
      worst_words(state.worst_leading_edge, state.worst_leading_edge_sequence), state.rest_out);
  const std::string alarms = alarm_words(state);
  return alarms.empty() ? line : line + "; ALARM " + alarms;
}

}  // namespace bladefit

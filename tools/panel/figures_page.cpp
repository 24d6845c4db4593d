#include "tools/panel/figures_page.hpp"

#include <fmt/format.h>

#include "tools/panel/page.hpp"
#include "tools/panel/panel_words.hpp"

namespace bladefit {
namespace {

constexpr int kSecondColumn = 46;
constexpr std::uint16_t kFree = 6;  ///< degrees of freedom of a pose
constexpr int kPatchColumns = 72;   ///< screens with room for patch, u and v

double real(float value) { return static_cast<double>(value); }

void draw_alarm(const ScreenView& view, Page& page) {
  const std::string alarms = alarm_words(view.state);
  if (alarms.empty()) return page.put(page.named("alarm").add("none", Style::in));
  page.put_text("alarm", "*** " + alarms + " ***", Style::trouble, 2);
}

/// A piece of text and its style.
struct Piece {
  std::string text;
  Style style = Style::plain;
};

/// Two values beside each other, or where that is too wide the second one below the first.
void put_pair(Page& page, std::string_view name, const Piece& first, const Piece& second) {
  StyledLine line = page.named(name);
  line.add(first.text, first.style);
  if (page.width() >= kScreenWidth) return page.put(line.to(kSecondColumn).add(second.text, second.style));
  const bool beside = cells_of(second.text) + 2 <= line.room();
  page.put(beside ? line.field(second.text, second.style) : line);
  if (!beside) page.put(page.named("").add(second.text, second.style));
}

void draw_points(const ScreenView& view, Page& page) {
  const PanelState& state = view.state;
  const std::string of = state.planned > 0 ? fmt::format(" of {}", state.planned) : "";
  put_pair(page, "points", {fmt::format("{}{}  at {:.1f} a second", state.points, of, view.points_per_second)},
           {fmt::format("{} leading edge, {} not counted", state.leading_edge_points, state.rejected)});
  if (state.last_sequence == 0) return put_pair(page, "last point", {"-"}, {});
  const std::string action = state.last_action == Action::none ? "" : ", " + action_word(state.last_action);
  put_pair(page, "last point", {fmt::format("{}  {}", state.last_sequence, signed_mm(state.last_distance))},
           {region_word(state.last_region) + ": " + state_word(state.last_state) + action,
            state.last_state == PointState::out ? style_of(state.last_action) : Style::plain});
}

/// The tolerance, and the smallest one that can be met where it is known.
std::string leading_edge_tolerance_words(const PanelState& state) {
  const std::string wanted = tolerance_mm(state.leading_edge_tolerance);
  if (!(state.smallest_feasible > 0.0F)) return wanted;
  return fmt::format("{}, least {:.4f} mm", wanted, real(state.smallest_feasible));
}

void draw_fit(const ScreenView& view, Page& page) {
  const PanelState& state = view.state;
  put_pair(page, "fit", {fit_words(state), state.determined == kFree ? Style::in : Style::plain},
           {fmt::format("{} degrees of freedom known", state.determined)});
  put_pair(page, "rms", {fmt::format("{:.4f} mm all points", real(state.rms))},
           {fmt::format("{:.4f} mm leading edge", real(state.leading_edge_rms))});
  const auto& pose = state.pose;
  page.put(page.named("shift").add(
      fmt::format("x {:+.4f}  y {:+.4f}  z {:+.4f} mm", real(pose[0]), real(pose[1]), real(pose[2]))));
  page.put(page.named("turn").add(
      fmt::format("rx {:+.6f}  ry {:+.6f}  rz {:+.6f} rad", real(pose[3]), real(pose[4]), real(pose[5]))));
}

void draw_worst(const ScreenView& view, Page& page) {
  const PanelState& state = view.state;
  const Style style = state.leading_edge_out > 0 ? Style::cut : Style::strong;
  put_pair(page, "tolerance", {leading_edge_tolerance_words(state) + " edge"},
           {tolerance_mm(state.rest_tolerance) + " rest"});
  put_pair(page, "worst", {worst_words(state.worst_leading_edge, state.worst_leading_edge_sequence) + " edge", style},
           {worst_words(state.worst_rest, state.worst_rest_sequence) + " rest"});
  put_pair(page, "out", {fmt::format("{} edge", state.leading_edge_out), style},
           {fmt::format("{} rest", state.rest_out), state.rest_out > 0 ? Style::cut : Style::plain});
}

void draw_place(const PanelPlace& place, bool has_extension, Page& page) {
  if (place.sequence == 0) return;
  StyledLine line = page.line();
  line.add(fmt::format(" {:>8}  {:>11}  ", place.sequence, signed_mm(place.distance)));
  if (!has_extension) return page.put(line.add("-"));
  line.add(fmt::format("{:<4}", action_word(place.action)), style_of(place.action));
  line.add(fmt::format("  {:>9.2f}", real(place.radius)));
  if (page.width() >= kPatchColumns)
    line.add(fmt::format("  {:>5}  {:>8.4f}  {:>8.4f}", place.patch, real(place.u), real(place.v)));
  page.put(line);
}

void draw_places(const ScreenView& view, Page& page) {
  if (view.state.newest[0].sequence == 0) return;
  page.rule();
  page.put(page.line().add(" Leading-edge points out of tolerance, newest first", Style::strong));
  StyledLine heading = page.line();
  heading.add("    point     distance  do    radius mm", Style::faint);
  if (page.width() >= kPatchColumns) heading.add("  patch         u         v", Style::faint);
  page.put(heading);
  for (const PanelPlace& place : view.state.newest) draw_place(place, view.state.has_extension, page);
}

void draw_latency(const ScreenView& view, Page& page) {
  put_pair(page, "judged in", {fmt::format("{:.1f} us (99 of 100 points)", real(view.state.push_latency_us))},
           {"panel up for " + duration_text(view.state.heartbeat)});
}

}  // namespace

std::string fit_words(const PanelState& state) {
  return fit_word(state.fit_status) + (state.improving ? ", improving" : "");
}

std::string worst_words(float distance, std::uint32_t sequence) {
  return sequence == 0 ? "-" : fmt::format("{} at point {}", signed_mm(distance), sequence);
}

std::vector<std::string> figures_page(const ScreenView& view, int width, int height) {
  Page page(view, width);
  page.group(0);
  put_heading(view, page);
  draw_alarm(view, page);
  page.group(2);
  draw_points(view, page);
  page.group(1);
  draw_fit(view, page);
  draw_worst(view, page);
  page.group(3);
  draw_latency(view, page);
  page.group(4);
  draw_places(view, page);
  page.group(0);
  put_keys(view, page);
  return page.take(height, true);
}

}  // namespace bladefit

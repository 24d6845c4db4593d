#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "firmware_bridge/host/panel/panel_map.hpp"

namespace bladefit {

/// What a screen can be asked to show.
enum class ScreenPage : std::uint8_t {
  operator_page,  ///< verdict, trouble, progress, the leading edge, defects
  figures,        ///< what an engineer looks at: fit, pose, newest points
  big             ///< four lines in block letters, to be read from afar
};

/// What the screen shows: the panel's registers and what the reader of them knows besides.
struct ScreenView {
  std::string address;     ///< of the panel, HOST:PORT
  bool connected = false;  ///< false: the host does not answer; `state` is the last one known
  double age_s = 0;        ///< where it does not: how old that is
  bool known = false;      ///< a state was read at least once
  PanelState state;
  double points_per_second = 0;
  bool colour = false;
  bool utf8 = false;  ///< the terminal shows it
  ScreenPage page = ScreenPage::operator_page;
  std::string keys;  ///< what can be pressed, in words
};

inline constexpr int kScreenWidth = 80, kScreenHeight = 24;

/// The screen as lines, at most `height` of them and none wider than `width`. A pure function of its arguments.
[[nodiscard]] std::vector<std::string> draw_screen(const ScreenView& view, int width, int height);

/// The same in one line, for logs.
[[nodiscard]] std::string status_line(const ScreenView& view);

}  // namespace bladefit

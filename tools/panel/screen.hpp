#pragma once
#include <string>
#include <vector>

#include "firmware_bridge/host/panel/panel_map.hpp"

namespace bladefit {

/// What the operator's screen shows: the panel's registers and what the reader of them knows besides.
struct ScreenView {
  std::string address;     ///< of the panel, HOST:PORT
  bool connected = false;  ///< false: the host does not answer; `state` is the last one known
  bool known = false;      ///< a state was read at least once
  PanelState state;
  double points_per_second = 0;
  bool colour = false;
};

inline constexpr int kScreenWidth = 80, kScreenHeight = 24;

/// The screen as lines, at most `height` of them and none wider than `width`. A pure function of its arguments.
[[nodiscard]] std::vector<std::string> draw_screen(const ScreenView& view, int width, int height);

/// The same in one line, for logs.
[[nodiscard]] std::string status_line(const ScreenView& view);

}  // namespace bladefit

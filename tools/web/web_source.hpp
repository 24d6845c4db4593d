#pragma once
#include <functional>
#include <string>

#include "firmware_bridge/host/feed/point_feed.hpp"
#include "firmware_bridge/host/panel/panel_map.hpp"
#include "firmware_bridge/host/panel/panel_protocol.hpp"

namespace bladefit {

/// What the web panel shows, and whom it tells what was pressed. All of it may be used from any thread.
struct WebSource {
  std::function<PanelState()> state;
  const PointFeed* feed = nullptr;  ///< must outlive the server
  std::function<void(const PanelCommands&)> press;
  std::string design;  ///< JSON of design_json()
};

}  // namespace bladefit

#pragma once
#include <span>
#include <string>

#include "firmware_bridge/host/feed/point_feed.hpp"

namespace bladefit {

/// A piece of the feed as one JSON object: {"afresh", "more", "rows"}. The rows stand in one flat array of numbers, so
/// many a point: slot, sequence, foot x, y, z [mm, design frame], normal x, y, z, distance [mm], tolerance [mm, 0 =
/// none], kind (state + 8 action + 32 region, by their values), revision, time [ms]. Cost: linear.
[[nodiscard]] std::string piece_json(const FeedPiece& piece, std::span<const FedPoint> points);

inline constexpr std::size_t kFeedColumns = 13;

/// What a point was judged, the newest first, as JSON: {"sequence", "history": [{"time_ms", "distance", ...}]}.
[[nodiscard]] std::string history_json(std::uint32_t sequence, std::span<const FedVerdict> history);

}  // namespace bladefit

#include "drivers/replay/replay_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <thread>

#include "drivers/replay/points_csv.hpp"
#include "drivers/source/host_clock.hpp"

namespace bladefit {
namespace {

/// FNV-1a over the positions, directions, weights and paths; never 0.
std::uint32_t digest(const std::vector<ProbePoint>& points) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  const auto add = [&hash](std::uint64_t word) { hash = (hash ^ word) * 0x100000001b3U; };
  for (const ProbePoint& point : points) {
    for (const double coordinate : point.position) add(std::bit_cast<std::uint64_t>(coordinate));
    for (const double component : point.approach) add(std::bit_cast<std::uint64_t>(component));
    add(std::bit_cast<std::uint64_t>(point.weight));
    add(point.path);
  }
  const auto folded = static_cast<std::uint32_t>(hash ^ (hash >> 32U));
  return folded == 0 ? 1 : folded;
}

}  // namespace

Failure ReplaySource::open(std::uint32_t after, std::uint32_t /*run_id*/) {
  PointsFile file = read_points_csv(settings_.file, settings_.format);
  if (file.error) return std::move(file.error);
  if (after > file.points.size()) {
    return bad_input(
        fmt::format("{}: has {} points, but the session already holds {}; replay the file the session began with",
                    settings_.file, file.points.size(), after));
  }
  points_ = std::move(file.points);
  next_ = after;
  status_ = {};
  status_.link = LinkState::up;
  status_.planned = static_cast<std::uint32_t>(points_.size());
  status_.run_id = digest(points_);
  status_.finished = next_ == points_.size();
  status_.last = static_cast<std::uint32_t>(next_);
  return {};
}

std::size_t ReplaySource::poll(std::span<ProbePoint> points, std::chrono::milliseconds timeout) {
  const std::size_t count = std::min(points.size(), points_.size() - next_);
  if (count == 0) std::this_thread::sleep_for(timeout);
  for (std::size_t index = 0; index < count; ++index) {
    points[index] = points_[next_ + index];
    points[index].time_us = host_time_us();
  }
  next_ += count;
  status_.records += count;
  status_.last = static_cast<std::uint32_t>(next_);
  status_.finished = next_ == points_.size();
  return count;
}

}  // namespace bladefit

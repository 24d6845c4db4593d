#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "drivers/source/point_queue.hpp"
#include "drivers/source/probe_source.hpp"

namespace bladefit {

using Sequences = std::vector<std::uint32_t>;

/// first, first + 1, ..., last.
inline Sequences counted(std::uint32_t first, std::uint32_t last) {
  Sequences numbers;
  for (std::uint32_t number = first; number <= last; ++number) numbers.push_back(number);
  return numbers;
}

inline Sequences sequences_of(std::span<const ProbePoint> points) {
  Sequences sequences;
  for (const ProbePoint& point : points) sequences.push_back(point.sequence);
  return sequences;
}

/// Sequences of the points that wait in a queue.
inline Sequences take_sequences(PointQueue& queue) {
  std::array<ProbePoint, 64> points;
  const std::size_t count = queue.take(points);
  return sequences_of(std::span(points).first(count));
}

/// Points that come within `within`, until `count` are there.
inline std::vector<ProbePoint> collect_points(ProbeSource& source, std::size_t count,
                                              std::chrono::milliseconds within = std::chrono::seconds(2)) {
  std::vector<ProbePoint> collected;
  const auto deadline = std::chrono::steady_clock::now() + within;
  std::array<ProbePoint, 5> points;
  while (collected.size() < count && std::chrono::steady_clock::now() < deadline) {
    const std::size_t came = source.poll(points, std::chrono::milliseconds(10));
    collected.insert(collected.end(), points.begin(), points.begin() + static_cast<std::ptrdiff_t>(came));
  }
  return collected;
}

inline Sequences collect(ProbeSource& source, std::size_t count,
                         std::chrono::milliseconds within = std::chrono::seconds(2)) {
  return sequences_of(collect_points(source, count, within));
}

}  // namespace bladefit

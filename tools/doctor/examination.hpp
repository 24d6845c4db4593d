#pragma once
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "core/probe_point.hpp"

namespace bladefit {

enum class Outcome : std::uint8_t {
  fits,         ///< the settings make sense of the device
  change,       ///< other settings do
  unreachable,  ///< the device does not answer, or its port cannot be opened
  undecided,    ///< too little was seen, or nothing makes sense of it
};

/// What was seen of a device, and what it comes to.
struct Examination {
  Outcome outcome = Outcome::undecided;
  std::string conclusion;            ///< one sentence; other than with `fits` it ends with the way out
  std::vector<std::string> seen;     ///< lines of the report, in their order
  std::vector<std::string> changes;  ///< settings to write into the device file, such as `unit = 7`
  std::vector<ProbePoint> points;    ///< the points read, with those changes
};

/// The moment by which an examination must have ended.
using Deadline = std::chrono::steady_clock::time_point;

}  // namespace bladefit

#pragma once
#include <array>
#include <cstdint>

namespace bladefit {

/// One touch of the probe, in the machine's coordinates.
struct ProbePoint {
  std::uint32_t sequence = 0;        ///< number of the record in its run; the first is 1
  std::uint16_t path = 0;            ///< scan line the point belongs to; 0 = unknown
  std::array<double, 3> position{};  ///< [mm]; the centre of the ball where a probe radius is set
  std::array<double, 3> approach{};  ///< unit vector from the probe to the material; all 0 = unknown
  std::int64_t time_us = 0;          ///< when the host received it [us, any monotonic origin]; 0 = unknown
  double weight = 1;                 ///< of its squared distance in the least-squares objective, > 0
};

}  // namespace bladefit

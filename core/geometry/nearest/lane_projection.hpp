#pragma once
#include <array>
#include <cstdint>

#include "core/geometry/nearest/local_projection.hpp"
#include "core/geometry/simd/lanes.hpp"

namespace bladefit {

/// Local minima of up to kLanes points, found at once; each the same to the last bit as project_local() finds.
class LaneProjections {
 public:
  /// `available`: whether lanes are to be used at all.
  explicit LaneProjections(bool available = lanes_available()) : available_(available) {}

  /// Takes in a point, in design coordinates, and the place that its foot is sought from. Lanes are taken in order.
  /// What lanes cannot do, since the place is not in a bicubic span, the image holds no Taylor form of it or the
  /// processor has no lanes, is left out.
  void enter(const Surface& surface, const Vec3& r, const SurfacePlace& start);

  /// Finds the feet. Cost: some 45 ns a point from neighbouring places.
  void find(const Surface& surface);

  [[nodiscard]] std::uint32_t count() const { return count_; }
  /// False: this one is to be sought by project_local(). Its foot is not inside the span of its start.
  [[nodiscard]] bool found(std::uint32_t lane) const { return open_[lane]; }
  [[nodiscard]] const SurfacePlace& place(std::uint32_t lane) const { return place_[lane]; }
  [[nodiscard]] Projection projection(std::uint32_t lane) const;
  [[nodiscard]] Vec3 point(std::uint32_t lane) const;
  /// q, r - q, and Su x Sv there.
  [[nodiscard]] Vec3 surface_point(std::uint32_t lane) const;
  [[nodiscard]] Vec3 offset(std::uint32_t lane) const;
  [[nodiscard]] Vec3 cross(std::uint32_t lane) const;
  /// For take_rows(). Null where no lane is in use.
  [[nodiscard]] const LaneWalk* walk() const { return used_ < kLanes ? &walk_ : nullptr; }

 private:
  bool available_;
  std::uint32_t count_ = 0;
  std::uint32_t used_ = kLanes;  ///< a lane in use
  std::array<bool, kLanes> open_{};
  std::array<SurfacePlace, kLanes> place_;
  LaneWalk walk_;
};

/// The numbers of one lane.
[[nodiscard]] inline Vec3 lane_of(const LaneNumbers (&numbers)[3], std::uint32_t lane) {
  return {numbers[0][lane], numbers[1][lane], numbers[2][lane]};
}

}  // namespace bladefit

#pragma once
#include <array>
#include <vector>

#include "core/geometry/surface/surface.hpp"
#include "core/inspection/shaft_axis.hpp"
#include "core/localizer.hpp"
#include "firmware_bridge/host/blade/blade_view.hpp"

namespace bladefit {

/// A place of the design that can be probed.
struct BladePlace {
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();  ///< design frame [mm], outward unit normal
  double radius = 0;                                 ///< [mm]
  Region region = Region::rest;
  BladeSide side = BladeSide::unknown;
};

/// Which side of the blade, which radius and which part of the leading edge a place belongs to.
class BladeLayout {
 public:
  /// Of no design: no places, sides unknown.
  BladeLayout() = default;

  /// `tip_radius_mm` is R, 0 = the greatest radius of the places. Cost: some thousand evaluations.
  BladeLayout(const DesignImage& design, const LocalizerConfig& config, const ShaftAxis& axis, double tip_radius_mm);

  [[nodiscard]] const ShaftAxis& axis() const { return axis_; }
  [[nodiscard]] double tip_radius_mm() const { return tip_mm_; }

  /// Radii of the ends of the leading-edge region; equal where none is set [mm].
  [[nodiscard]] double edge_root_mm() const { return root_mm_; }
  [[nodiscard]] double edge_tip_mm() const { return edge_tip_mm_; }

  /// Half the diagonal of the design, and its middle [mm]: to which levers are taken.
  [[nodiscard]] double scale_mm() const { return scale_mm_; }
  [[nodiscard]] const Vec3& middle() const { return middle_; }

  /// Evenly in the parameters of the patches, those within the window of the fit.
  [[nodiscard]] const std::vector<BladePlace>& places() const { return places_; }

  /// r/R; 0 where there is no design.
  [[nodiscard]] double ratio_of(double radius_mm) const { return tip_mm_ > 0 ? radius_mm / tip_mm_ : 0; }

  /// The cell of the leading edge at a radius: the first or the last one beyond its ends.
  [[nodiscard]] std::size_t cell_of(double radius_mm) const;
  /// The radius in the middle of a cell [mm].
  [[nodiscard]] double radius_of_cell(std::size_t cell) const;

  /// The tenth of r/R.
  [[nodiscard]] std::size_t band_of(double radius_mm) const;

  /// The side that a place with this outward normal lies on.
  [[nodiscard]] BladeSide side_of(const Vec3& point, const Vec3& normal, Region region) const;

 private:
  static constexpr std::size_t kStations = 32;

  void take_places(const Surface& surface, const LocalizerConfig& config, const ParameterBox& box, std::uint32_t steps);
  void find_sides();
  [[nodiscard]] std::size_t station_of(double radius_mm) const;

  ShaftAxis axis_;
  double tip_mm_ = 0, root_mm_ = 0, edge_tip_mm_ = 0, scale_mm_ = 1;
  Vec3 middle_ = Vec3::Zero();
  std::vector<BladePlace> places_;
  std::array<Vec3, kStations> suction_{};  ///< unit vectors out of the suction side, by radius; zero = not known
};

}  // namespace bladefit

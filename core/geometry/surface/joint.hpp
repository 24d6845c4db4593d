#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace bladefit {

/// What lies beyond a part of a span's side at which the surface ends or is not smooth.
enum class Joint : std::uint8_t {
  none = 0,    ///< nothing: an outer edge of the design
  smooth = 1,  ///< a surface that goes on with the same normal
  bent = 2,    ///< one whose normal is less than 90 degrees off: the side that a point is on is that of either normal
  ridge = 3,   ///< a sharper bend away from the normal, such as a sharp leading edge: every point that has its foot
               ///< there is outside of the material
  valley = 4,  ///< a sharper bend towards the normal: every such point is inside
  open = 8     ///< an outer edge that faces another one across the material, as at a blunt trailing edge; open + k says
               ///< how the end between them leans
};

/// Tangents of the angle between the end from one outer edge to the other and the inward normal, by which it leans out
/// of the patch where the two sides converge: not more than that of open + k.
inline constexpr std::array<double, 8> kLeans = {0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 1.0};

[[nodiscard]] constexpr bool is_outer(Joint joint) { return joint == Joint::none || joint >= Joint::open; }
[[nodiscard]] constexpr double lean_of(Joint joint) {
  return joint < Joint::open ? 0.0 : kLeans[static_cast<std::size_t>(joint) - static_cast<std::size_t>(Joint::open)];
}
/// All others are damage.
[[nodiscard]] constexpr bool is_joint(std::uint32_t code) { return code <= 4U || (code >= 8U && code <= 15U); }

/// Each side of a span is looked at in so many parts, so that patches may meet along some of a side. Four bits a part.
inline constexpr std::uint32_t kJointParts = 16;

/// The sides of a span, in the order of the kEndsAt... bits.
inline constexpr std::size_t kLowU = 0, kHighU = 1, kLowV = 2, kHighV = 3;

/// Normals that differ by no more than this across a joint make it a smooth one [rad].
inline constexpr double kMostBend = 0.05;

/// The widest gap across which two patches meet [mm]: what CAD systems leave between faces that belong together is some
/// hundredths of a millimetre, more where the design is large, and never much of a small one.
[[nodiscard]] constexpr double joint_gap(double half_diagonal) {
  constexpr double kGapMm = 0.08, kLeastShare = 1e-4, kMostShare = 2e-3;
  return std::max(std::min(kGapMm, kMostShare * half_diagonal), kLeastShare * half_diagonal);
}

[[nodiscard]] constexpr Joint joint_of_part(std::uint64_t parts, std::uint32_t part) {
  return static_cast<Joint>((parts >> (4U * part)) & 15U);
}
[[nodiscard]] constexpr std::uint64_t with_joint(std::uint64_t parts, std::uint32_t part, Joint joint) {
  return parts | static_cast<std::uint64_t>(joint) << (4U * part);
}

}  // namespace bladefit

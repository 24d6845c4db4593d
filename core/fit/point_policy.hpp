#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace bladefit {

/// What becomes of points whose foot is on an edge or a corner of the design.
enum class EdgePolicy : std::uint8_t {
  skip = 0,  ///< they are reported and do not count in the fit
  use = 1    ///< they count, with the unit vector from the foot to the point in place of the normal
};

/// Region of a point in the modes beside least squares.
enum class RegionPolicy : std::uint8_t {
  follow = 0,  ///< that of its present foot
  fixed = 1    ///< that of its foot at the least-squares fit
};

/// The words of the policies on the command line and in files, in the order of their values.
inline constexpr std::array<std::string_view, 2> kEdgePolicyWords = {"skip", "use"};
inline constexpr std::array<std::string_view, 2> kRegionPolicyWords = {"follow", "fixed"};

constexpr std::string_view word_of(EdgePolicy policy) { return kEdgePolicyWords[static_cast<std::size_t>(policy)]; }
constexpr std::string_view word_of(RegionPolicy policy) { return kRegionPolicyWords[static_cast<std::size_t>(policy)]; }

}  // namespace bladefit

#pragma once
#include <array>
#include <string_view>

namespace bladefit {

/// Which side of the surface is away from the material.
enum class OutwardOption {
  automatic,  ///< from the shape, or as stored in a .bfd
  plus,       ///< that of Su x Sv
  minus,      ///< the other one
};

/// The words of the sides on the command line and in files, in the order of their values.
inline constexpr std::array<std::string_view, 3> kOutwardWords = {"auto", "+", "-"};

}  // namespace bladefit

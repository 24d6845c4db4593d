#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/source/failure.hpp"

namespace bladefit {

/// Which side of the surface is away from the material.
enum class OutwardOption {
  automatic,  ///< from the shape, or as stored in a .bfd
  plus,       ///< that to which the faces look: of Su x Sv, where the file says nothing else
  minus,      ///< the other one
};

/// The words of the sides on the command line and in files, in the order of their values.
inline constexpr std::array<std::string_view, 3> kOutwardWords = {"auto", "+", "-"};

/// The side of the faces that a number, a name or a pattern means.
struct FaceSide {
  std::string face;
  bool plus = true;

  bool operator==(const FaceSide&) const = default;
};

/// The side of all faces, or of each by a list, in which the first that fits a face counts.
struct OutwardChoice {
  OutwardChoice(OutwardOption all_faces = OutwardOption::automatic) : all(all_faces) {}  // NOLINT: it is one of them

  OutwardOption all;
  std::vector<FaceSide> faces;  ///< empty: `all` counts

  bool operator==(const OutwardChoice&) const = default;
};

/// `+`, `-`, `auto`, or a list such as `SUCTION*:+,3:-`. Error: a line that names the text and the fix.
[[nodiscard]] Failure parse_outward(std::string_view text, OutwardChoice& choice);

}  // namespace bladefit

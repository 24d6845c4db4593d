#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "core/inspection/shaft_axis.hpp"
#include "core/inspection/tolerance_map.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

/// The window a:b of patch parameters, 0 <= a < b <= 1.
struct ParameterWindow {
  double low = 0, high = 1;
};

/// Largest permissible error of a machine, A + L/K in micrometres with L in mm.
struct ProbeError {
  double constant_um = 0;       ///< A
  double length_mm_per_um = 0;  ///< K; 0: no part that grows with the length
};

/// `A+L/K` as data sheets write it, or A alone. Error: a line that names the text and the fix.
[[nodiscard]] Failure parse_mpe(std::string_view text, ProbeError& error);

/// A zone of the leading edge: a box, or as much of the surface as is within a length along the sections from the edge.
struct EdgeZone {
  ParameterBox box;  ///< where `reach` is 0
  double reach = 0;  ///< on either side of the edge [mm], or in per cent of the section's chord
  bool percent = false;
};

/// A zone as on the command line: `auto:5mm` (mm, cm, in or m), `auto:3%`, or a box as below. Error: a line that names
/// the text and the fix.
[[nodiscard]] Failure parse_edge_zone(std::string_view text, EdgeZone& zone);

/// A place `x,y,z` as on the command line, in the units in which it was given. Error: a line that names the text and
/// the fix.
[[nodiscard]] Failure parse_place(std::string_view text, Vec3& place);

/// Which way a propeller turns, seen along the direction of its axis: right is clockwise.
enum class Rotation : std::uint8_t { right = 0, left = 1 };
inline constexpr std::array<std::string_view, 2> kRotationWords = {"right", "left"};

/// A leading-edge box as on the command line: `[PATCH:]u:0.4:0.6` or `[PATCH:]v:0.4:0.6`. Without PATCH it is patch 0;
/// the other parameter runs from 0 to 1. Error: a line that names the text and the fix.
[[nodiscard]] Failure parse_leading_edge(std::string_view text, ParameterBox& box);

/// Names of the degrees of freedom of the rigid motion, in the order of their bits.
inline constexpr std::array<std::string_view, 6> kDegreesOfFreedom = {"tx", "ty", "tz", "rx", "ry", "rz"};

/// Degrees of freedom as on the command line, `tx,rz`: bits 0 to 5 for tx, ty, tz, rx, ry, rz. Error: a line that names
/// the text and the fix.
[[nodiscard]] Failure parse_lock(std::string_view text, std::uint8_t& locked);

/// A window `a:b` as on the command line. Error: a line that names the text and the fix.
[[nodiscard]] Failure parse_window(std::string_view text, ParameterWindow& window);

/// A shaft axis as on the command line: `x`, `y`, `z`, or `x0,y0,z0,i,j,k`, a point of it and its direction of any
/// length. The point stays in the units in which it was given. Error: a line that names the text and the fix.
[[nodiscard]] Failure parse_axis(std::string_view text, ShaftAxis& axis);

}  // namespace bladefit

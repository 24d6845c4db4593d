#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/localizer.hpp"

namespace bladefit {

/// How the first foot of each point of a batch is found. With the last two it may be another local minimum than the
/// nearest: fit_points() proves them afterwards.
enum class FootStarts {
  searched,   ///< from the foot of the point before, then searched globally
  global,     ///< branch and bound, without a hint
  neighbour,  ///< Newton's method from the foot of the point before on the same path; the first of a path: global
  curves,     ///< Newton's method from the foot of the path's curve, which is followed along it (thesis 5.3)
};

/// The words of the ways, in the order of their values; the first cannot be asked for.
inline constexpr std::array<std::string_view, 4> kFootStartsWords = {"default", "global", "neighbour", "curves"};

/// The name on the command line. Throws ToolError for any other than curves, neighbour and global.
[[nodiscard]] FootStarts parse_starts(const std::string& text);

/// Where Newton's method is to start for each point.
struct FirstPlaces {
  std::vector<SurfacePlace> places;  ///< one a point
  std::uint32_t searches = 0;        ///< global searches that these took
};

/// The foot of each point at `config.start`, by a global search without a hint. Cost: one search a point.
[[nodiscard]] FirstPlaces searched_places(const Surface& surface, const LocalizerConfig& config,
                                          const std::vector<ProbePoint>& points);

/// The feet of the places of `points` on the cubics of their paths (points without a path number are one path), at
/// `config.start`. The curve's foot is followed by Newton's method along the curve; it is searched globally at its
/// beginning, and where it is lost or comes to an edge. Cost: a few evaluations a point.
[[nodiscard]] FirstPlaces places_along_curves(const Surface& surface, const LocalizerConfig& config,
                                              const std::vector<ProbePoint>& points);

/// Stages all points, their first feet found as `starts` says. Returns the number of global searches made besides those
/// that the localizer counts itself. Throws ToolError for a point that cannot be used; `name` names the points there.
std::uint32_t stage_points(Localizer& localizer, const Surface& surface, const LocalizerConfig& config,
                           const std::vector<ProbePoint>& points, FootStarts starts, const std::string& name);

}  // namespace bladefit

#pragma once
#include <array>
#include <string>
#include <vector>

#include "tools/results/result.hpp"

namespace bladefit {

/// The per cent of the chord that the table has columns for.
inline constexpr std::array<double, 14> kChordPercents = {0, 2.5, 5, 10, 20, 30, 40, 50, 60, 70, 80, 90, 95, 100};

/// For each measured radius, the tip first, and each of kChordPercents: the index of the point of that side that is
/// farthest off in tolerances of those nearest to both, -1 where none was probed. Points that do not count are left
/// out.
using ChordRow = std::array<std::ptrdiff_t, kChordPercents.size()>;
[[nodiscard]] std::vector<ChordRow> chord_rows(const Result& result, BladeSide side);

/// The table of distances by radius and per cent of the chord, one for each side. Empty where the leading edge is not
/// known.
[[nodiscard]] std::string chord_tables(const Result& result);

}  // namespace bladefit

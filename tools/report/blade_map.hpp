#pragma once
#include <string>

#include "tools/report/colour_scale.hpp"
#include "tools/report/tolerance_scale.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// An SVG drawing of the unrolled blade: one panel a patch, u to the right, v up, every point at its foot, coloured by
/// its signed distance. Out-of-tolerance points are ringed and carry + (cut) or - (weld), so that the map can be read
/// without colour. With a legend.
[[nodiscard]] std::string blade_map(const Result& result, const ColourScale& scale, const DrawnPoints& drawn);

/// The same of each leading-edge region that has a point out of tolerance, drawn as large as a whole blade, so that
/// neighbours come apart. Empty where there is none.
[[nodiscard]] std::string leading_edge_map(const Result& result, const ColourScale& scale, const DrawnPoints& drawn);

}  // namespace bladefit

#pragma once
#include <optional>

#include "tools/design/loft/sections_csv.hpp"

namespace bladefit {

/// Where the leading edge of a lofted surface lies in v, the parameter along its sections: from the smallest to the
/// largest value over the sections.
struct LeadingEdgeRange {
  double v_min = 1, v_max = 0;
};

/// The point of each section that is farthest from its trailing edge, by its chord-length parameter, which is v of the
/// lofted surface. Nothing where a section is open, so that its ends are no trailing edge: they are farther apart than
/// a fifth of its chord.
std::optional<LeadingEdgeRange> leading_edge_of(const BladeSections& sections);

}  // namespace bladefit

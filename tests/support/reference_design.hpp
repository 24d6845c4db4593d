#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "core/localizer.hpp"
#include "core/probe_point.hpp"
#include "tests/support/compiled_design.hpp"
#include "tests/support/reference_case.hpp"

namespace bladefit::testing {

/// How far the middle patch of the design "arl_3patch_gap" is moved from where it stands in "arl_3patch".
inline constexpr double kGapMm = 4e-3;

/// The design of a case of tests/data, or "arl_3patch_gap". Compiled while the tests were built; opened once.
const CompiledDesign& reference_design(const std::string& name);

/// The measured points of a subset [mm]; without approach vectors where the case does not use them.
std::vector<ProbePoint> points_of(const ReferenceCase& c, const ReferenceSubset& subset);
std::vector<ProbePoint> points_of(const ReferenceCase& c, const std::string& subset);

/// Every `stride`-th measured point of a case, from `first` on.
std::vector<ProbePoint> thinned(const ReferenceCase& c, std::size_t first, std::size_t stride);

/// What case.json asks of a fit, with room for `capacity` points.
LocalizerConfig config_of(const ReferenceCase& c, std::size_t capacity);

}  // namespace bladefit::testing

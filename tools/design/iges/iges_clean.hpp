#pragma once
#include <string>
#include <vector>

#include "tools/design/iges/iges_global.hpp"
#include "tools/design/iges/iges_parameters.hpp"

namespace bladefit {

/// An IGES file, checked, and its text as OpenCASCADE reads it without stumbling.
struct CleanIges {
  std::vector<IgesEntity> entities;  ///< views into the text that was given; entity k is also number k in `text`
  std::vector<IgesParameters> parameters;
  IgesGlobal global;
  std::string text;  ///< plain records of 80 columns, numbered, at scale 1; without the strings of the entities
  std::vector<std::string> warnings;
};

/// Checks all that is written in an IGES file: its frame (split_iges_text), that parameters are numbers or strings,
/// that references lead somewhere and not back, that B-spline surfaces have the knots, weights and control points that
/// they need. Throws ToolError naming line or entity.
CleanIges clean_iges_text(std::string_view text, const std::string& file);

}  // namespace bladefit

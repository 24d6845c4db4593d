#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tools/design/iges_global_text.hpp"
#include "tools/design/iges_surface_text.hpp"

namespace bladefit {

/// What the text of an IGES file says it holds.
struct IgesContents {
  IgesGlobal global;
  std::vector<IgesSurfaceRange> surfaces;  ///< the entities 128, in the order of the file
  std::map<int, int> type_counts;          ///< number of entities of each type
};

/// Checks the text of an IGES file before a library parses it: records of 80 columns numbered without gap, the sections
/// S, G, D, P and T with the counts of the T record, directory entries that point to existing parameter records, and
/// entities 128 with as many well-formed numbers as their counts ask for. Throws DesignError naming the line.
IgesContents check_iges_text(std::string_view text, const std::string& file);

}  // namespace bladefit

#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace bladefit {

inline constexpr int kIgesSurfaceType = 128;

struct IgesDelimiters {
  char parameter = ',', record = ';';
};

/// The parameter records of one entity.
struct IgesParameters {
  int directory_number;                   ///< of its directory entry, counted from 1
  std::size_t first_line;                 ///< line of the file of the first record, counted from 1
  std::vector<std::string_view> records;  ///< of which columns 1 to 64 are parameters
};

/// Where an entity 128 stands and the part of it that is used.
struct IgesSurfaceRange {
  int directory_number;
  double start_u, end_u, start_v, end_v;
};

/// Checks that the parameters of an entity 128 (rational B-spline surface) are finite numbers and at least as many as
/// its counts ask for, so that no parser runs past them. Returns the parameter range, the last four of them.
/// Throws DesignError naming entity, field and line.
IgesSurfaceRange check_iges_surface(const IgesParameters& parameters, const IgesDelimiters& delimiters,
                                    const std::string& file);

}  // namespace bladefit

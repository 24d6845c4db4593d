#pragma once
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "core/geometry/surface/design_image.hpp"
#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

inline constexpr int kIgesSurfaceType = 128;

/// Calls `visit(k)` for each control point number k of `surface` in the order of IGES, where the first index is the
/// fastest.
template <class Visit>
void iges_order(const NurbsSurface& surface, Visit visit) {
  const auto count_u = static_cast<std::size_t>(surface.u.control_points);
  const auto count_v = static_cast<std::size_t>(surface.v.control_points);
  for (std::size_t j = 0; j < count_v; ++j) {
    for (std::size_t i = 0; i < count_u; ++i) visit(i * count_v + j);
  }
}

/// One entity of an IGES file to be written.
struct IgesOutputEntity {
  int type = 0;
  std::string parameters;  ///< numbers separated by commas, the type first, without end mark
  int matrix = 0;          ///< directory number of its transformation matrix (entity 124), or 0
  std::string label;       ///< at most 8 characters
  int form = 0, level = 0;
  std::string status = "00000000";  ///< blank, subordinate, use and hierarchy, two digits each
};

/// What changes from file to file in the start and global sections; fields as they stand in the file.
struct IgesOutputHeader {
  std::string title = "Blade design surface";
  std::string file_name = "design.igs";  ///< at most 60 characters of ASCII
  std::string scale = "1.0";             ///< field 13
  std::string units = "2,2HMM";          ///< fields 14 and 15: flag and name
  std::string date = "20240101.000000";  ///< fields 18 and 25: YYYYMMDD.HHNNSS
  std::string resolution = "1.0D-06";    ///< field 19
  double largest_coordinate = 0;         ///< field 20
};

/// `value` in the fewest digits that read back as the same double, with the decimal point that IGES asks for and D as
/// its exponent letter (double precision).
std::string iges_real(double value);

/// The parameters of entity 128 (IGES 5.3, section 4.25) with the numbers of `surface` as they are.
std::string iges_surface_parameters(const NurbsSurface& surface);

/// A whole IGES 5.3 file. Throws ToolError where it needs more records than their numbers have digits for.
std::string iges_file_text(const IgesOutputHeader& header, const std::vector<IgesOutputEntity>& entities);

/// The design as an IGES file in `unit`, one entity 128 a patch, labelled PATCH1, PATCH2, ...
/// read_iges gives knots, weights and, in mm, coordinates back bit for bit; in inches it does so for coordinates that
/// came from inches, and to the last bit for others.
std::string iges_design_text(std::vector<NurbsSurface> surfaces, DesignUnit unit, const std::string& file_name,
                             std::chrono::system_clock::time_point written);

/// Writes the design to `path`, whole or not at all. Throws ToolError for a name that does not end in .igs or .iges,
/// and as OutputFile does.
void write_iges_design(const std::filesystem::path& path, const std::vector<NurbsSurface>& surfaces, DesignUnit unit);

}  // namespace bladefit

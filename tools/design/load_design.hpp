#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/outward_option.hpp"
#include "core/inspection/shaft_axis.hpp"
#include "tools/design/image/image_size.hpp"
#include "tools/design/nurbs/design_file.hpp"

namespace bladefit {

/// A design image, as the core takes it, and what a user should know of how it came about.
struct LoadedDesign {
  std::vector<std::byte> image;    ///< valid for DesignImage::open
  std::vector<std::string> notes;  ///< warnings, and the outward side taken and why; one line each
  std::string warning;             ///< what may make verdicts wrong; one line, empty = nothing
  std::vector<std::string> names;  ///< of the faces, one a patch, as the file has them; none of an image
};

/// What of a file is used, and how.
struct DesignChoice {
  DesignChoice(OutwardOption side) : outward(side) {}  // NOLINT: all faces, on one side
  DesignChoice(OutwardChoice side = {}, std::vector<std::string> face_names = {}, bool missing = false)  // NOLINT
      : outward(std::move(side)), faces(std::move(face_names)), allow_missing(missing) {}

  OutwardChoice outward;
  std::vector<std::string> faces;  ///< as faces_named() reads them; none = all
  bool allow_missing = false;      ///< faces that cannot be read are left out
  ImageSize size = ImageSize::fast;
  std::optional<std::size_t> blade;   ///< of a propeller, as keep_blade() counts; none = all faces
  std::optional<ShaftAxis> axis;      ///< about which its blades repeat, its point in units of `mm_per_unit`
  std::optional<double> mm_per_unit;  ///< none = those of the design file
};

/// The faces of one blade from several CAD files; patches keep the order of the files. Throws ToolError as read_design
/// does, and where the files are in different units.
[[nodiscard]] DesignFile read_designs(const std::vector<std::filesystem::path>& paths);

/// The design image of `path`: IGES and STEP are compiled in memory, .bfd is read as it is and validated.
/// A .bfd's side is turned where one is asked for; it has no faces to choose. Throws ToolError as read_design does, for
/// an image that is not valid, as faces_named(), keep_blade() and choose_sides() do, and where faces cannot be read.
LoadedDesign load_design(const std::filesystem::path& path, const DesignChoice& choice);

/// The faces of one blade from several files, in this order; all other things as above. One file may be a .bfd.
LoadedDesign load_design(const std::vector<std::filesystem::path>& paths, const DesignChoice& choice);

/// As parse_outward() of the command line. Throws ToolError.
OutwardChoice outward_choice(std::string_view text);

}  // namespace bladefit

#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/surface/design_image.hpp"
#include "tools/design/nurbs/nurbs_surface.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {

/// What a CAD file holds, checked and turned to mm.
struct DesignFile {
  std::vector<NurbsSurface> surfaces;  ///< at least one; patch k of the design is surfaces[k]
  DesignUnit unit = DesignUnit::mm;    ///< in which lengths of this design are shown
  std::vector<std::string> warnings;   ///< one line each: what was mended or left out
  std::vector<std::string>
      trimmed;  ///< faces bounded inside their surface, which is used whole; as the file names them
};

/// Which side of the surface is away from the material.
enum class OutwardOption {
  automatic,  ///< from the shape, or as stored in a .bfd
  plus,       ///< that of Su x Sv
  minus,      ///< the other one
};

/// A design image, as the core takes it, and what a user should know of how it came about.
struct LoadedDesign {
  std::vector<std::byte> image;    ///< valid for DesignImage::open
  std::vector<std::string> notes;  ///< warnings, and the outward side taken and why; one line each
  std::string warning;             ///< what may make verdicts wrong; one line, empty = nothing
};

/// Reads the B-spline surfaces of `path` (.igs .iges .stp .step, in any case of letters): those of IGES in the order of
/// the file, those of STEP in the order of the faces named PATCH1, PATCH2, ... or else of the file.
/// Throws DesignError where the file cannot be read, is damaged, holds no B-spline surface, names an unknown unit, or a
/// surface is not valid.
DesignFile read_design(const std::filesystem::path& path);

/// The design image of `path`: IGES and STEP are compiled in memory, .bfd is read as it is and validated.
/// With `outward` plus or minus a .bfd's side is turned to that. Throws DesignError as read_design does, for an image
/// that is not valid, and where `outward` is automatic but the shape does not tell.
LoadedDesign load_design(const std::filesystem::path& path, OutwardOption outward);

/// "+", "-" or "auto" as the command line spells them. Throws DesignError for anything else.
OutwardOption parse_outward(std::string_view text);

/// The extension of `path` in lower case, with its dot.
std::string lower_extension(const std::filesystem::path& path);

/// The whole file; `what` says in messages what is in it. Throws DesignError: bad_input where it does not exist or is a
/// folder, io_failure where reading fails.
std::string read_text(const std::filesystem::path& path, std::string_view what = "design");

}  // namespace bladefit

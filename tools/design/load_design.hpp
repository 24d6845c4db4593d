#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "config/outward_option.hpp"

namespace bladefit {

/// A design image, as the core takes it, and what a user should know of how it came about.
struct LoadedDesign {
  std::vector<std::byte> image;    ///< valid for DesignImage::open
  std::vector<std::string> notes;  ///< warnings, and the outward side taken and why; one line each
  std::string warning;             ///< what may make verdicts wrong; one line, empty = nothing
};

/// The design image of `path`: IGES and STEP are compiled in memory, .bfd is read as it is and validated.
/// With `outward` plus or minus a .bfd's side is turned to that. Throws ToolError as read_design does, for an image
/// that is not valid, and where `outward` is automatic but the shape does not tell.
LoadedDesign load_design(const std::filesystem::path& path, OutwardOption outward);

/// "+", "-" or "auto" as the command line spells them. Throws ToolError for anything else.
OutwardOption parse_outward(std::string_view text);

}  // namespace bladefit

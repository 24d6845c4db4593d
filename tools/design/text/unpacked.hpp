#pragma once
#include <cstddef>
#include <string>

namespace bladefit {

/// Bytes that what a compressed file holds may have.
inline constexpr std::size_t kMostUnpacked = std::size_t{1} << 29U;

/// What a gzip file holds, or of a ZIP archive the one file in it that is named as a CAD file; `content` itself where
/// it is neither. What it grows to is counted before memory is taken for it. Throws ToolError that names `file`:
/// damaged or cut off, more than `most` bytes, no or several CAD files in the archive, encrypted or packed by a method
/// other than deflate. Cost: a second for some hundred megabytes.
[[nodiscard]] std::string unpacked(std::string content, const std::string& file, std::size_t most = kMostUnpacked);

}  // namespace bladefit

#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace bladefit {

enum class ZipMethod : std::uint16_t { stored = 0, deflated = 8 };

/// A file in a ZIP archive.
struct ZipEntry {
  std::string name;
  std::string_view data;  ///< as it is packed; part of the archive
  ZipMethod packed_by = ZipMethod::stored;
  std::uint32_t check_sum = 0;  ///< CRC-32 of the file
};

/// The one file of `archive` that is named as a STEP or IGES file. Throws ToolError that names `file`: the archive is
/// damaged, has none or several of them, or it is encrypted or packed by another method. Cost: linear in the number of
/// files.
[[nodiscard]] ZipEntry cad_entry(std::string_view archive, const std::string& file);

}  // namespace bladefit

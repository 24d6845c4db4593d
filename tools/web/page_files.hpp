#pragma once
#include <span>
#include <string_view>

namespace bladefit {

/// A file of the page as it was when the program was built.
struct PageFile {
  std::string_view path;                ///< as it is asked for, from / on
  std::string_view type;                ///< MIME
  std::span<const unsigned char> gzip;  ///< its content, compressed (RFC 1952)
};

/// All files of the page; none where the program was built without it.
[[nodiscard]] std::span<const PageFile> page_files();

}  // namespace bladefit

#pragma once
#include <cstddef>
#include <string>

namespace bladefit {

/// Reads the file at `path`, which may have up to `largest` bytes, into `text`. Returns why it cannot be read, in
/// words; empty = it was.
[[nodiscard]] std::string read_file(const std::string& path, std::size_t largest, std::string& text);

}  // namespace bladefit

#pragma once
#include <cstddef>
#include <string>

#include "drivers/source/failure.hpp"

namespace bladefit {

/// Reads the file at `path`, which may have up to `largest` bytes, into `text`. bad_input: why it
/// cannot be read, without its name.
[[nodiscard]] Failure read_file(const std::string& path, std::size_t largest, std::string& text);

}  // namespace bladefit

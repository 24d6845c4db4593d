#pragma once
#include <cstddef>
#include <string>

#include "drivers/source/failure.hpp"

namespace bladefit {

/// Reads the file at `path`, which may have up to `largest` bytes, into `text`; - is standard input. What is too large
/// by its size is refused before it is read, and so are folders and devices without an end. A pipe that nobody writes
/// to for 15 s is given up. The message says why the file cannot be read and what to do, without its name; bad_input,
/// or `device` where reading itself fails.
[[nodiscard]] Failure read_file(const std::string& path, std::size_t largest, std::string& text);

/// How messages name the file: its path, or "standard input".
[[nodiscard]] std::string file_name(const std::string& path);

}  // namespace bladefit

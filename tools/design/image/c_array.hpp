#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace bladefit {

/// The name of the array in a C file called `path`: its stem and "_design", for example "fan_design" of fan.c.
std::string c_array_name(const std::filesystem::path& path);

/// C99 source that defines the design image as `const uint64_t NAME[]`, which is aligned to 8 bytes, and its length in
/// bytes as `const size_t NAME_size`. For little-endian targets, as the image is. The size of `image` is a multiple
/// of 8.
std::string c_array_source(std::span<const std::byte> image, const std::string& name, const std::string& origin);

}  // namespace bladefit

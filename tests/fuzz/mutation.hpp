#pragma once
#include <random>
#include <span>
#include <string>

namespace bladefit::fuzz {

/// The input changed in one to eight places: bytes, numbers and pieces of it replaced, dropped, repeated, or taken from
/// another input of the corpus. The same generator gives the same input everywhere. At most kLongestInput bytes.
[[nodiscard]] std::string mutated(std::string input, std::span<const std::string> corpus, std::mt19937_64& random);

inline constexpr std::size_t kLongestInput = 1U << 17U;

}  // namespace bladefit::fuzz

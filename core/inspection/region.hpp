#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace bladefit {

/// The two parts of a blade that figures are summed up in.
enum class Region : std::uint8_t { rest = 0, leading_edge = 1 };

/// The words of both in results, in the order of their values.
inline constexpr std::array<std::string_view, 2> kRegionWords = {"rest", "leading_edge"};

constexpr std::string_view word_of(Region region) { return kRegionWords[static_cast<std::size_t>(region)]; }

}  // namespace bladefit

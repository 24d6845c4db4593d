#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/localizer/localizer_parts.hpp"

namespace bladefit {

/// Of a localizer's block and of every part in it [bytes].
inline constexpr std::size_t kBlockAlignment = 64;

constexpr std::uint64_t rounded_up(std::uint64_t size) {
  return (size + kBlockAlignment - 1) / kBlockAlignment * kBlockAlignment;
}

/// The parts and what they own in memory, at their sizes, as Localizer::memory_parts() tells them.
[[nodiscard]] std::array<MemoryPart, 9> parts_in_memory(const LocalizerConfig& config);

/// Makes the parts at `place`, which has room for them all, with nothing in them. Cost: linear in the capacity.
[[nodiscard]] LocalizerParts& build_parts(std::byte* place, const DesignImage& design, const LocalizerConfig& config);

}  // namespace bladefit

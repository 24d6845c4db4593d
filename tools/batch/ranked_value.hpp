#pragma once
#include <cstddef>
#include <functional>

namespace bladefit {

/// Gives numbers, the same ones in every call.
using EachNumber = std::function<void(const std::function<void(double)>&)>;

/// The number of this rank, from 0 on, among numbers that are not negative; there are more than `rank`. Exact, with
/// memory that does not depend on their number: four passes over them, each of which fixes 16 bits of the answer.
[[nodiscard]] double ranked_value(std::size_t rank, const EachNumber& each);

}  // namespace bladefit

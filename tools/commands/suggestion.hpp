#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace bladefit {

/// The least number of letters to insert, drop, replace or swap with the next one that makes `b` of `a`.
/// Cost: the product of the lengths.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// " (did you mean WORD?)" for the nearest of `words` that is no more than a third of its letters off; empty where
/// there is none.
[[nodiscard]] std::string suggestion(std::string_view mistyped, const std::vector<std::string>& words);

}  // namespace bladefit

#pragma once
#include <cstddef>
#include <string>

#include "tools/results/result.hpp"

namespace bladefit {

/// The defects from `first` on, `most` of them at most, a row each, the worst first, with a word on those not shown.
[[nodiscard]] std::string defect_table(const Result& result, std::size_t first, std::size_t most);

/// The name of a defect in tables and pictures, "D1" for the worst.
[[nodiscard]] std::string defect_name(std::size_t index);

/// "suction", "pressure", "nose"; empty where it is not known.
[[nodiscard]] std::string side_text(BladeSide side);

/// Which row of the result's points has that sequence; the number of points where none has.
[[nodiscard]] std::size_t index_of_sequence(const Result& result, std::uint32_t sequence);

}  // namespace bladefit

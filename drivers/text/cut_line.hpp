#pragma once
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "drivers/source/failure.hpp"

namespace bladefit {

/// Notices a last line that ends in the middle of a number: it has no line end, and fewer decimals than all lines
/// before it, which have the same number of them.
class CutLine {
 public:
  /// `ended`: the line of these cells has a line end. The error is a phrase.
  [[nodiscard]] Failure check(const std::vector<std::string_view>& cells, bool ended);

 private:
  std::optional<std::size_t> decimals_;  ///< of the last number of a line
  std::size_t lines_ = 0;
  bool same_ = true;
};

}  // namespace bladefit

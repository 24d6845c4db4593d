#pragma once
#include <string>
#include <string_view>

#include "tools/results/result.hpp"

namespace bladefit {

/// The text with control characters, and bytes that are not UTF-8, as U+FFFD: what XML allows.
[[nodiscard]] std::string clean_text(std::string_view text);

/// The clean text with & < > " ' written so that HTML, SVG and XML show them and never take them for markup.
[[nodiscard]] std::string escaped(std::string_view text);

/// Writes the lengths of a result, given in mm, in its units and all with the same number of decimals.
class LengthText {
 public:
  explicit LengthText(const Result& result) : result_(result), decimals_(result.units == "in" ? 5 : 4) {}

  /// "0.1000"; "-" for infinity, where nothing is known or asked for.
  [[nodiscard]] std::string plain(double length) const;
  /// "+0.3100".
  [[nodiscard]] std::string with_sign(double length) const;
  /// "0.1000 mm".
  [[nodiscard]] std::string with_unit(double length) const;
  /// "+0.3100 mm".
  [[nodiscard]] std::string with_sign_and_unit(double length) const;

 private:
  const Result& result_;
  int decimals_;
};

/// A word of the files as people write it: "leading edge".
[[nodiscard]] std::string readable(std::string_view word);

/// The clean text, its middle left out where it has more than `most` bytes.
[[nodiscard]] std::string shortened(std::string_view text, std::size_t most);

/// "1 point", "12 points".
[[nodiscard]] std::string counted(std::size_t count, std::string_view noun);

}  // namespace bladefit

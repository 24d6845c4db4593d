#pragma once
#include <string>
#include <string_view>

namespace bladefit {

/// The text with & < > " ' written so that HTML and SVG show them and never take them for markup.
[[nodiscard]] std::string escaped(std::string_view text);

/// Writes lengths of a report, all with the same number of decimals.
class LengthText {
 public:
  explicit LengthText(const std::string& units) : units_(units), decimals_(units == "in" ? 5 : 4) {}

  /// "0.1000"; "-" for infinity, where nothing is known or asked for.
  [[nodiscard]] std::string plain(double length) const;
  /// "+0.3100".
  [[nodiscard]] std::string with_sign(double length) const;
  /// "0.1000 mm".
  [[nodiscard]] std::string with_unit(double length) const;
  /// "+0.3100 mm".
  [[nodiscard]] std::string with_sign_and_unit(double length) const;

  [[nodiscard]] const std::string& units() const { return units_; }

 private:
  std::string units_;
  int decimals_;
};

/// "1 point", "12 points".
[[nodiscard]] std::string counted(std::size_t count, std::string_view noun);

}  // namespace bladefit

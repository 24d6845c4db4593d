#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/dro/dro_settings.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

/// A number of a read-out, and how it was printed.
struct DroNumber {
  double mm = 0;
  std::size_t pad = 0;    ///< separators between what stands before it and its first digit
  std::size_t width = 0;  ///< characters from there to its last digit, the sign among them
  std::size_t whole_digits = 0, decimals = 0;
  bool zero_padded = false;  ///< a 0 stands before other whole digits
  bool marked = false;       ///< it has a decimal mark
  std::string marks;         ///< that stand behind it, upper case: inches are `"`, millimetres `mm`
};

/// A line of a read-out: the axes that stand in it.
struct DroLine {
  std::array<std::optional<DroNumber>, 3> axes;  ///< x, y, z
  /// A beginning that was lost would show: a label, a separator or a sign stands before the first digit.
  bool shows_its_beginning = true;

  [[nodiscard]] std::size_t count() const;
  [[nodiscard]] std::size_t first_axis() const;  ///< of x, y, z; 3 = none
};

/// "X", "Y" or "Z".
[[nodiscard]] char axis_letter(std::size_t axis);

/// Reads one line: three numbers, or one of a labelled axis where settings.layout allows it. A label says which axis it
/// is; without labels settings.order does. A sign may stand apart from its digits by blanks.
/// bad_input: what is wrong in words; then `line` is as before.
[[nodiscard]] Failure parse_dro_line(std::string_view text, const DroSettings& settings, DroLine& line);

}  // namespace bladefit

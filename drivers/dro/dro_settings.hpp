#pragma once
#include <chrono>
#include <optional>
#include <string>

#include "drivers/serial/line_settings.hpp"

namespace bladefit {

/// How many axes stand in a line of a read-out.
enum class DroLayout : std::uint8_t { open, whole_points, single_axes };

/// Plain read-out lines, such as "X +0123.4567 Y -0001.2000 Z 0000.0000", or one such line for each axis.
struct DroSettings {
  SerialLineSettings line;
  double mm_per_unit = 1;              ///< of the lines
  std::optional<double> scale;         ///< [units] of one count, of numbers without a decimal mark
  std::string order = "xyz";           ///< of the numbers, each of x, y, z once; labels say more than it does
  bool order_given = false;            ///< somebody has said so; else the first axis of a point is seen from pauses
  bool labels = true;                  ///< a letter X, Y or Z stands before each number
  DroLayout layout = DroLayout::open;  ///< open: as the first lines are
  std::string separators = " \t,;:=";  ///< characters that part labels and numbers
  char decimal_mark = '.';
  bool fixed_decimals = true;  ///< a number of an axis always has as many decimals; false: zeros at the end are dropped
  std::string marks = "RA";    ///< letters that may stand behind a number and change nothing (radius, actual value)
  std::string ignore_prefix = "#";                    ///< lines that begin with this are no points; empty = none
  std::chrono::milliseconds reconnect_first{50};      ///< first pause before opening the port again; it doubles ...
  std::chrono::milliseconds reconnect_longest{1000};  ///< ... up to this
};

}  // namespace bladefit

#pragma once
#include <chrono>
#include <string>

#include "drivers/serial/line_settings.hpp"

namespace bladefit {

/// Plain read-out lines, such as "X +0123.4567 Y -0001.2000 Z 0000.0000".
struct DroSettings {
  SerialLineSettings line;
  double mm_per_unit = 1;              ///< of the lines
  std::string order = "xyz";           ///< of the numbers in a line; each of x, y, z once
  bool labels = true;                  ///< a letter X, Y or Z stands before each number
  std::string separators = " \t,;:=";  ///< characters that part labels and numbers
  char decimal_mark = '.';
  std::string ignore_prefix = "#";                    ///< lines that begin with this are no points; empty = none
  std::chrono::milliseconds reconnect_first{50};      ///< first pause before opening the port again; it doubles ...
  std::chrono::milliseconds reconnect_longest{1000};  ///< ... up to this
};

}  // namespace bladefit

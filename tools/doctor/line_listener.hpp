#pragma once
#include <string>
#include <vector>

#include "drivers/serial/line_settings.hpp"
#include "drivers/source/failure.hpp"
#include "tools/doctor/examination.hpp"

namespace bladefit {

/// What came from a serial line.
struct Heard {
  struct Line {
    std::string text;  ///< without its end
    Deadline at;       ///< when its end came
  };

  Failure failure;          ///< why the port cannot be opened or has hung up
  std::vector<Line> lines;  ///< whole ones; the first may lack its beginning
  std::size_t bytes = 0;
};

/// Opens the port, listens until so many lines have come, until `until` at the latest, and closes it. Nothing is sent.
[[nodiscard]] Heard listen(const SerialLineSettings& line, std::size_t lines, Deadline until);

/// What was heard, with the parity bits that stand in the eighth bit of every byte left out; nothing where they do not
/// all agree. `parity` becomes theirs.
[[nodiscard]] std::vector<Heard::Line> without_parity(const Heard& heard, Parity& parity);

/// A line as it can be printed.
[[nodiscard]] std::string printable(std::string_view line);

}  // namespace bladefit

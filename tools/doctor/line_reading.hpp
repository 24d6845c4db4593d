#pragma once
#include <string>
#include <vector>

#include "drivers/dro/dro_settings.hpp"
#include "tools/doctor/line_listener.hpp"

namespace bladefit {

/// What lines are with one format.
struct LineReading {
  std::vector<std::string> changes;  ///< settings to write into the device file for it
  std::vector<ProbePoint> points;
  std::size_t readable = 0;  ///< lines that are of the format
  std::size_t lines = 0;
  std::string fault;  ///< of the first that is not

  /// Most lines are of the format. The first one counts only where it is: its beginning may be missing.
  [[nodiscard]] bool makes_sense() const;
};

/// The lines as those of serial protocol v1.
[[nodiscard]] LineReading read_protocol(const std::vector<Heard::Line>& lines);

/// The lines as those of a read-out: with these settings, and where they make no sense of them with other decimal
/// marks, with and without labels. What makes most sense.
[[nodiscard]] LineReading read_readout(const std::vector<Heard::Line>& lines, const DroSettings& settings);

}  // namespace bladefit

#pragma once
#include <string>
#include <utility>

#include "drivers/probe_source.hpp"

namespace bladefit {

/// Publishes a fault: one more in a row, and in words.
inline void note_fault(SourceStatus& status, std::string text) {
  ++status.consecutive_faults;
  status.last_fault = std::move(text);
}

/// Publishes a good exchange. The newest fault stays readable.
inline void note_good(SourceStatus& status) { status.consecutive_faults = 0; }

}  // namespace bladefit

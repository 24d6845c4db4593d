#pragma once
#include <algorithm>
#include <string>
#include <utility>

#include "drivers/source/probe_source.hpp"

namespace bladefit {

/// Publishes a fault: one more in a row, and in words.
inline void note_fault(SourceStatus& status, std::string text) {
  ++status.consecutive_faults;
  status.last_fault = std::move(text);
}

/// Publishes that records are lost for good, as a fault and by itself.
inline void note_loss(SourceStatus& status, const std::string& text) {
  ++status.losses;
  status.last_loss = text;
  note_fault(status, text);
}

/// The same of records that had no number yet.
inline void note_unnumbered_loss(SourceStatus& status, const std::string& text) {
  ++status.unnumbered_losses;
  note_loss(status, text);
}

/// Publishes what the user should know, as a fault and by itself, the latter once; no record is lost by it.
inline void note_remark(SourceStatus& status, const std::string& text) {
  if (std::ranges::find(status.remarks, text) == status.remarks.end()) status.remarks.push_back(text);
  note_fault(status, text);
}

/// Which records are lost, in the operator's words.
inline std::string lost_points(std::uint32_t first, std::uint32_t last, const std::string& why) {
  if (first == last) return "point " + std::to_string(first) + " is lost: " + why + "; probe it again";
  return "points " + std::to_string(first) + ".." + std::to_string(last) + " are lost: " + why + "; probe them again";
}

/// Publishes that nothing more will be delivered.
inline void note_stop(SourceStatus& status, const std::string& text) {
  status.finished = false;
  status.stopped = text;
  note_fault(status, text);
}

/// Publishes a good exchange. The newest fault stays readable.
inline void note_good(SourceStatus& status) { status.consecutive_faults = 0; }

}  // namespace bladefit

#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "drivers/source/failure.hpp"
#include "firmware_bridge/host/journal/journal_format.hpp"

namespace bladefit {

/// What a journal on disk holds.
struct JournalContent {
  bool exists = false;  ///< false: no journal, or one whose header was never completed
  SessionIdentity identity;
  std::uint32_t run_id = 0;         ///< of the device; 0 where it has none
  std::vector<StreamEvent> events;  ///< in the order in which they came
  std::uint64_t torn_bytes = 0;     ///< bytes of a record or group of records at the end that was never completed
};

/// Reads a journal. A torn tail is left out: what was not completed was never acknowledged. A file that is no journal,
/// is of another version, or is damaged before its last group is refused (bad_input); a read error is `device`.
[[nodiscard]] Failure read_journal(const std::string& path, JournalContent& content);

}  // namespace bladefit

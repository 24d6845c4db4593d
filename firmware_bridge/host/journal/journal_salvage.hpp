#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "drivers/source/failure.hpp"
#include "firmware_bridge/host/journal/journal_format.hpp"

namespace bladefit {

/// Records of a journal that follow each other and are not whole.
struct DamagedRecords {
  std::uint32_t first = 0, last = 0;  ///< places in the file, from 1
  std::uint32_t point_before = 0;     ///< sequence of the newest whole point before them; 0 = none
  std::uint32_t point_after = 0;      ///< and of the first one behind them; 0 = none
};

/// What can still be read of a journal, however it was damaged.
struct Salvage {
  bool header_whole = false;  ///< else identity and run are not known
  SessionIdentity identity;
  std::uint32_t run_id = 0;
  std::uint64_t records = 0;        ///< in the file, whole or not
  std::uint64_t torn_bytes = 0;     ///< of an incomplete record at the end
  std::vector<StreamEvent> events;  ///< of the whole records, in their order
  std::vector<DamagedRecords> damaged;
};

/// Reads the journal at `path` and leaves out what is damaged: a record is believed where its check sum holds, which
/// knows its place in the file. bad_input: there is no such file, or it is of another version; `device`: it cannot be
/// read.
[[nodiscard]] Failure salvage_journal(const std::string& path, Salvage& salvage);

}  // namespace bladefit

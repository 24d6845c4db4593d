#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "drivers/source/failure.hpp"
#include "firmware_bridge/host/journal/journal_format.hpp"

namespace bladefit {

/// What a journal on disk holds, beside its events.
struct JournalSummary {
  bool exists = false;  ///< false: no journal, or one whose header was never completed
  SessionIdentity identity;
  std::uint32_t run_id = 0;      ///< of the device; 0 where it has none
  std::uint64_t records = 0;     ///< whole ones, each an event
  std::uint64_t torn_bytes = 0;  ///< bytes of a record or group of records at the end that was never completed
};

/// A journal that is read record by record, so that its length costs no memory.
class JournalReader {
 public:
  JournalReader() = default;
  ~JournalReader();
  JournalReader(const JournalReader&) = delete;
  JournalReader& operator=(const JournalReader&) = delete;

  /// Opens and checks the file at `path`. A torn tail is left out: what was not completed was never acknowledged. A
  /// file that is no journal, is of another version, or is damaged before its last group is refused (bad_input); a read
  /// error is `device`. A missing file is no error.
  [[nodiscard]] Failure open(const std::string& path);

  /// The same of a file that is open already, whatever has become of its name. The descriptor stays the caller's.
  [[nodiscard]] Failure open(int descriptor, const std::string& path);

  [[nodiscard]] const JournalSummary& summary() const { return summary_; }

  /// Gives every event, in the order in which they came. `device`: the file can no longer be read.
  [[nodiscard]] Failure for_each(const std::function<void(const StreamEvent&)>& visit) const;

 private:
  [[nodiscard]] Failure check();

  std::string path_;
  int descriptor_ = -1;
  bool owned_ = false;
  JournalSummary summary_;
};

/// What a journal holds, its events included.
struct JournalContent : JournalSummary {
  std::vector<StreamEvent> events;  ///< in the order in which they came
};

/// Reads a whole journal, as JournalReader does.
[[nodiscard]] Failure read_journal(const std::string& path, JournalContent& content);

}  // namespace bladefit

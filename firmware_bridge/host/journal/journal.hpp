#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "drivers/source/failure.hpp"
#include "firmware_bridge/host/journal/journal_format.hpp"

namespace bladefit {

/// Records that one group commit writes at most. A crash can damage the last group only: each record says to which
/// group it belongs.
inline constexpr std::size_t kJournalGroup = 256;

/// Appends events to the journal of a session. One thread at a time owns it. The file is locked against a second host,
/// and is removed again when the session ends before it has a header.
class Journal {
 public:
  Journal() = default;
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Opens `path` (made when it is missing) and locks it. bad_input when another host holds it; `device` when the
  /// folder cannot be written.
  [[nodiscard]] Failure open(const std::string& path);

  /// Starts the file again with a header, on disk when this returns.
  [[nodiscard]] Failure start(const SessionIdentity& identity, std::uint32_t run_id);

  /// Goes on after the `records` whole records that a JournalReader found; whatever follows them is cut off.
  [[nodiscard]] Failure resume(std::uint64_t records);

  /// Appends up to kJournalGroup events; they are on disk when this returns without error. After an error the file
  /// ends where it ended before.
  [[nodiscard]] Failure append(std::span<const StreamEvent> events);

  /// `device`: the file was removed from its folder. What it holds can be read as long as it is open, and is gone then:
  /// nothing in it may be acknowledged any more.
  [[nodiscard]] Failure check_link() const;

  /// The open file.
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  [[nodiscard]] Failure write_at_end(std::span<const std::byte> bytes);
  [[nodiscard]] Failure cut_to(std::uint64_t size);
  [[nodiscard]] Failure failure(const char* what) const;

  std::string path_;
  int descriptor_ = -1;
  bool locked_ = false;
  std::uint64_t size_ = 0;
  std::uint32_t records_ = 0;
};

}  // namespace bladefit

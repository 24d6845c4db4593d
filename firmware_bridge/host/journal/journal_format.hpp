#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_bridge/host/threads/stream_event.hpp"

namespace bladefit {

/// Journal of a session, little endian: one JournalHeader, then JournalRecords to the end of the file.
inline constexpr std::array<char, 8> kJournalMagic = {'B', 'F', 'J', 'R', 'N', 'L', '\r', '\n'};
/// Version 6: a record of the device that is given up is told at once, and not by the point after it alone.
inline constexpr std::uint32_t kJournalVersion = 6;
/// Older ones that are read: version 5 has all of it but that.
inline constexpr std::uint32_t kOldestJournalVersion = 5;

/// What a session is bound to: its points mean something for this design and these settings only.
struct SessionIdentity {
  std::uint32_t design_crc = 0;     ///< DesignImage::identity()
  std::uint64_t config_digest = 0;  ///< config_digest(): of every setting
};

struct JournalHeader {
  std::array<char, 8> magic;
  std::uint32_t version;
  std::uint32_t design_crc;
  std::uint64_t config_digest;
  std::uint32_t run_id;  ///< of the device; 0 where it has none
  std::uint32_t crc;     ///< CRC-32 of the bytes before it
};

struct JournalRecord {
  std::uint32_t sequence;
  std::uint16_t path;
  EventKind kind;
  std::uint8_t reserved;
  std::array<double, 3> position;  ///< [mm]
  std::array<double, 3> approach;
  double weight;
  std::int64_t time_us;
  std::uint32_t group;  ///< place of the first record of the group that it was committed with
  std::uint32_t crc;    ///< CRC-32 of the bytes before it, seeded with the record's place in the file (the first is 1)
};

static_assert(sizeof(JournalHeader) == 32 && sizeof(JournalRecord) == 80);
static_assert(std::endian::native == std::endian::little, "the journal is written in the byte order of the host");

[[nodiscard]] JournalHeader make_journal_header(const SessionIdentity& identity, std::uint32_t run_id,
                                                std::uint32_t version = kJournalVersion);
[[nodiscard]] bool header_is_whole(const JournalHeader& header);

/// `place` counts records from 1: a record that has moved within the file is as bad as a damaged one. `group` is the
/// place of the first record that is committed together with it.
[[nodiscard]] JournalRecord make_journal_record(const StreamEvent& event, std::uint32_t place, std::uint32_t group);
[[nodiscard]] bool record_is_whole(const JournalRecord& record, std::uint32_t place);
[[nodiscard]] StreamEvent event_of(const JournalRecord& record);

}  // namespace bladefit

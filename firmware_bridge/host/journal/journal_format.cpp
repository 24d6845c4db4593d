#include "firmware_bridge/host/journal/journal_format.hpp"

#include "core/crc32.hpp"

namespace bladefit {
namespace {

template <typename Block>
std::uint32_t crc_before(const Block& block, std::size_t crc_offset, std::uint32_t seed) {
  return crc32(std::as_bytes(std::span(&block, 1)).first(crc_offset), seed);
}

bool kind_is_known(EventKind kind) { return kind >= EventKind::point && kind <= EventKind::lost; }

}  // namespace

JournalHeader make_journal_header(const SessionIdentity& identity, std::uint32_t run_id, std::uint32_t version) {
  JournalHeader header{kJournalMagic, version, identity.design_crc, identity.config_digest, run_id, 0};
  header.crc = crc_before(header, offsetof(JournalHeader, crc), 0);
  return header;
}

bool header_is_whole(const JournalHeader& header) {
  return header.crc == crc_before(header, offsetof(JournalHeader, crc), 0);
}

JournalRecord make_journal_record(const StreamEvent& event, std::uint32_t place, std::uint32_t group) {
  const ProbePoint& point = event.point;
  JournalRecord record{point.sequence, point.path,   event.kind,    0,     point.position,
                       point.approach, point.weight, point.time_us, group, 0};
  record.crc = crc_before(record, offsetof(JournalRecord, crc), place);
  return record;
}

bool record_is_whole(const JournalRecord& record, std::uint32_t place) {
  return record.crc == crc_before(record, offsetof(JournalRecord, crc), place) && kind_is_known(record.kind);
}

StreamEvent event_of(const JournalRecord& record) {
  return {record.kind, {record.sequence, record.path, record.position, record.approach, record.time_us, record.weight}};
}

}  // namespace bladefit

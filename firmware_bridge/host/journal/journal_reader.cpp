#include "firmware_bridge/host/journal/journal_reader.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <span>

namespace bladefit {
namespace {

Failure read_bytes(const std::string& path, std::vector<std::byte>& bytes) {
  errno = 0;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file && errno == ENOENT) return {};
  if (file) {
    bytes.resize(static_cast<std::size_t>(file.tellg()));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  if (file) return {};
  return device_failure(fmt::format("{}: cannot be read ({}); check the disk and the rights of the folder", path,
                                    std::strerror(errno != 0 ? errno : EIO)));
}

Failure check_header(const std::string& path, const JournalHeader& header) {
  if (header.magic != kJournalMagic) {
    return bad_input(fmt::format("{}: is no journal of a session; name another session folder", path));
  }
  if (header.version != kJournalVersion) {
    const char* why = header.version < kJournalVersion ? ", which does not tell of lost points" : "";
    return bad_input(
        fmt::format("{}: journal of format version {}{}; this program reads version {}: use the program that wrote it, "
                    "or name another "
                    "session folder",
                    path, header.version, why, kJournalVersion));
  }
  if (!header_is_whole(header)) {
    return bad_input(
        fmt::format("{}: the header is damaged; copy the file from a backup, or name another "
                    "session folder",
                    path));
  }
  return {};
}

JournalRecord record_at(std::span<const std::byte> records, std::size_t index) {
  JournalRecord record;
  std::memcpy(&record, records.data() + index * sizeof record, sizeof record);
  return record;
}

std::uint32_t place_of(std::size_t index) { return static_cast<std::uint32_t>(index + 1); }

}  // namespace

Failure read_journal(const std::string& path, JournalContent& content) {
  content = {};
  std::vector<std::byte> bytes;
  if (const Failure error = read_bytes(path, bytes)) return error;
  JournalHeader header;
  // The header is on disk before the first point is asked for: a shorter file holds nothing that was acknowledged.
  if (bytes.size() < sizeof header) return {};
  std::memcpy(&header, bytes.data(), sizeof header);
  if (const Failure error = check_header(path, header)) return error;
  content.exists = true;
  content.identity = {header.design_crc, header.config_digest};
  content.run_id = header.run_id;

  const std::span<const std::byte> records = std::span(bytes).subspan(sizeof header);
  const std::size_t count = records.size() / sizeof(JournalRecord);
  std::size_t whole = 0;
  while (whole < count && record_is_whole(record_at(records, whole), place_of(whole))) ++whole;
  for (std::size_t later = whole + 1; later < count; ++later) {
    const JournalRecord record = record_at(records, later);
    // A group is begun when the one before it is on disk.
    if (!record_is_whole(record, place_of(later)) || record.group <= place_of(whole)) continue;
    return bad_input(
        fmt::format("{}: record {} is damaged although records that were stored after it are "
                    "whole, so this is no torn end; nothing was changed: copy the file from a "
                    "backup, or name another session folder",
                    path, place_of(whole)));
  }
  content.events.reserve(whole);
  for (std::size_t index = 0; index < whole; ++index) content.events.push_back(event_of(record_at(records, index)));
  content.torn_bytes = records.size() - whole * sizeof(JournalRecord);
  return {};
}

}  // namespace bladefit

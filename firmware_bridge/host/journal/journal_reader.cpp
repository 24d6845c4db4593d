#include "firmware_bridge/host/journal/journal_reader.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "firmware_bridge/host/journal/journal_file.hpp"

namespace bladefit {

JournalReader::~JournalReader() {
  if (owned_) close(descriptor_);
}

Failure JournalReader::open(const std::string& path) {
  path_ = path;
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  owned_ = descriptor_ >= 0;
  if (!owned_) return errno == ENOENT ? Failure{} : unreadable_journal(path);
  return check();
}

Failure JournalReader::open(int descriptor, const std::string& path) {
  path_ = path;
  descriptor_ = descriptor;
  return check();
}

Failure JournalReader::check() {
  JournalHeader header;
  const auto size = read_at(descriptor_, std::as_writable_bytes(std::span(&header, 1)), 0);
  if (!size) return unreadable_journal(path_);
  // The header is on disk before the first point is asked for: a shorter file holds nothing that was acknowledged.
  if (*size < sizeof header) return {};
  if (Failure error = check_journal_kind(path_, header)) return error;
  if (!header_is_whole(header)) {
    return bad_input(
        fmt::format("{}: the header is damaged; copy the file from a backup, save its points with "
                    "`bladefit recover`, or name another session folder",
                    path_));
  }
  summary_ = {.exists = true, .identity = {header.design_crc, header.config_digest}, .run_id = header.run_id};
  std::uint32_t bad = 0, last = 0;
  bool torn = true;
  const bool read = visit_records(descriptor_, [&](const JournalRecord& record, std::uint32_t place) {
    const bool whole = record_is_whole(record, place);
    last = place;
    if (bad == 0 && !whole) bad = place;
    // A group is begun when the one before it is on disk.
    torn = bad == 0 || !whole || record.group <= bad;
    return torn;
  });
  if (!read) return unreadable_journal(path_);
  if (!torn) {
    return bad_input(
        fmt::format("{}: record {} is damaged although later ones are whole, so this is not a torn end; "
                    "nothing was changed: copy the file from a backup, save what is whole with `bladefit "
                    "recover`, or name another session folder",
                    path_, bad));
  }
  summary_.records = bad == 0 ? last : bad - 1;
  struct stat status = {};
  if (fstat(descriptor_, &status) != 0) return unreadable_journal(path_);
  const std::uint64_t whole_bytes = sizeof header + summary_.records * sizeof(JournalRecord);
  summary_.torn_bytes = static_cast<std::uint64_t>(status.st_size) - whole_bytes;
  return {};
}

Failure JournalReader::for_each(const std::function<void(const StreamEvent&)>& visit) const {
  if (!summary_.exists) return {};
  std::uint64_t given = 0;
  const bool read = visit_records(descriptor_, [&](const JournalRecord& record, std::uint32_t place) {
    if (place > summary_.records || !record_is_whole(record, place)) return false;
    visit(event_of(record));
    ++given;
    return true;
  });
  if (read && given == summary_.records) return {};
  return unreadable_journal(path_);
}

Failure read_journal(const std::string& path, JournalContent& content) {
  content = {};
  JournalReader reader;
  if (Failure error = reader.open(path)) return error;
  static_cast<JournalSummary&>(content) = reader.summary();
  content.events.reserve(content.records);
  return reader.for_each([&content](const StreamEvent& event) { content.events.push_back(event); });
}

}  // namespace bladefit

#include "firmware_bridge/host/journal/journal_salvage.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "firmware_bridge/host/journal/journal_file.hpp"

namespace bladefit {
namespace {

/// A header whose check sum holds tells the version; one that does not tells nothing, and the records speak for
/// themselves.
Failure read_header(int descriptor, const std::string& path, Salvage& salvage) {
  JournalHeader header;
  const auto size = read_at(descriptor, std::as_writable_bytes(std::span(&header, 1)), 0);
  if (!size) return unreadable_journal(path);
  if (*size < sizeof header || !header_is_whole(header)) return {};
  if (Failure error = check_journal_kind(path, header)) return error;
  salvage.header_whole = true;
  salvage.identity = {header.design_crc, header.config_digest};
  salvage.run_id = header.run_id;
  return {};
}

/// Sorts the records into whole and damaged ones.
class Sorting {
 public:
  explicit Sorting(Salvage& salvage) : salvage_(salvage) {}

  void take(const JournalRecord& record, std::uint32_t place) {
    ++salvage_.records;
    std::vector<DamagedRecords>& damaged = salvage_.damaged;
    if (!record_is_whole(record, place)) {
      const bool goes_on = !damaged.empty() && damaged.back().last + 1 == place;
      if (goes_on) damaged.back().last = place;
      if (!goes_on) damaged.push_back({place, place, newest_, 0});
      return;
    }
    const StreamEvent event = event_of(record);
    salvage_.events.push_back(event);
    if (event.kind != EventKind::point) return;
    newest_ = event.point.sequence;
    for (auto open = damaged.rbegin(); open != damaged.rend() && open->point_after == 0; ++open)
      open->point_after = newest_;
  }

 private:
  Salvage& salvage_;
  std::uint32_t newest_ = 0;
};

Failure read_salvage(int descriptor, const std::string& path, Salvage& salvage) {
  if (Failure error = read_header(descriptor, path, salvage)) return error;
  Sorting sorting(salvage);
  const bool read = visit_records(descriptor, [&sorting](const JournalRecord& record, std::uint32_t place) {
    sorting.take(record, place);
    return true;
  });
  struct stat status = {};
  if (!read || fstat(descriptor, &status) != 0) return unreadable_journal(path);
  const std::uint64_t complete = sizeof(JournalHeader) + salvage.records * sizeof(JournalRecord);
  const auto size = static_cast<std::uint64_t>(status.st_size);
  salvage.torn_bytes = size > complete ? size - complete : 0;
  return {};
}

}  // namespace

Failure salvage_journal(const std::string& path, Salvage& salvage) {
  salvage = {};
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0 && errno == ENOENT) {
    return bad_input(fmt::format("{}: there is no such file; give the folder of a session", path));
  }
  if (descriptor < 0) return unreadable_journal(path);
  Failure failure = read_salvage(descriptor, path, salvage);
  ::close(descriptor);
  return failure;
}

}  // namespace bladefit

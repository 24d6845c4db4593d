#include "firmware_bridge/host/journal/journal_file.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace bladefit {
namespace {

constexpr std::size_t kRecordsPerRead = 256;

}  // namespace

std::optional<std::size_t> read_at(int descriptor, std::span<std::byte> bytes, std::uint64_t offset) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count =
        pread(descriptor, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return std::nullopt;
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  return done;
}

bool visit_records(int descriptor, const std::function<bool(const JournalRecord&, std::uint32_t)>& visit) {
  std::array<JournalRecord, kRecordsPerRead> records;
  for (std::uint32_t place = 1;;) {
    const std::uint64_t offset = sizeof(JournalHeader) + std::uint64_t{place - 1} * sizeof(JournalRecord);
    const auto size = read_at(descriptor, std::as_writable_bytes(std::span(records)), offset);
    if (!size) return false;
    const std::size_t count = *size / sizeof(JournalRecord);
    for (std::size_t index = 0; index < count; ++index) {
      if (!visit(records.at(index), place++)) return true;
    }
    if (count < kRecordsPerRead) return true;
  }
}

Failure unreadable_journal(const std::string& path) {
  return device_failure(fmt::format("{}: cannot be read ({}); check the disk and the rights of the folder", path,
                                    std::strerror(errno != 0 ? errno : EIO)));
}

Failure check_journal_kind(const std::string& path, const JournalHeader& header) {
  if (header.magic != kJournalMagic) {
    return bad_input(fmt::format("{}: is not a journal of a session; name another session folder", path));
  }
  if (header.version >= kOldestJournalVersion && header.version <= kJournalVersion) return {};
  const char* why = header.version < kOldestJournalVersion ? ", which does not tell of lost points" : "";
  return bad_input(
      fmt::format("{}: journal of format version {}{}; this program reads versions {} to {}: use the program that "
                  "wrote it, or name another session folder",
                  path, header.version, why, kOldestJournalVersion, kJournalVersion));
}

}  // namespace bladefit

#include "firmware_bridge/host/journal/journal.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace bladefit {
namespace {

/// A new file survives a power cut only when its folder has been synchronised too.
bool sync_folder(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const int descriptor = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool synced = fsync(descriptor) == 0;
  close(descriptor);
  return synced;
}

}  // namespace

Journal::~Journal() {
  // A session that never came to its header has left nothing worth keeping.
  if (locked_ && size_ == 0) unlink(path_.c_str());
  if (descriptor_ >= 0) close(descriptor_);
}

Failure Journal::failure(const char* what) const {
  return device_failure(
      fmt::format("{}: {} ({}); free the disk or name another session folder, then start again: the "
                  "device still holds what was not stored",
                  path_, what, std::strerror(errno)));
}

Failure Journal::open(const std::string& path) {
  path_ = path;
  descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0) return failure("cannot be opened for writing");
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    return bad_input(
        fmt::format("{}: another session is using this folder; end it, or name another folder "
                    "with --session",
                    path));
  }
  // What the file holds is not ours to remove, even when this session is refused.
  const off_t size = lseek(descriptor_, 0, SEEK_END);
  if (size < 0) return failure("its size cannot be read");
  size_ = static_cast<std::uint64_t>(size);
  locked_ = true;
  return {};
}

Failure Journal::cut_to(std::uint64_t size) {
  if (ftruncate(descriptor_, static_cast<off_t>(size)) != 0) return failure("cannot be cut to its whole records");
  size_ = size;
  return {};
}

Failure Journal::start(const SessionIdentity& identity, std::uint32_t run_id) {
  records_ = 0;
  if (const Failure error = cut_to(0)) return error;
  const JournalHeader header = make_journal_header(identity, run_id);
  if (const Failure error = write_at_end(std::as_bytes(std::span(&header, 1)))) return error;
  if (!sync_folder(path_)) return failure("the folder cannot be synchronised");
  return {};
}

Failure Journal::resume(std::uint64_t records) {
  records_ = static_cast<std::uint32_t>(records);
  if (const Failure error = cut_to(sizeof(JournalHeader) + records * sizeof(JournalRecord))) return error;
  if (fdatasync(descriptor_) != 0) return failure("cannot be synchronised");
  return {};
}

Failure Journal::append(std::span<const StreamEvent> events) {
  if (events.empty()) return {};
  std::array<JournalRecord, kJournalGroup> group;
  const std::size_t count = std::min(events.size(), kJournalGroup);
  for (std::size_t index = 0; index < count; ++index) {
    group[index] = make_journal_record(events[index], records_ + static_cast<std::uint32_t>(index) + 1, records_ + 1);
  }
  if (const Failure error = write_at_end(std::as_bytes(std::span(group).first(count)))) return error;
  records_ += static_cast<std::uint32_t>(count);
  return {};
}

Failure Journal::check_link() const {
  struct stat status = {};
  if (fstat(descriptor_, &status) != 0) return failure("can no longer be looked at");
  if (status.st_nlink > 0) return {};
  return device_failure(
      fmt::format("{}: was removed during the session; nothing more is acknowledged, and the device still holds what "
                  "was not: start again with another session folder",
                  path_));
}

Failure Journal::write_at_end(std::span<const std::byte> bytes) {
  const std::uint64_t before = size_;
  while (!bytes.empty()) {
    const ssize_t written = pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(size_));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;
    size_ += static_cast<std::uint64_t>(written);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  if (bytes.empty() && fdatasync(descriptor_) == 0) return {};
  const Failure error = failure("cannot be written");
  // Best effort: a tail that stays is no whole record and is cut off at the next start.
  [[maybe_unused]] const Failure ignored = cut_to(before);
  size_ = before;
  return error;
}

}  // namespace bladefit

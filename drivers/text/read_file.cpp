#include "drivers/text/read_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <system_error>

namespace bladefit {
namespace {

constexpr int kLongestSilence_ms = 15000;

/// A file that is closed at the end, unless it is standard input.
class OpenFile {
 public:
  /// Opening must not wait for somebody who writes to a pipe.
  explicit OpenFile(const std::string& path)
      : descriptor_(path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~OpenFile() {
    if (descriptor_ > STDERR_FILENO) ::close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

std::string reason(int error) { return std::generic_category().message(error); }

Failure open_failure(int error) {
  if (error == ENOENT) return bad_input("no such file; check the name");
  if (error == EACCES) return bad_input("cannot be read: permission denied; check its permissions");
  return bad_input(fmt::format("cannot be read: {}; check the name", reason(error)));
}

Failure too_large(std::size_t largest) {
  return bad_input(fmt::format("is larger than the {} MiB that such a file may have; name another one, or divide it",
                               largest >> 20U));
}

/// `waits`: it is something that others write to while it is read.
Failure check_kind(int descriptor, std::size_t largest, bool& waits) {
  struct stat about {};
  if (::fstat(descriptor, &about) != 0) return open_failure(errno);
  if (S_ISDIR(about.st_mode)) return bad_input("is a folder; name a file in it");
  if (S_ISREG(about.st_mode) && static_cast<std::size_t>(about.st_size) > largest) return too_large(largest);
  const bool terminal = ::isatty(descriptor) == 1;
  if (S_ISBLK(about.st_mode) || (S_ISCHR(about.st_mode) && !terminal)) {
    return bad_input(descriptor == STDIN_FILENO ? "is a device, no file; redirect a file or a pipe to it"
                                                : "is a device, no file; name a file, or - for standard input");
  }
  waits = terminal || S_ISFIFO(about.st_mode) || S_ISSOCK(about.st_mode);
  return {};
}

/// Waits until there is something to read. What writes to standard input may take any time, but the user is told.
Failure wait_for_writer(int descriptor) {
  pollfd watched{descriptor, POLLIN, 0};
  int ready = ::poll(&watched, 1, kLongestSilence_ms);
  if (ready == 0 && descriptor == STDIN_FILENO) {
    fmt::print(stderr, "bladefit: waiting for standard input\n");
    ready = ::poll(&watched, 1, -1);
  }
  if (ready > 0 || (ready < 0 && errno == EINTR)) return {};
  if (ready < 0) return device_failure(fmt::format("cannot be read: {}; try again", reason(errno)));
  return bad_input(fmt::format("is a pipe to which nobody wrote for {} s; start its writer, or name a file",
                               kLongestSilence_ms / 1000));
}

}  // namespace

std::string file_name(const std::string& path) { return path == "-" ? "standard input" : path; }

Failure read_file(const std::string& path, std::size_t largest, std::string& text) {
  const OpenFile file(path);
  if (file.descriptor() < 0) return open_failure(errno);
  bool waits = false;
  if (Failure failure = check_kind(file.descriptor(), largest, waits)) return failure;
  text.clear();
  std::array<char, 65536> block{};
  while (true) {
    if (waits) {
      if (Failure failure = wait_for_writer(file.descriptor())) return failure;
    }
    const ssize_t count = ::read(file.descriptor(), block.data(), block.size());
    if (count == 0) return {};
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (count < 0)
      return device_failure(fmt::format("cannot be read: {}; check the disk and try again", reason(errno)));
    if (text.size() + static_cast<std::size_t>(count) > largest) return too_large(largest);
    text.append(block.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace bladefit

#include "tools/files/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr std::string_view kStandardOutput = "-";

/// What is written to as it comes: nothing can be moved in its place.
bool is_stream(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  return path == kStandardOutput || std::filesystem::is_character_file(status) || std::filesystem::is_fifo(status);
}

/// The file that `path` means: where it is a link, the file behind it. Folders must not be replaced.
std::filesystem::path resolve(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status) || is_stream(path)) return path;
  if (!std::filesystem::is_regular_file(status)) {
    throw ToolError(fmt::format("{}: is not a regular file; give another output name", path.string()));
  }
  const std::filesystem::path place = std::filesystem::canonical(path, error);
  return error ? path : place;
}

/// One name for every way to spell a place. Where the first folder of a relative path is missing, weakly_canonical
/// alone leaves it relative.
std::filesystem::path place_of(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(path, error);
  const std::filesystem::path place = std::filesystem::weakly_canonical(whole, error);
  return error ? whole : place;
}

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  const std::string name = path == kStandardOutput ? "standard output" : path.string();
  throw ToolError(fmt::format("{}: cannot be written: {}; check folder, permissions and free space", name,
                              std::generic_category().message(error)),
                  ToolError::Kind::device);
}

/// Writes all of `content`; returns 0 or the error of the operating system.
int write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// Writes to what is open already, or to what `path` names.
void write_stream(const std::filesystem::path& path, std::string_view content) {
  const bool standard = path == kStandardOutput;
  if (standard && std::fflush(stdout) != 0) fail(path, errno);
  const int descriptor = standard ? STDOUT_FILENO : ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail(path, errno);
  const int error = write_all(descriptor, content);
  const int close_error = standard || ::close(descriptor) == 0 ? 0 : errno;
  if (error != 0 || close_error != 0) fail(path, error != 0 ? error : close_error);
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& path, std::string_view content) : path_(resolve(path)) {
  if (is_stream(path_)) {
    streamed_ = content;
    return;
  }
  temporary_ = path_;
  temporary_ += fmt::format(".partial-{}", ::getpid());
  const int descriptor = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) fail(path_, errno);
  const int write_error = write_all(descriptor, content);
  const int error = write_error != 0 || ::fsync(descriptor) == 0 ? write_error : errno;
  const int close_error = ::close(descriptor) == 0 ? 0 : errno;
  if (error == 0 && close_error == 0) return;
  ::unlink(temporary_.c_str());
  fail(path_, error != 0 ? error : close_error);
}

OutputFile::~OutputFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::commit() {
  if (temporary_.empty()) return write_stream(path_, streamed_);
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, errno);
  temporary_.clear();
}

void write_output(const std::string& path, std::string_view content) { OutputFile(path, content).commit(); }

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  return !a.empty() && !b.empty() && a != kStandardOutput && place_of(a) == place_of(b);
}

void refuse_overwriting(const std::filesystem::path& output, std::string_view what,
                        const std::filesystem::path& input) {
  if (!same_file(output, input)) return;
  throw ToolError(fmt::format("{}: the output would overwrite the {}; give another name", input.string(), what));
}

}  // namespace bladefit

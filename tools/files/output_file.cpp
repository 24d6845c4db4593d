#include "tools/files/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <optional>
#include <system_error>

#include "drivers/text/text_number.hpp"
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

constexpr const char* kPartial = ".partial-";
constexpr std::size_t kBlock = std::size_t{1} << 16U;

/// Writes a descriptor block by block and keeps the first error.
class BlockWriter {
 public:
  explicit BlockWriter(int descriptor) : descriptor_(descriptor) { block_.reserve(kBlock); }

  void put(std::string_view piece) {
    block_ += piece;
    if (block_.size() >= kBlock) flush();
  }

  /// Writes what is left; returns 0 or the error of the operating system.
  [[nodiscard]] int finish() {
    flush();
    return error_;
  }

 private:
  void flush() {
    std::string_view left = block_;
    while (!left.empty() && error_ == 0) {
      const ssize_t written = ::write(descriptor_, left.data(), left.size());
      if (written >= 0) {
        left.remove_prefix(static_cast<std::size_t>(written));
      } else if (errno != EINTR) {
        error_ = errno;
      }
    }
    block_.clear();
  }

  int descriptor_, error_ = 0;
  std::string block_;
};

/// Writes to what is open already, or to what `path` names.
void write_stream(const std::filesystem::path& path, const TextWriter& write) {
  const bool standard = path == kStandardOutput;
  if (standard && std::fflush(stdout) != 0) fail(path, errno);
  const int descriptor = standard ? STDOUT_FILENO : ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail(path, errno);
  BlockWriter block(descriptor);
  write([&block](std::string_view piece) { block.put(piece); });
  const int error = block.finish();
  const int close_error = standard || ::close(descriptor) == 0 ? 0 : errno;
  if (error != 0 || close_error != 0) fail(path, error != 0 ? error : close_error);
}

/// The process that began a part of `name`; nothing where `file` is no such part.
std::optional<pid_t> writer_of(const std::string& file, const std::string& name) {
  const std::string begin = name + kPartial;
  if (!file.starts_with(begin)) return std::nullopt;
  return parse_whole<pid_t>(std::string_view(file).substr(begin.size()));
}

bool lives(pid_t process) { return process != ::getpid() && (::kill(process, 0) == 0 || errno == EPERM); }

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& path, std::string_view content)
    : OutputFile(path, [content](const Put& put) { put(content); }) {}

OutputFile::OutputFile(const std::filesystem::path& path, const TextWriter& write) : path_(resolve(path)) {
  if (is_stream(path_)) {
    write([this](std::string_view piece) { streamed_ += piece; });
    return;
  }
  temporary_ = path_;
  temporary_ += fmt::format("{}{}", kPartial, ::getpid());
  const int descriptor = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) fail(path_, errno);
  BlockWriter block(descriptor);
  write([&block](std::string_view piece) { block.put(piece); });
  const int write_error = block.finish();
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
  if (temporary_.empty()) return write_stream(path_, [this](const Put& put) { put(streamed_); });
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, errno);
  temporary_.clear();
}

void write_output(const std::string& path, std::string_view content) {
  write_output(path, [content](const Put& put) { put(content); });
}

void write_output(const std::string& path, const TextWriter& write) {
  is_stream(path) ? write_stream(path, write) : OutputFile(path, write).commit();
}

std::vector<std::string> remove_stray_parts(const std::filesystem::path& path) {
  std::vector<std::string> removed;
  std::error_code error;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::optional<pid_t> writer = writer_of(entry.path().filename().string(), path.filename().string());
    if (!writer || lives(*writer) || !std::filesystem::remove(entry.path(), error)) continue;
    removed.push_back(entry.path().string());
  }
  return removed;
}

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  return !a.empty() && !b.empty() && a != kStandardOutput && place_of(a) == place_of(b);
}

void refuse_overwriting(const std::filesystem::path& output, std::string_view what,
                        const std::filesystem::path& input) {
  if (!same_file(output, input)) return;
  throw ToolError(fmt::format("{}: the output would overwrite the {}; give another name", input.string(), what));
}

}  // namespace bladefit

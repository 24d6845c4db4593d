#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace bladefit {

/// Takes the next piece of a text.
using Put = std::function<void(std::string_view piece)>;
/// Gives a text piece by piece, so that it need not be in memory as a whole.
using TextWriter = std::function<void(const Put& put)>;

/// A file that comes to stand under its name only as a whole: the content is written beside it under another name and
/// moved in place by commit(). Without commit() nothing is left behind.
class OutputFile {
 public:
  /// Writes `content`. Throws ToolError (device) where that fails, and bad_input where `path` is a folder or something
  /// else that has no content of its own. To standard output ("-"), a device or a pipe commit() writes.
  OutputFile(const std::filesystem::path& path, std::string_view content);
  OutputFile(const std::filesystem::path& path, const TextWriter& write);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Moves the content in place of what stood there. Throws ToolError (device).
  void commit();

 private:
  std::filesystem::path path_, temporary_;
  std::string streamed_;  ///< what commit() is to write where nothing can be moved in place
};

/// Writes `content` to the file `path`, as a whole or not at all, or as it comes to standard output ("-"), a device or
/// a pipe. Throws ToolError as OutputFile does.
void write_output(const std::string& path, const TextWriter& write);
void write_output(const std::string& path, std::string_view content);

/// Removes what killed processes left of `path` before it was complete, and returns the names. Files of processes that
/// live stay.
std::vector<std::string> remove_stray_parts(const std::filesystem::path& path);

/// True where both name the same place, whether something stands there or not. Empty names are no place.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Refuses an output that would take the place of an input; `what` says what that one is. Empty names are no place.
/// Throws ToolError (bad_input).
void refuse_overwriting(const std::filesystem::path& output, std::string_view what, const std::filesystem::path& input);

}  // namespace bladefit

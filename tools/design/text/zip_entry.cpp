#include "tools/design/text/zip_entry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

// The format: APPNOTE.TXT of PKWARE, sections 4.3.7 (local header), 4.3.12 (directory), 4.3.16 (its end).
constexpr std::string_view kDirectoryEnd("PK\5\6", 4), kDirectoryRecord("PK\1\2", 4), kLocalHeader("PK\3\4", 4);
constexpr std::size_t kEndSize = 22, kRecordSize = 46, kLocalSize = 30;
constexpr std::uint16_t kEncrypted = 1;
constexpr std::array<std::string_view, 5> kCadNames = {".stp", ".step", ".p21", ".igs", ".iges"};

/// A number of `bytes` bytes, the low one first; 0 beyond the end.
std::uint32_t number_at(std::string_view text, std::size_t at, std::size_t bytes) {
  std::uint32_t number = 0;
  for (std::size_t k = bytes; k-- > 0;) {
    number = number << 8U | (at + k < text.size() ? static_cast<unsigned char>(text[at + k]) : 0U);
  }
  return number;
}

bool stands_at(std::string_view archive, std::size_t at, std::string_view mark) {
  return at <= archive.size() && archive.substr(at, mark.size()) == mark;
}

[[noreturn]] void refuse_archive(const std::string& file, const std::string& why) {
  throw ToolError(fmt::format("{}: the ZIP archive {}; unpack it and give the STEP or IGES file in it", file, why));
}

/// Where the records of CAD files stand in the directory.
std::vector<std::size_t> cad_records(std::string_view archive, const std::string& file) {
  const std::size_t end = archive.rfind(kDirectoryEnd);
  if (end == std::string_view::npos || archive.size() - end < kEndSize) refuse_archive(file, "is damaged or cut off");
  std::size_t at = number_at(archive, end + 16, 4);
  std::vector<std::size_t> records;
  for (std::uint32_t left = number_at(archive, end + 10, 2); left > 0; --left) {
    if (!stands_at(archive, at, kDirectoryRecord)) refuse_archive(file, "is damaged, or of a kind that is not read");
    const std::size_t name = number_at(archive, at + 28, 2);
    const std::string extension = lower_extension(std::string(archive.substr(at + kRecordSize, name)));
    if (std::ranges::find(kCadNames, extension) != kCadNames.end()) records.push_back(at);
    at += kRecordSize + name + number_at(archive, at + 30, 2) + number_at(archive, at + 32, 2);
    if (at > end) refuse_archive(file, "is damaged, or of a kind that is not read");
  }
  return records;
}

}  // namespace

ZipEntry cad_entry(std::string_view archive, const std::string& file) {
  const std::vector<std::size_t> records = cad_records(archive, file);
  if (records.empty()) refuse_archive(file, "holds no file named .stp, .step, .p21, .igs or .iges");
  if (records.size() > 1) refuse_archive(file, fmt::format("holds {} CAD files", records.size()));
  const std::size_t record = records.front();
  ZipEntry entry;
  entry.name = archive.substr(record + kRecordSize, number_at(archive, record + 28, 2));
  if ((number_at(archive, record + 8, 2) & kEncrypted) != 0) refuse_archive(file, "is encrypted");
  const std::uint32_t method = number_at(archive, record + 10, 2);
  entry.packed_by = static_cast<ZipMethod>(method);
  if (entry.packed_by != ZipMethod::stored && entry.packed_by != ZipMethod::deflated) {
    refuse_archive(file, fmt::format("is packed by method {}", method));
  }
  entry.check_sum = number_at(archive, record + 16, 4);
  const std::size_t size = number_at(archive, record + 20, 4), local = number_at(archive, record + 42, 4);
  if (!stands_at(archive, local, kLocalHeader)) refuse_archive(file, "is damaged");
  const std::size_t data = local + kLocalSize + number_at(archive, local + 26, 2) + number_at(archive, local + 28, 2);
  if (data > archive.size() || size > archive.size() - data) refuse_archive(file, "is damaged or cut off");
  entry.data = archive.substr(data, size);
  return entry;
}

}  // namespace bladefit

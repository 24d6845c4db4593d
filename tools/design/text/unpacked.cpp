#include "tools/design/text/unpacked.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <optional>
#include <string_view>

#include "tools/design/text/zip_entry.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr std::string_view kGzip = "\x1F\x8B", kZip = "PK\x03\x04";
/// zlib's windowBits: a gzip header is expected, or none at all.
constexpr int kGzipWindow = 16 + MAX_WBITS, kRawWindow = -MAX_WBITS;
constexpr std::size_t kPiece = std::size_t{1} << 16U;

/// Inflates streams that stand one after the other, a piece at a time. zlib takes at most 4 GB at once: files are
/// smaller.
class Inflation {
 public:
  Inflation(std::string_view packed, int window) : window_(window) {
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream_.avail_in = static_cast<uInt>(packed.size());
    good_ = inflateInit2(&stream_, window) == Z_OK;
  }
  ~Inflation() { inflateEnd(&stream_); }
  Inflation(const Inflation&) = delete;
  Inflation& operator=(const Inflation&) = delete;

  /// The next piece; empty at the end, nothing where the stream is damaged or ends too soon.
  std::optional<std::string_view> next() {
    std::size_t written = 0;
    while (good_ && !ended_ && written == 0) {
      stream_.next_out = reinterpret_cast<Bytef*>(piece_.data());
      stream_.avail_out = static_cast<uInt>(piece_.size());
      const int result = inflate(&stream_, Z_NO_FLUSH);
      written = piece_.size() - stream_.avail_out;
      good_ = result == Z_OK || result == Z_STREAM_END;
      if (result == Z_STREAM_END) end_stream();
    }
    if (!good_) return std::nullopt;
    return std::string_view(piece_.data(), written);
  }

 private:
  /// A gzip file may be several, joined; what follows that is none is not its own.
  void end_stream() {
    ended_ = window_ != kGzipWindow || stream_.avail_in < kGzip.size() ||
             std::string_view(reinterpret_cast<const char*>(stream_.next_in), kGzip.size()) != kGzip;
    if (!ended_) good_ = inflateReset(&stream_) == Z_OK;
  }

  int window_;
  z_stream stream_{};
  bool good_ = false, ended_ = false;
  std::array<char, kPiece> piece_{};
};

/// Calls `use` with every piece. Throws ToolError where the stream is damaged, or grows over `most`.
template <class Use>
void each_piece_of(std::string_view packed, int window, const std::string& file, std::size_t most, Use use) {
  Inflation inflation(packed, window);
  std::size_t size = 0;
  for (;;) {
    const std::optional<std::string_view> piece = inflation.next();
    if (!piece) {
      throw ToolError(fmt::format("{}: the compressed file is damaged or cut off; copy or pack it again", file));
    }
    if (piece->empty()) return;
    size += piece->size();
    if (size > most) {
      throw ToolError(
          fmt::format("{}: grows to more than {} MB when it is unpacked, which no blade needs; export fewer "
                      "parts",
                      file, most >> 20U));
    }
    use(*piece);
  }
}

std::string inflated(std::string_view packed, int window, const std::string& file, std::size_t most) {
  std::size_t size = 0;
  each_piece_of(packed, window, file, most, [&size](std::string_view piece) { size += piece.size(); });
  std::string text;
  text.reserve(size);
  each_piece_of(packed, window, file, most, [&text](std::string_view piece) { text += piece; });
  return text;
}

std::string unzipped(const std::string& content, const std::string& file, std::size_t most) {
  const ZipEntry entry = cad_entry(content, file);
  std::string text =
      entry.packed_by == ZipMethod::stored ? std::string(entry.data) : inflated(entry.data, kRawWindow, file, most);
  const uLong sum = crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size());
  if (sum == entry.check_sum) return text;
  throw ToolError(fmt::format("{}: the check sum of {} is wrong; copy or pack it again", file, entry.name));
}

}  // namespace

std::string unpacked(std::string content, const std::string& file, std::size_t most) {
  if (content.starts_with(kGzip)) return inflated(content, kGzipWindow, file, most);
  if (content.starts_with(kZip)) return unzipped(content, file, most);
  return content;
}

}  // namespace bladefit

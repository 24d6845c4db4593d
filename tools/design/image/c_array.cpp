#include "tools/design/image/c_array.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace bladefit {
namespace {

constexpr std::size_t kWordsPerLine = 5;

/// `text` with everything that might end a C comment or line taken out.
std::string comment_text(std::string text) {
  for (char& c : text) {
    if (c == '*' || c == '/' || c == '\\' || std::iscntrl(static_cast<unsigned char>(c)) != 0) c = '_';
  }
  return text;
}

}  // namespace

std::string c_array_name(const std::filesystem::path& path) {
  std::string name = path.stem().string();
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 || std::isalnum(byte) == 0) c = '_';
  }
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0) name = "blade_" + name;
  return name + "_design";
}

std::string c_array_source(std::span<const std::byte> image, const std::string& name, const std::string& origin) {
  std::string source = fmt::format(
      "/* Design image of {}, compiled by bladefit. For little-endian targets.\n"
      "   extern const uint64_t {}[];      aligned to 8 bytes\n"
      "   extern const size_t {}_size;     in bytes */\n"
      "#include <stddef.h>\n#include <stdint.h>\n\n"
      "const size_t {}_size = {}u;\nconst uint64_t {}[{}] = {{",
      comment_text(origin), name, name, name, image.size(), name, image.size() / sizeof(std::uint64_t));
  for (std::size_t k = 0; k < image.size() / sizeof(std::uint64_t); ++k) {
    std::uint64_t word = 0;
    std::memcpy(&word, image.data() + k * sizeof word, sizeof word);
    fmt::format_to(std::back_inserter(source), "{}0x{:016x}u,", k % kWordsPerLine == 0 ? "\n    " : " ", word);
  }
  return source + "\n};\n";
}

}  // namespace bladefit

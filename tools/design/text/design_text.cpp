#include "tools/design/text/design_text.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <string_view>

#include "tools/design/text/unpacked.hpp"
#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kHead = 128;

/// What a file begins with that is no STEP and no IGES text, and what to do.
struct OtherKind {
  std::string_view head;
  const char* kind;
  const char* way;
};
constexpr std::array<OtherKind, 6> kOtherKinds = {
    {{"**ABCDEFGHIJKLMNOPQRSTUVWXYZ", "Parasolid", "export the blade as STEP (AP214 or AP242)"},
     {"3D Geometry File Format", "Rhino 3DM", "export the blade as STEP or IGES"},
     {"Version 8", "JT", "export the blade as STEP (AP214 or AP242)"},
     {"Version 9", "JT", "export the blade as STEP (AP214 or AP242)"},
     {"Version 10", "JT", "export the blade as STEP (AP214 or AP242)"},
     {"solid ", "an STL mesh", "a mesh has no surface to judge by: export the blade as STEP or IGES"}}};

void refuse_other_kinds(std::string_view head, const std::filesystem::path& path) {
  for (const OtherKind& other : kOtherKinds) {
    if (!head.starts_with(other.head)) continue;
    throw ToolError(fmt::format("{}: is {}; {}", path.string(), other.kind, other.way));
  }
}

std::string head_of(const std::filesystem::path& path) {
  std::string head(kHead, '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  return head;
}

}  // namespace

std::string read_design_text(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error)) {
    const std::string head = head_of(path);
    refuse_other_kinds(head, path);
    if (!head.empty() && head.find_first_not_of('\0') == std::string::npos) {
      throw ToolError(
          fmt::format("{}: the file begins with zeros: it is not a design; export it again", path.string()));
    }
  }
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  std::string text = unpacked(read_text(path), path.string());
  refuse_other_kinds(text, path);
  if (text.compare(0, kByteOrderMark.size(), kByteOrderMark) == 0) text.erase(0, kByteOrderMark.size());
  return text;
}

}  // namespace bladefit

#include "tools/report/formats.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {

const ReportFormat& format_of(std::string_view name) {
  const auto* const format = std::find_if(kFormats.begin(), kFormats.end(),
                                          [name](const ReportFormat& candidate) { return candidate.name == name; });
  if (format != kFormats.end()) return *format;
  throw ToolError(fmt::format("--format {}: is not in this version; the formats are {}", name.substr(0, 20),
                              format_names(", ", " and ")));
}

const ReportFormat& format_of_file(const std::string& path) {
  const std::string end = lower_extension(path);
  const auto* const format = std::find_if(kFormats.begin(), kFormats.end(), [&end](const ReportFormat& candidate) {
    return !end.empty() && candidate.name == std::string_view(end).substr(1);
  });
  if (format != kFormats.end()) return *format;
  throw ToolError(fmt::format("--report {}: the end of its name tells no format; end it with .{}", path,
                              format_names(", .", " or .")));
}

std::string format_names(std::string_view joint, std::string_view last_joint) {
  std::string names;
  for (const ReportFormat& format : kFormats) {
    if (!names.empty()) names += &format == &kFormats.back() ? last_joint : joint;
    names += format.name;
  }
  return names;
}

}  // namespace bladefit

#include "firmware_bridge/host/journal/session_settings_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "core/localizer/config_fields.hpp"
#include "firmware_bridge/host/journal/config_digest.hpp"
#include "firmware_bridge/host/journal/session_file_names.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kTold = 3;
constexpr const char* kDigestName = "digest";
constexpr const char* kBetween = " = ";

template <typename Field>
std::string value_text(const Field& field) {
  if constexpr (requires { word_of(field); }) {
    return std::string(word_of(field));
  } else {
    return fmt::format("{}", field);
  }
}

std::string path_of(const std::string& session_directory) {
  return (std::filesystem::path(session_directory) / kSettingsFile).string();
}

}  // namespace

std::vector<std::pair<std::string, std::string>> named_settings(const std::string& text) {
  std::vector<std::pair<std::string, std::string>> values;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t between = line.find(kBetween);
    if (between != std::string::npos)
      values.emplace_back(line.substr(0, between), line.substr(between + std::strlen(kBetween)));
  }
  return values;
}

std::string settings_text(const LocalizerConfig& config, std::uint32_t path_refine_points) {
  std::string text = fmt::format("{}{}{}\npath_refine_points{}{}\n", kDigestName, kBetween,
                                 config_digest(config, path_refine_points), kBetween, path_refine_points);
  std::map<std::string, int> times;
  for_each_field(config, [&](const std::string& name, const auto& field) {
    const int number = ++times[name];
    text += fmt::format("{}{}{}{}\n", name, number == 1 ? "" : fmt::format(" {}", number), kBetween, value_text(field));
  });
  return text;
}

Failure write_settings(const std::string& session_directory, const std::string& text) {
  const std::string path = path_of(session_directory);
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  const bool written = descriptor >= 0 &&
                       ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                       ::fsync(descriptor) == 0;
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (written) return {};
  return device_failure(fmt::format("{}: cannot be written ({}); free the disk or name another session folder", path,
                                    std::strerror(reason)));
}

std::string differing_settings(const std::string& session_directory, std::uint64_t digest, const std::string& text) {
  std::ifstream file(path_of(session_directory));
  std::ostringstream content;
  content << file.rdbuf();
  std::map<std::string, std::string> before;
  for (const auto& [name, value] : named_settings(content.str())) before[name] = value;
  if (before[kDigestName] != fmt::format("{}", digest)) return "";
  std::vector<std::string> told;
  for (const auto& [name, value] : named_settings(text)) {
    const auto was = before.find(name);
    if (name == kDigestName) continue;
    if (was == before.end()) {
      told.push_back(fmt::format("{} is {}", name, value));
    } else if (was->second != value) {
      told.push_back(fmt::format("{} was {} and is {}", name, was->second, value));
    }
    before.erase(name);
  }
  for (const auto& [name, value] : before) {
    if (name != kDigestName) told.push_back(fmt::format("{} was {}", name, value));
  }
  const auto end = told.begin() + static_cast<std::ptrdiff_t>(std::min(told.size(), kTold));
  const std::string more = told.size() > kTold ? fmt::format(" and {} more", told.size() - kTold) : "";
  return fmt::format("{}{}", fmt::join(told.begin(), end, ", "), more);
}

}  // namespace bladefit

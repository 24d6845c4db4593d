#include "config/session_settings.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "config/fit_table.hpp"
#include "config/table_reader.hpp"
#include "drivers/source_uri.hpp"

namespace bladefit {
namespace {

constexpr double kMostPoints = 16777216;
constexpr double kLongestIdle = 1e6;  ///< [s]
constexpr std::string_view kReplay = "replay:";

/// A path of the file as one that can be used from the working directory.
std::string resolved(const std::string& path, const std::string& file) {
  return std::filesystem::path(file).parent_path() / path;
}

void read_path(TableReader& table, std::string_view key, const std::string& file, std::optional<std::string>& value) {
  if (!table.has(key)) return;
  table.read(key, value);
  if (!table.good()) return;
  if (value->empty()) return table.fail(key, "is empty; give a path, or leave the key out");
  value = resolved(*value, file);
}

void read_source(TableReader& table, const std::string& file, std::optional<std::string>& source) {
  if (!table.has("source")) return;
  table.read("source", source);
  if (!table.good()) return;
  SourceSettings scratch;
  if (const std::string error = apply_source_uri(*source, scratch); !error.empty()) return table.fail("source", error);
  if (scratch.kind == SourceKind::replay) source = std::string(kReplay) + resolved(scratch.replay.file, file);
}

/// Of IPv4 or IPv6.
bool is_numeric_address(const std::string& text) {
  std::array<unsigned char, sizeof(in6_addr)> bytes{};
  return inet_pton(AF_INET, text.c_str(), bytes.data()) == 1 || inet_pton(AF_INET6, text.c_str(), bytes.data()) == 1;
}

void read_panel(TableReader& table, PanelSettings& panel) {
  table.read("address", panel.address);
  double port = 0;
  if (table.has("port")) {
    table.read_whole("port", port, {0, 65535});
    if (table.good()) panel.port = static_cast<std::uint16_t>(port);
  }
  table.read("commands", panel.commands);
  table.read("allow", panel.allow);
  const std::vector<std::string> allowed = panel.allow.value_or(std::vector<std::string>());
  const auto wrong = std::find_if_not(allowed.begin(), allowed.end(), is_numeric_address);
  if (wrong != allowed.end())
    return table.fail("allow", "'" + *wrong + "' is no numeric address; write for example \"192.168.0.7\"");
  table.finish();
}

}  // namespace

ConfigError load_session(const std::string& path, SessionSettings& settings) {
  TomlDocument document = read_toml(path);
  if (document.error) return document.error;
  SessionSettings read = settings;
  TableReader root(document, document.root, "");
  read_path(root, "design", path, read.design);
  read_source(root, path, read.source);
  read_path(root, "device", path, read.device);
  read_path(root, "session", path, read.session);
  root.read("until_idle", read.until_idle, NumberRange{1e-3, kLongestIdle});
  if (root.has("capacity")) {
    std::uint32_t capacity = 0;
    root.read_whole("capacity", capacity, {6, kMostPoints});
    read.capacity = capacity;
  }
  root.read("headless", read.headless);
  if (std::optional<TableReader> fit = root.table("fit")) read_fit_table(*fit, read.fit);
  if (std::optional<TableReader> panel = root.table("panel")) read_panel(*panel, read.panel);
  root.finish();
  if (!document.error) settings = std::move(read);
  return document.error;
}

}  // namespace bladefit

#include "config/session_settings.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "config/fit_table.hpp"
#include "config/table_reader.hpp"
#include "config/zone_table.hpp"
#include "core/localizer/check_config.hpp"
#include "drivers/modbus/modbus_settings.hpp"
#include "drivers/source_registry.hpp"
#include "drivers/source_uri.hpp"

namespace bladefit {
namespace {

constexpr double kLongestIdle = 1e6;  ///< [s]

/// A source URI, whose path is made one of the working directory.
void read_source(TableReader& table, std::optional<std::string>& source) {
  if (!table.has("source")) return;
  table.read("source", source);
  if (!table.good()) return;
  SourceSettings scratch;
  if (const Failure failure = apply_source_uri(*source, scratch)) return table.fail("source", failure.message);
  if (!protocol_of(scratch)->place_is_path) return;
  const std::size_t path = source->find(':') + 1;
  source = source->substr(0, path) + table.from_folder(source->substr(path));
}

/// A number of points, or the path of a file of points.
void read_plan(TableReader& table, std::optional<PointPlan>& plan) {
  constexpr double kMostPoints = 4294967295;
  PointPlan read;
  if (table.has_text("plan")) {
    std::string text;
    table.read("plan", text);
    if (const Failure failure = parse_point_plan(text, read)) return table.fail("plan", failure.message);
    if (!read.file.empty()) read.file = table.from_folder(read.file);
  } else if (table.has("plan")) {
    table.read_whole("plan", read.count, {1, kMostPoints});
  } else {
    return;
  }
  if (table.good()) plan = std::move(read);
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
  WordOrder order = WordOrder::high_first;
  table.read_choice<WordOrder>("word_order", order, kWordOrders);
  if (table.has("word_order")) panel.low_word_first = order == WordOrder::low_first;
  table.read("infinity", panel.infinity);
  if (panel.infinity && std::isnan(*panel.infinity))
    table.fail("infinity", "is not a number; give one such as 0 or 9999");
  table.read("linger", panel.linger, NumberRange{0, kLongestIdle});
  table.read("allow", panel.allow);
  const std::vector<std::string> allowed = panel.allow.value_or(std::vector<std::string>());
  const auto wrong = std::find_if_not(allowed.begin(), allowed.end(), is_numeric_address);
  if (wrong != allowed.end())
    return table.fail("allow", "'" + *wrong + "' is not a numeric address; write for example \"192.168.0.7\"");
  table.read("http", panel.http);
  table.read_path("http_token_file", panel.http_token_file);
  table.finish();
}

}  // namespace

Failure load_session(const std::string& path, SessionSettings& settings) {
  TomlDocument document = read_toml(path);
  if (document.error) return document.error;
  SessionSettings read = settings;
  TableReader root(document, document.root, "");
  root.read_path("design", read.design);
  read_source(root, read.source);
  root.read_path("device", read.device);
  root.read_path("session", read.session);
  root.read("until_idle", read.until_idle, NumberRange{1e-3, kLongestIdle});
  if (root.has("capacity")) {
    std::uint32_t capacity = 0;
    root.read_whole("capacity", capacity, {kLeastCapacity, kMostCapacity});
    read.capacity = capacity;
  }
  root.read("headless", read.headless);
  read_plan(root, read.plan);
  if (std::optional<TableReader> fit = root.table("fit")) read_fit_table(*fit, read.fit);
  read_zone_tables(root, read.fit.zones);
  if (std::optional<TableReader> panel = root.table("panel")) read_panel(*panel, read.panel);
  if (std::optional<TableReader> report = root.table("report")) read_report_table(*report, read.report);
  root.finish();
  if (!document.error) settings = std::move(read);
  return document.error;
}

}  // namespace bladefit

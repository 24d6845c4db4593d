#include "config/fit_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "config/fit_table.hpp"
#include "drivers/text/text_number.hpp"

namespace bladefit {
namespace {

constexpr double kSmallest = 1e-12;  ///< of what must be above 0

/// Cuts the text up to the next colon off `rest`.
std::string_view take_part(std::string_view& rest) {
  const std::size_t colon = rest.find(':');
  const std::string_view part = rest.substr(0, colon);
  rest.remove_prefix(colon == std::string_view::npos ? rest.size() : colon + 1);
  return part;
}

/// Reads `a:b`, 0 <= a < b <= 1. False: it is not that.
bool parse_interval(std::string_view text, double& low, double& high) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return false;
  const std::optional<double> first = parse_finite(text.substr(0, colon));
  const std::optional<double> second = parse_finite(text.substr(colon + 1));
  if (!first || !second || !(*first >= 0 && *first < *second && *second <= 1)) return false;
  low = *first;
  high = *second;
  return true;
}

/// Reads a text that must be one of `names`.
template <std::size_t count>
void read_name(TableReader& table, std::string_view key, std::optional<std::string>& value,
               const std::array<std::string_view, count>& names) {
  table.read(key, value);
  if (!table.good() || !value || !table.has(key)) return;
  std::string known;
  for (const std::string_view name : names) {
    if (*value == name) return;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  table.fail(key, fmt::format("'{}' is none of: {}", *value, known));
}

void read_boxes(TableReader& table, FitSettings& settings) {
  table.read("leading_edge", settings.leading_edge);
  if (!table.good() || !settings.leading_edge) return;
  if (settings.leading_edge->size() > ToleranceMap::kMaxBoxes) {
    table.fail("leading_edge", fmt::format("has more than {} boxes", ToleranceMap::kMaxBoxes));
  }
  for (const std::string& text : *settings.leading_edge) {
    ParameterBox box;
    if (const Failure error = parse_leading_edge(text, box)) table.fail("leading_edge", error.message);
  }
}

void read_window(TableReader& table, FitSettings& settings) {
  table.read("window", settings.window);
  if (!table.good() || !settings.window) return;
  ParameterWindow window;
  if (const Failure error = parse_window(*settings.window, window)) table.fail("window", error.message);
}

void read_lock(TableReader& table, FitSettings& settings) {
  table.read("lock", settings.lock);
  if (!table.good() || !settings.lock) return;
  std::uint8_t locked = 0;
  if (const Failure error = parse_lock(*settings.lock, locked)) table.fail("lock", error.message);
}

}  // namespace

Failure parse_lock(std::string_view text, std::uint8_t& locked) {
  std::uint32_t read = 0;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t comma = rest.find(',');
    const std::string_view name = trimmed(rest.substr(0, comma));
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
    const auto* known = std::find(kDegreesOfFreedom.begin(), kDegreesOfFreedom.end(), name);
    if (known == kDegreesOfFreedom.end()) {
      return bad_input(
          fmt::format("'{}' is no degree of freedom; write some of tx,ty,tz,rx,ry,rz with commas between them", name));
    }
    read |= 1U << static_cast<unsigned>(known - kDegreesOfFreedom.begin());
  }
  if (read == 63U) return bad_input("all six degrees of freedom are locked; leave one free for the fit");
  locked = static_cast<std::uint8_t>(read);
  return {};
}

Failure parse_leading_edge(std::string_view text, ParameterBox& box) {
  const Failure wrong = bad_input(
      fmt::format("'{}' is no leading-edge box; write [PATCH:]u:0.4:0.6 or [PATCH:]v:0.4:0.6 with limits from 0 to 1, "
                  "the lower first",
                  text));
  std::string_view rest = text;
  ParameterBox read;
  std::string_view part = take_part(rest);
  if (part != "u" && part != "v") {
    const std::optional<std::uint32_t> patch = parse_whole<std::uint32_t>(part);
    if (!patch) return wrong;
    read.patch = *patch;
    part = take_part(rest);
  }
  if (part != "u" && part != "v") return wrong;
  const bool along_u = part == "u";
  if (!parse_interval(rest, along_u ? read.u_min : read.v_min, along_u ? read.u_max : read.v_max)) return wrong;
  box = read;
  return {};
}

Failure parse_window(std::string_view text, ParameterWindow& window) {
  if (parse_interval(text, window.low, window.high)) return {};
  return bad_input(fmt::format("'{}' is no window; write 0.05:0.95, limits from 0 to 1, the lower first", text));
}

void read_fit_table(TableReader& table, FitSettings& settings) {
  constexpr std::array<std::string_view, 5> kModes = {"least_squares", "minimax", "range", "min_tolerance",
                                                      "constrained"};
  constexpr std::array<std::string_view, 3> kOutward = {"+", "-", "auto"};
  constexpr std::array<std::string_view, 2> kUnits = {"mm", "in"};
  constexpr std::array<std::string_view, 2> kRegions = {"follow", "fixed"};
  constexpr std::array<std::string_view, 2> kEdges = {"skip", "use"};
  constexpr std::array<std::string_view, 3> kLosses = {"none", "huber", "tukey"};
  read_name(table, "mode", settings.mode, kModes);
  read_boxes(table, settings);
  table.read("tolerance", settings.tolerance, NumberRange{kSmallest, kLargestSetting});
  table.read("rest_tolerance", settings.rest_tolerance, NumberRange{kSmallest, kLargestSetting});
  table.read("ratio", settings.ratio, NumberRange{1, kLargestSetting});
  table.read("transition", settings.transition, NumberRange{0, 1});
  read_window(table, settings);
  read_name(table, "outward", settings.outward, kOutward);
  table.read("probe_radius", settings.probe_radius, NumberRange{0, kLargestSetting});
  read_name(table, "units", settings.units, kUnits);
  read_name(table, "regions", settings.regions, kRegions);
  read_name(table, "edges", settings.edges, kEdges);
  read_lock(table, settings);
  read_name(table, "loss", settings.loss, kLosses);
  table.read("loss_scale", settings.loss_scale, NumberRange{kSmallest, kLargestSetting});
  table.read_path("start", settings.start);
  table.read("ignore_approach", settings.ignore_approach);
  table.finish();
}

Failure load_fit(const std::string& path, FitSettings& settings) {
  TomlDocument document = read_toml(path);
  if (document.error) return document.error;
  FitSettings read = settings;
  TableReader root(document, document.root, "");
  if (std::optional<TableReader> fit = root.table("fit")) read_fit_table(*fit, read);
  root.finish();
  if (!document.error) settings = std::move(read);
  return document.error;
}

}  // namespace bladefit

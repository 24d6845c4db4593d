#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "config/device_settings.hpp"
#include "config/session_settings.hpp"
#include "config/zone_table.hpp"
#include "drivers/dro/axis_gatherer.hpp"
#include "drivers/dro/dro_line.hpp"
#include "drivers/replay/points_csv.hpp"
#include "drivers/serial/line_framer.hpp"
#include "drivers/serial/serial_message.hpp"
#include "drivers/source/crc16.hpp"
#include "tests/fuzz/reader.hpp"
#include "tools/batch/start_pairs.hpp"
#include "tools/design/occ/memory_file.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit::fuzz {
namespace {

bool is_sane(const ProbePoint& point) {
  const auto finite = [](double number) { return std::isfinite(number); };
  double square = 0;
  for (const double part : point.approach) square += part * part;
  return std::ranges::all_of(point.position, finite) && (square == 0 || std::abs(square - 1) < 1e-6) &&
         point.weight > 0 && finite(point.weight);
}

Answer answer_of(const Failure& failure) { return {failure.message, broken_words(failure.message)}; }

Answer read_points(std::string_view bytes) {
  const PointsFile file = parse_points_csv(bytes, "points.csv", {});
  if (file.error) return answer_of(file.error);
  if (!std::ranges::all_of(file.points, is_sane)) return {"", "a point that is not a point was read"};
  return {"", file.points.empty() ? "a list without points was read" : ""};
}

/// What a line is refused with; empty where it is read as numbers.
std::string refusal_of_line(std::string_view text, const DroSettings& settings) {
  DroLine line;
  const Failure failure = parse_dro_line(text, settings, line);
  for (const auto& axis : line.axes) {
    if (axis && !std::isfinite(axis->mm)) throw std::logic_error("an axis that is not a number was read");
  }
  return failure.message;
}

/// Lines as a port gives them, with decimal marks and as bare digits of a given scale: one of the two reads each.
Answer read_readout(std::string_view bytes) {
  const DroSettings marked;
  DroSettings scaled;
  scaled.scale = 0.001;
  std::string refusal;
  for (std::string_view rest = bytes; !rest.empty();) {
    const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const std::string told = refusal_of_line(line, marked);
    if (!told.empty() && !refusal_of_line(line, scaled).empty() && refusal.empty()) refusal = told;
  }
  return {refusal, broken_words(refusal)};
}

/// The stream cut into lines, and each line decoded. A good point is told again by the same words.
Answer read_serial(std::string_view bytes) {
  LineFramer framer;
  std::string refusal;
  for (std::string_view rest = bytes; !rest.empty(); rest.remove_prefix(std::min<std::size_t>(rest.size(), 7)))
    framer.add(rest.substr(0, 7));
  while (const std::optional<FramedLine> line = framer.next()) {
    const SerialMessage message = parse_message(line->text);
    if (!line->damage.empty()) refusal = line->damage;
    if (message.kind == SerialMessage::Kind::damaged) refusal = message.damage;
    if (message.kind != SerialMessage::Kind::point) continue;
    if (!is_sane(message.point)) return {"", "a point that is not a point was read"};
    if (message.number == 0 || message.point.sequence != message.number) return {"", "a point has another sequence"};
  }
  return {refusal, broken_words(refusal)};
}

/// Gives every line that has a check sum the right one.
void repair_lines(std::string& bytes) {
  for (std::size_t begin = bytes.find('$'); begin != std::string::npos; begin = bytes.find('$', begin + 1)) {
    const std::size_t star = bytes.find('*', begin);
    if (star == std::string::npos || star + 5 > bytes.size()) return;
    const std::string_view content = std::string_view(bytes).substr(begin + 1, star - begin - 1);
    bytes.replace(star + 1, 4, fmt::format("{:04X}", crc16(content)));
  }
}

/// The settings are as before where they are refused.
template <typename Settings, typename Load>
Answer read_toml_file(std::string_view bytes, const Load& load) {
  const MemoryFile file(bytes);
  Settings settings;
  return answer_of(load(file.path(), settings));
}

Answer read_device(std::string_view bytes) { return read_toml_file<SourceSettings>(bytes, load_device); }
Answer read_session(std::string_view bytes) { return read_toml_file<SessionSettings>(bytes, load_session); }

bool is_sane(const ZoneSettings& zone) {
  const auto limit = [](const Length& length) { return length.value > 0 && std::isfinite(length.value); };
  const bool band = zone.place.band && zone.place.band->low >= 0 && zone.place.band->low < zone.place.band->high;
  return !zone.name.empty() && limit(zone.plus) && limit(zone.minus) && (band || !zone.place.edges.empty());
}

Answer read_zones(std::string_view bytes) {
  const MemoryFile file(bytes);
  std::optional<std::vector<ZoneSettings>> zones;
  if (const Failure failure = load_zones(file.path(), zones)) return answer_of(failure);
  const bool some = zones && !zones->empty() && zones->size() <= ToleranceMap::kMaxZones;
  const auto sane = [](const ZoneSettings& zone) { return is_sane(zone); };
  return {"", some && std::ranges::all_of(*zones, sane) ? "" : "a zone without a place or a limit was read"};
}

Answer read_pairs(std::string_view bytes) {
  const MemoryFile file(bytes);
  try {
    const StartPairs pairs = read_start_pairs(file.path(), {});
    const Mat3 apart = pairs.pose.rotation.transpose() * pairs.pose.rotation - Mat3::Identity();
    const bool rigid = apart.allFinite() && apart.cwiseAbs().maxCoeff() < 1e-6;
    return {"", rigid && pairs.pose.translation.allFinite() ? "" : "the pairs give no rigid motion"};
  } catch (const ToolError& error) {
    return {error.what(), broken_words(error.what())};
  }
}

}  // namespace

const Reader kPoints{"points", read_points, nullptr};
const Reader kReadout{"readout", read_readout, nullptr};
const Reader kSerial{"serial", read_serial, repair_lines};
const Reader kDeviceFile{"device", read_device, nullptr};
const Reader kSessionFile{"session", read_session, nullptr};
const Reader kZonesFile{"zones", read_zones, nullptr};
const Reader kStartPairs{"pairs", read_pairs, nullptr};

}  // namespace bladefit::fuzz

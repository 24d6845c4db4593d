#include "tools/doctor/line_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "drivers/dro/axis_gatherer.hpp"
#include "drivers/dro/dro_line.hpp"
#include "drivers/serial/line_framer.hpp"
#include "drivers/serial/serial_message.hpp"

namespace bladefit {
namespace {

/// A line without a beginning cannot be read, whatever the settings.
constexpr std::size_t kPerhapsCut = 1;
constexpr double kReadableShare = 0.75;

/// What is left in the gatherer when no more lines come is shown as if a pause followed.
constexpr auto kAfterAll = AxisGatherer::kPause;

struct OtherSettings {
  DroSettings settings;
  std::vector<std::string> changes;
};

/// Both decimal marks, with and without labels, the settings as they are first.
std::vector<OtherSettings> other_settings(const DroSettings& settings) {
  std::vector<OtherSettings> all;
  for (const bool other_labels : {false, true}) {
    for (const bool other_mark : {false, true}) {
      OtherSettings other{settings, {}};
      if (other_labels) {
        other.settings.labels = !settings.labels;
        other.changes.push_back(fmt::format("[dro] labels = {}", other.settings.labels));
      }
      if (other_mark) {
        const char mark = settings.decimal_mark == '.' ? ',' : '.';
        other.settings.decimal_mark = mark;
        std::erase(other.settings.separators, mark);
        other.changes.push_back(fmt::format("[dro] decimal_mark = \"{}\"", mark));
      }
      all.push_back(std::move(other));
    }
  }
  return all;
}

bool is_ignored(std::string_view line, const DroSettings& settings) {
  const bool prefixed = !settings.ignore_prefix.empty() && line.starts_with(settings.ignore_prefix);
  return prefixed || line.find_first_not_of(settings.separators) == std::string_view::npos;
}

LineReading read_with(const std::vector<Heard::Line>& lines, const DroSettings& settings) {
  LineReading reading;
  AxisGatherer gatherer(settings);
  std::vector<DroPoint> points;
  DroOutcome outcome;
  for (const Heard::Line& line : lines) {
    if (is_ignored(line.text, settings)) continue;
    ++reading.lines;
    DroLine parsed;
    if (const Failure failure = parse_dro_line(line.text, settings, parsed)) {
      gatherer.line_lost();
      if (reading.fault.empty())
        reading.fault = fmt::format("{} in the line '{}'", failure.message, printable(line.text));
      continue;
    }
    ++reading.readable;
    gatherer.take(parsed, line.at, points, outcome);
  }
  if (!lines.empty()) gatherer.silence(lines.back().at + kAfterAll, points, outcome);
  for (const DroPoint& numbers : points) {
    ProbePoint point;
    for (std::size_t axis = 0; axis < 3; ++axis) point.position[axis] = numbers[axis].mm;
    reading.points.push_back(point);
  }
  return reading;
}

}  // namespace

bool LineReading::makes_sense() const {
  const std::size_t counted = std::max(lines - std::min(lines, kPerhapsCut), readable);
  return readable > 0 && static_cast<double>(readable) >= kReadableShare * static_cast<double>(counted);
}

LineReading read_protocol(const std::vector<Heard::Line>& lines) {
  LineReading reading;
  LineFramer framer;
  for (const Heard::Line& line : lines) {
    ++reading.lines;
    framer.add(line.text + "\n");
    while (const std::optional<FramedLine> framed = framer.next()) {
      const SerialMessage message = framed->damage.empty() ? parse_message(framed->text) : SerialMessage{};
      const bool damaged = !framed->damage.empty() || message.kind == SerialMessage::Kind::damaged;
      if (damaged && reading.fault.empty()) reading.fault = framed->damage.empty() ? message.damage : framed->damage;
      if (damaged) continue;
      ++reading.readable;
      if (message.kind == SerialMessage::Kind::point) reading.points.push_back(message.point);
    }
  }
  return reading;
}

LineReading read_readout(const std::vector<Heard::Line>& lines, const DroSettings& settings) {
  LineReading best;
  for (const OtherSettings& other : other_settings(settings)) {
    LineReading reading = read_with(lines, other.settings);
    reading.changes = other.changes;
    const bool better = reading.makes_sense() && (!best.makes_sense() || reading.points.size() > best.points.size());
    if (other.changes.empty() || better) best = std::move(reading);
    if (best.changes.empty() && best.makes_sense() && !best.points.empty()) break;
  }
  return best;
}

}  // namespace bladefit

#include "tools/doctor/line_examination.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tools/doctor/line_reading.hpp"

namespace bladefit {
namespace {

using LineDevice = std::variant<SerialSettings, DroSettings>;

/// Rates that are tried where nothing is readable, the usual ones first [baud].
constexpr std::array<int, 8> kRates = {9600, 115200, 19200, 38400, 57600, 4800, 2400, 1200};
/// Lines to listen for: with an axis a line these are some points.
constexpr std::size_t kLines = 24, kLinesOfRate = 3, kLinesShown = 3;
/// Share of the time given that the settings as they are get; other rates share the rest.
constexpr double kFirstShare = 0.5;
constexpr std::chrono::milliseconds kLongestOfRate{2000};

bool is_readout(const LineDevice& settings) { return std::holds_alternative<DroSettings>(settings); }

const SerialLineSettings& line_of(const LineDevice& settings) {
  return std::visit([](const auto& device) -> const SerialLineSettings& { return device.line; }, settings);
}

/// The lines as the settings have them, else as those of a device of the other kind.
LineReading read_lines(const std::vector<Heard::Line>& lines, const LineDevice& settings) {
  const auto* const dro = std::get_if<DroSettings>(&settings);
  LineReading own = dro != nullptr ? read_readout(lines, *dro) : read_protocol(lines);
  if (own.makes_sense()) return own;
  LineReading other = dro != nullptr ? read_protocol(lines) : read_readout(lines, DroSettings{});
  if (!other.makes_sense() || other.points.empty()) return own;
  other.changes.insert(other.changes.begin(), dro != nullptr ? "kind = \"serial\"" : "kind = \"dro\"");
  return other;
}

/// The lines as they are, else with their parity bits taken for such.
LineReading read_heard(const Heard& heard, const LineDevice& settings) {
  LineReading reading = read_lines(heard.lines, settings);
  if (reading.makes_sense() || line_of(settings).data_bits != 8) return reading;
  Parity parity = Parity::none;
  LineReading stripped = read_lines(without_parity(heard, parity), settings);
  if (!stripped.makes_sense()) return reading;
  const auto* const named = std::ranges::find(kParities, parity, &std::pair<std::string_view, Parity>::second);
  stripped.changes.insert(stripped.changes.begin(),
                          fmt::format("[line] data_bits = 7 and parity = \"{}\"", named->first));
  return stripped;
}

/// Listens at other rates until one makes the lines readable.
LineReading try_rates(const LineDevice& settings, Deadline until) {
  for (const int rate : kRates) {
    const Deadline now = std::chrono::steady_clock::now();
    SerialLineSettings line = line_of(settings);
    if (rate == line.baud) continue;
    if (now >= until) break;
    line.baud = rate;
    const Heard heard = listen(line, kLinesOfRate, std::min(until, now + kLongestOfRate));
    LineReading reading = read_heard(heard, settings);
    if (heard.failure || !reading.makes_sense()) continue;
    reading.changes.insert(reading.changes.begin(), fmt::format("[line] baud = {}", rate));
    return reading;
  }
  return {};
}

std::string silence_words(const LineDevice& settings) {
  if (is_readout(settings))
    return "the port opens, but nothing came; let the read-out send points while doctor listens, or check the cable";
  return "the port opens and is silent, as a machine of this protocol is until a session starts it, which doctor does "
         "not; "
         "run doctor while it sends, or begin a session with `bladefit run`";
}

void tell_lines(const Heard& heard, Examination& examination) {
  examination.seen.push_back(fmt::format("{} bytes came, {} lines", heard.bytes, heard.lines.size()));
  for (std::size_t index = 0; index < std::min(heard.lines.size(), kLinesShown); ++index)
    examination.seen.push_back("  '" + printable(heard.lines[index].text) + "'");
}

}  // namespace

Examination examine_line(const LineDevice& settings, Deadline until) {
  Examination examination;
  const Deadline now = std::chrono::steady_clock::now();
  const auto share = std::chrono::duration_cast<Deadline::duration>(kFirstShare * (until - now));
  const Heard heard = listen(line_of(settings), kLines, now + share);
  if (heard.failure) {
    examination.outcome = Outcome::unreachable;
    examination.conclusion = heard.failure.message;
    return examination;
  }
  examination.seen.push_back(fmt::format("the port opens at {} baud", line_of(settings).baud));
  if (heard.bytes == 0) {
    examination.conclusion = silence_words(settings);
    return examination;
  }
  tell_lines(heard, examination);
  LineReading reading = read_heard(heard, settings);
  if (!reading.makes_sense()) {
    examination.seen.push_back("unreadable: " + (reading.fault.empty() ? "no whole line came" : reading.fault));
    reading = try_rates(settings, until);
  }
  if (!reading.makes_sense()) {
    examination.conclusion =
        "no rate, parity or format that was tried makes sense of the bytes; compare the lines above with the device's "
        "manual and correct [line] and [dro]";
    return examination;
  }
  examination.seen.push_back(
      fmt::format("{} of {} lines are readable, {} points", reading.readable, reading.lines, reading.points.size()));
  examination.points = std::move(reading.points);
  examination.changes = std::move(reading.changes);
  examination.outcome = examination.changes.empty() ? Outcome::fits : Outcome::change;
  return examination;
}

}  // namespace bladefit

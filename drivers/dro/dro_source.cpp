#include "drivers/dro/dro_source.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>

#include "drivers/dro/dro_line.hpp"
#include "drivers/source/host_clock.hpp"
#include "drivers/source/source_fault.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kLongestLine = 256;
/// The characters of a line come one after the other: after such a silence the next one begins a line.
constexpr std::chrono::milliseconds kSilence{100};

std::string printable(std::string_view line) {
  std::string text(line.substr(0, 60));
  for (char& character : text) {
    if (std::isprint(static_cast<unsigned char>(character)) == 0) character = '.';
  }
  return text;
}

}  // namespace

DroSource::DroSource(const DroSettings& settings, std::string name)
    : settings_(settings),
      name_(std::move(name)),
      port_(settings.line, settings.reconnect_first, settings.reconnect_longest),
      gatherer_(settings_),
      format_(settings_) {}

Failure DroSource::open(std::uint32_t after, std::uint32_t /*run_id*/) {
  status_ = {};
  points_.clear();
  next_ = after + 1;
  if (const Failure failure = port_.open()) return device_failure(fmt::format("{}: {}", name_, failure.message));
  status_.last_fault = port_->remark();
  link_made();
  return {};
}

void DroSource::link_made() {
  status_.link = LinkState::up;
  line_.clear();
  line_fault_.clear();
  first_line_ = true;
  from_silence_ = false;
  gatherer_.restart(false);
  last_byte_ = Clock::now();
}

std::size_t DroSource::poll(std::span<ProbePoint> points, std::chrono::milliseconds timeout) {
  return points_.wait_and_take(points, timeout, [this](Clock::time_point until) { step(until); });
}

void DroSource::step(Clock::time_point until) {
  if (!port_->is_open()) return reconnect(until);
  std::array<char, 4096> bytes{};
  const std::optional<std::size_t> count = port_->read(bytes, until);
  if (!count) return link_lost();
  if (*count > 0) {
    bytes_came({bytes.data(), *count});
  } else {
    silence();
  }
  status_.behind = gatherer_.waits();
}

void DroSource::bytes_came(std::string_view bytes) {
  const Clock::time_point now = Clock::now();
  if (first_line_ && line_.empty() && now - last_byte_ >= kSilence) {
    from_silence_ = true;
    gatherer_.restart(true);
  }
  last_byte_ = now;
  for (const char byte : bytes) take(byte);
}

void DroSource::silence() {
  const Clock::time_point now = Clock::now();
  std::vector<DroPoint> points;
  DroOutcome outcome;
  gatherer_.silence(now, points, outcome);
  sort_out(points, std::move(outcome));
  const bool unfinished = !line_.empty() && line_fault_.empty();
  if (!unfinished || now - last_byte_ < AxisGatherer::kPatience) return;
  line_fault_ = "no end of the line came (the read-out must send CR or LF behind it)";
  line_lost(line_fault_, first_line_ && !from_silence_);
}

void DroSource::take(char byte) {
  if (byte == '\r' || byte == '\n') {
    take_line();
    line_.clear();
    line_fault_.clear();
  } else if (line_.size() < kLongestLine) {
    line_ += byte;
  } else if (line_fault_.empty()) {
    line_fault_ = "the line is too long";
    line_lost(line_fault_, first_line_ && !from_silence_);
  }
}

void DroSource::take_line() {
  const std::string& prefix = settings_.ignore_prefix;
  const bool ignored = !prefix.empty() && line_.starts_with(prefix);
  if (line_.find_first_not_of(settings_.separators) == std::string::npos || ignored) return;
  const bool perhaps_cut = std::exchange(first_line_, false) && !from_silence_;
  if (!line_fault_.empty()) return;
  DroLine line;
  if (const Failure failure = parse_dro_line(line_, settings_, line)) return line_lost(failure.message, perhaps_cut);
  if (perhaps_cut && !line.shows_its_beginning) {
    line_lost("the beginning may be missing, since it came as the port was opened,", false);
    return;
  }
  std::vector<DroPoint> points;
  DroOutcome outcome;
  gatherer_.take(line, Clock::now(), points, outcome);
  sort_out(points, std::move(outcome));
}

/// The first line may have begun before the port was opened: then no point of this session is lost.
void DroSource::line_lost(const std::string& what, bool perhaps_cut) {
  gatherer_.line_lost();
  ++status_.damaged;
  const std::string text = fmt::format("{} in the line '{}'; probe the point again", what, printable(line_));
  if (perhaps_cut) {
    note_remark(status_, text);
  } else {
    note_unnumbered_loss(status_, text);
  }
}

void DroSource::sort_out(const std::vector<DroPoint>& points, DroOutcome outcome) {
  for (const DroPoint& point : points) format_.take(point, outcome);
  for (const DroPoint& point : outcome.points) deliver(point);
  status_.damaged += outcome.losses.size() + outcome.faults.size();
  const auto told = [this](const std::string& what) {
    return fmt::format("{}, at the line '{}'; probe the point again", what, printable(line_));
  };
  for (const std::string& fault : outcome.faults) note_remark(status_, told(fault));
  for (const std::string& loss : outcome.losses) note_unnumbered_loss(status_, told(loss));
}

void DroSource::deliver(const DroPoint& numbers) {
  ProbePoint point;
  for (std::size_t axis = 0; axis < 3; ++axis) point.position[axis] = numbers[axis].mm;
  point.sequence = next_++;
  point.time_us = host_time_us();
  points_.push(point);
  ++status_.records;
  note_good(status_);
}

void DroSource::link_lost() {
  note_unnumbered_loss(status_, "points probed while the port is down are lost; probe them again once the link is up");
  port_.lost("the port has hung up; check the cable", status_);
}

void DroSource::reconnect(Clock::time_point until) {
  if (port_.reopen(until, status_)) link_made();
}

}  // namespace bladefit

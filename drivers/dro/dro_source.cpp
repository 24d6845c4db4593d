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
      port_(settings.line, settings.reconnect_first, settings.reconnect_longest) {}

Failure DroSource::open(std::uint32_t after, std::uint32_t /*run_id*/) {
  status_ = {};
  points_.clear();
  line_.clear();
  too_long_ = false;
  first_line_ = true;
  next_ = after + 1;
  if (const Failure failure = port_.open()) return device_failure(fmt::format("{}: {}", name_, failure.message));
  status_.link = LinkState::up;
  status_.last_fault = port_->remark();
  return {};
}

std::size_t DroSource::poll(std::span<ProbePoint> points, std::chrono::milliseconds timeout) {
  return points_.wait_and_take(points, timeout, [this](Clock::time_point until) { step(until); });
}

void DroSource::step(Clock::time_point until) {
  if (!port_->is_open()) return reconnect(until);
  std::array<char, 4096> bytes{};
  const std::optional<std::size_t> count = port_->read(bytes, until);
  if (!count) return link_lost();
  for (std::size_t index = 0; index < *count; ++index) take(bytes[index]);
}

void DroSource::take(char byte) {
  if (byte == '\r' || byte == '\n') {
    take_line();
    line_.clear();
    too_long_ = false;
  } else if (line_.size() < kLongestLine) {
    line_ += byte;
  } else {
    too_long_ = true;
  }
}

void DroSource::take_line() {
  const std::string& prefix = settings_.ignore_prefix;
  const bool ignored = !prefix.empty() && line_.starts_with(prefix);
  if (line_.find_first_not_of(settings_.separators) == std::string::npos || ignored) return;
  const bool perhaps_cut = std::exchange(first_line_, false);
  ProbePoint point;
  const Failure failure =
      too_long_ ? bad_input("the line is too long") : parse_dro_line(line_, settings_, point.position);
  if (!failure) {
    point.sequence = next_++;
    point.time_us = host_time_us();
    points_.push(point);
    ++status_.records;
    note_good(status_);
    return;
  }
  ++status_.damaged;
  const std::string text = fmt::format("{} in the line '{}'; probe the point again", failure.message, printable(line_));
  if (perhaps_cut) {
    note_fault(status_, text);
  } else {
    note_unnumbered_loss(status_, text);
  }
}

void DroSource::link_lost() {
  note_unnumbered_loss(status_, "points probed while the port is down are lost; probe them again once the link is up");
  port_.lost("the port has hung up; check the cable", status_);
}

void DroSource::reconnect(Clock::time_point until) {
  if (!port_.reopen(until, status_)) return;
  status_.link = LinkState::up;
  line_.clear();
  first_line_ = true;
}

}  // namespace bladefit

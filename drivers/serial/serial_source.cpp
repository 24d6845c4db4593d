#include "drivers/serial/serial_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <thread>

#include "drivers/serial/protocol_v1.hpp"
#include "drivers/source/host_clock.hpp"
#include "drivers/source/source_fault.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kMostUnsent = 1024;  ///< bytes the port does not take
constexpr std::chrono::milliseconds kPortCloseTime{700};
constexpr const char* kHangUp = "the port has hung up; check the cable";

}  // namespace

SerialSource::SerialSource(const SerialSettings& settings, std::string name)
    : settings_(settings),
      name_(std::move(name)),
      session_(settings_, status_),
      port_(settings.line, settings.reconnect_first, settings.reconnect_longest) {}

Failure SerialSource::open(std::uint32_t after, std::uint32_t run_id) {
  status_ = {};
  session_.restart(after, run_id);
  if (const Failure failure = port_.open()) return device_failure(fmt::format("{}: {}", name_, failure.message));
  link_made();
  const Clock::time_point deadline = Clock::now() + settings_.open_timeout;
  const auto answered = [this] { return session_.running() || session_.stopped(); };
  while (!answered() && Clock::now() < deadline) step(deadline);
  if (!status_.stopped.empty()) {
    port_->close();
    return device_failure(fmt::format("{}: {}", name_, status_.stopped));
  }
  if (answered()) return {};
  const std::string fault = port_->is_open()
                                ? "the device does not answer $START; switch it on, or correct baud and parity"
                                : status_.last_fault;
  port_->close();
  return device_failure(fmt::format("{}: {}", name_, fault));
}

std::size_t SerialSource::poll(std::span<ProbePoint> points, std::chrono::milliseconds timeout) {
  const std::size_t count =
      session_.points().wait_and_take(points, timeout, [this](Clock::time_point until) { step(until); });
  status_.finished = session_.finished();
  if (session_.points().empty()) status_.last = session_.last();
  status_.behind = session_.behind();
  return count;
}

/// Sends what is due and takes what comes. Returns as soon as something came, at `until` at the latest.
void SerialSource::step(Clock::time_point until) {
  if (session_.stopped()) {
    std::this_thread::sleep_until(until);
    return;
  }
  if (!port_->is_open()) return reconnect(until);
  session_.tick(Clock::now());
  send();
  if (!port_->is_open()) return;
  std::array<char, 4096> bytes{};
  const std::optional<std::size_t> count = port_->read(bytes, std::min(until, session_.next_tick()));
  if (!count) return link_lost(kHangUp);
  framer_.add({bytes.data(), *count});
  take_lines();
  send();
}

void SerialSource::take_lines() {
  while (const std::optional<FramedLine> line = framer_.next()) {
    const Clock::time_point now = Clock::now();
    if (!line->damage.empty()) {
      session_.damaged(line->damage, now);
    } else if (!settings_.echo || !echo_.takes(line->text)) {
      session_.received(parse_message(line->text), now, host_time_us());
    }
  }
}

void SerialSource::send() {
  const std::string output = session_.take_output();
  if (settings_.echo) echo_.sent(output);
  if (echo_.overdue()) {
    echo_.reset();
    note_fault(status_, "nothing of what is sent comes back; set echo = false");
  }
  unsent_ += output;
  if (unsent_.empty() || !port_->is_open()) return;
  const std::optional<std::size_t> count = port_->write(unsent_);
  if (!count) return link_lost(kHangUp);
  unsent_.erase(0, *count);
  if (unsent_.size() <= kMostUnsent) return;
  // Whatever is dropped here, the session says again when the device stays silent.
  unsent_.clear();
  note_fault(status_, "the device takes no bytes; check the cable");
}

void SerialSource::link_made() {
  framer_.reset();
  echo_.reset();
  unsent_.clear();
  if (!port_->remark().empty()) status_.last_fault = port_->remark();
  session_.link_made(Clock::now());
}

void SerialSource::link_lost(const std::string& fault) {
  session_.link_lost();
  port_.lost(fault, status_);
}

void SerialSource::reconnect(Clock::time_point until) {
  if (port_.reopen(until, status_)) link_made();
}

void SerialSource::close() {
  if (!port_->is_open()) return;
  send();
  // A device in another run is left to it.
  if (!session_.stopped()) unsent_ += encode_line(serial_protocol_v1::kStopTag);
  const Clock::time_point until = Clock::now() + kPortCloseTime;
  while (port_->is_open() && !unsent_.empty() && Clock::now() < until) {
    send();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  port_->drain(until);
  port_->close();
  session_.link_lost();
}

}  // namespace bladefit

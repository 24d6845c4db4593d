#include "drivers/modbus/modbus_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "drivers/modbus/cmm_requests.hpp"
#include "drivers/source/host_clock.hpp"
#include "drivers/source/source_fault.hpp"

namespace bladefit {
namespace {

constexpr int kOpenTransactions = 10;    ///< that many reply timeouts are granted to open()
constexpr int kHeadersToOpen = 3;        ///< one to know the device by, two to see the run that the start has begun
constexpr int kHeadersOfAnotherRun = 2;  ///< a header has no check sum
constexpr int kHeaderTries = 3;          ///< a refused header may have been damaged on its way
constexpr int kTimeoutsToLost = 3;       ///< missing replies in a row after which the link counts as lost
constexpr std::chrono::milliseconds kCloseTime{700};

}  // namespace

ModbusSource::ModbusSource(const ModbusSettings& settings, std::string name)
    : settings_(settings),
      name_(std::move(name)),
      ring_(settings_, status_),
      link_(make_modbus_link(settings)),
      back_off_(settings.reconnect_first, settings.reconnect_longest),
      registers_(MODBUS_MAX_READ_REGISTERS) {}

ModbusSource::~ModbusSource() = default;

Failure ModbusSource::open_error(const std::string& what) {
  link_->close();
  stage_ = Stage::down;
  opening_ = false;
  return device_failure(fmt::format("{}: {}", name_, what));
}

Failure ModbusSource::open(std::uint32_t after, std::uint32_t run_id) {
  status_ = {};
  ring_.restart(after);
  stored_ = after;
  sent_ = 0;
  run_id_ = run_id;
  refusal_.clear();
  header_refusals_ = foreign_headers_ = timeouts_ = headers_ = 0;
  if (const Failure failure = check_map(settings_.map)) return open_error(failure.message);
  if (const Failure failure = link_->prepare()) return open_error(failure.message);
  opening_ = true;
  connected_ = false;
  purpose_ = Purpose::none;
  stage_ = Stage::connecting;
  link_->start_connect();
  const Clock::time_point deadline =
      Clock::now() + settings_.connect_timeout + kOpenTransactions * settings_.reply_timeout;
  while (stage_ != Stage::running || headers_ < kHeadersToOpen) {
    step(Clock::now() + settings_.reply_timeout);
    if (foreign_headers_ >= kHeadersOfAnotherRun) break;
    const bool never_connected = stage_ == Stage::down && !connected_;
    if (never_connected || Clock::now() > deadline) return open_error(status_.last_fault);
    if (!refusal_.empty()) return open_error(refusal_);
    if (timeouts_ >= kHeaderTries) {
      return open_error(fmt::format(
          "unit {} does not answer; switch it on, or correct unit and the settings of the line", settings_.unit));
    }
  }
  opening_ = false;
  return {};
}

std::size_t ModbusSource::poll(std::span<ProbePoint> points, std::chrono::milliseconds timeout) {
  return ring_.points().wait_and_take(points, timeout, [this](Clock::time_point until) { step(until); });
}

void ModbusSource::acknowledge(std::uint32_t sequence) { stored_ = std::max(stored_, sequence); }

/// Goes on with whatever is under way. Returns as soon as something has changed, at `until` at the latest.
void ModbusSource::step(Clock::time_point until) {
  if (ring_.stopped()) {
    std::this_thread::sleep_until(until);
  } else if (!link_->is_open()) {
    reconnect(until);
  } else if (purpose_ != Purpose::none) {
    finish_transaction(until);
  } else {
    begin_transaction(until);
  }
}

void ModbusSource::reconnect(Clock::time_point until) {
  if (stage_ != Stage::connecting) {
    if (Clock::now() < back_off_.retry_at()) {
      std::this_thread::sleep_until(std::min(until, back_off_.retry_at()));
      return;
    }
    stage_ = Stage::connecting;
    link_->start_connect();
  }
  const LinkEvent event = link_->connect(until);
  if (event == LinkEvent::broken) link_lost(link_->fault());
  if (event != LinkEvent::done) return;
  if (connected_) ++status_.reconnects;
  connected_ = true;
  if (!link_->remark().empty()) status_.last_fault = link_->remark();
  stage_ = Stage::identify;
  header_refusals_ = timeouts_ = 0;
  next_header_ = next_read_ = next_write_ = link_->ready_at();
}

void ModbusSource::begin_transaction(Clock::time_point until) {
  const Clock::time_point now = Clock::now();
  if (now < link_->ready_at()) return std::this_thread::sleep_until(std::min(until, link_->ready_at()));
  if (now >= next_write_ && !read_first_ && begin_write()) return;
  begin_read(now, until);
}

/// The acknowledge, or the command after it. Returns false where there is nothing to be written.
bool ModbusSource::begin_write() {
  if (foreign_headers_ > 0) return false;
  const CmmMap& map = settings_.map;
  if (stage_ == Stage::announce || (stage_ == Stage::running && stored_ != sent_)) {
    sending_ = stored_;
    if (map.acknowledge.present) {
      begin(Purpose::acknowledge, write_request(map, map.acknowledge, sending_));
      return true;
    }
    sent_ = sending_;
    if (stage_ == Stage::announce) stage_ = Stage::command;
  }
  if (stage_ == Stage::command) {
    if (next_command_ != 0) {
      begin(Purpose::command, write_request(map, map.command, next_command_));
      return true;
    }
    stage_ = Stage::running;
  }
  return false;
}

/// The header when it is due, records otherwise. On a slow line the header is always due: records come after it.
void ModbusSource::begin_read(Clock::time_point now, Clock::time_point until) {
  const CmmMap& map = settings_.map;
  // While open() waits for the start, the ring may hold an earlier run. Later a refused write keeps no record back.
  const bool wanted = stage_ == Stage::running || (!opening_ && stage_ != Stage::identify);
  const bool allowed = now >= next_read_;
  batch_ = wanted && allowed ? ring_.next_batch() : RecordBatch{};
  header_last_ = allowed && now >= next_header_ && (batch_.count == 0 || !header_last_);
  if (header_last_) {
    const RegisterBlock block = header_block(map);
    begin(Purpose::header, read_request(map, block.first, block.count));
  } else if (batch_.count > 0) {
    const auto registers = static_cast<std::uint16_t>(batch_.count * map.record_size);
    begin(Purpose::records, read_request(map, batch_.address, registers));
  } else {
    return std::this_thread::sleep_until(std::min(until, std::max(next_header_, next_read_)));
  }
  read_first_ = false;
}

void ModbusSource::begin(Purpose purpose, const ModbusRequest& request) {
  purpose_ = purpose;
  if (link_->send(request) == LinkEvent::broken) link_lost(link_->fault());
}

void ModbusSource::finish_transaction(Clock::time_point until) {
  const LinkEvent event = link_->receive(registers_, until);
  if (event == LinkEvent::done) return transaction_done();
  if (event != LinkEvent::pending) transaction_failed(event);
}

void ModbusSource::transaction_done() {
  timeouts_ = 0;
  const Purpose purpose = std::exchange(purpose_, Purpose::none);
  // A device that was silent for long may have been switched off and on: it is greeted like a new one.
  if (status_.link == LinkState::lost && stage_ == Stage::running) stage_ = Stage::identify;
  switch (purpose) {
    case Purpose::none:
      break;
    case Purpose::header:
      header_read();
      break;
    case Purpose::records:
      records_read();
      break;
    case Purpose::acknowledge:
      sent_ = sending_;
      if (stage_ == Stage::announce) stage_ = Stage::command;
      break;
    case Purpose::command:
      if (stage_ == Stage::command) stage_ = Stage::running;
      next_header_ = Clock::now() + settings_.poll_period;
      break;
  }
}

void ModbusSource::header_read() {
  next_header_ = Clock::now() + settings_.poll_period;
  const CmmHeader header = decode_header(registers_, settings_.map);
  const Failure failure = check_header(header, settings_.map);
  if (!failure) return header_accepted(header);
  ++status_.damaged;
  note_fault(status_, failure.message);
  if (++header_refusals_ >= kHeaderTries && opening_) refusal_ = failure.message;
}

void ModbusSource::header_accepted(const CmmHeader& header) {
  header_refusals_ = 0;
  // Those read while the device refuses the start cannot tell of the run that it begins.
  if (stage_ == Stage::identify || stage_ == Stage::running) headers_ = std::min(headers_ + 1, kHeadersToOpen);
  note_good(status_);
  const bool nothing_taken = ring_.next() == 1;
  foreign_headers_ = foreign(header) ? foreign_headers_ + 1 : 0;
  if (stage_ != Stage::running && foreign_headers_ == 0) identify(header);
  ring_.observe(header);
  if (nothing_taken) run_id_ = status_.run_id;
}

/// Of another run than the records taken so far: it must not be told that any of its own are stored. A device without
/// run ids always tells 0.
bool ModbusSource::foreign(const CmmHeader& header) const { return ring_.next() > 1 && header.run_id != run_id_; }

/// A good header before the device has taken its command: each decides anew which one that is.
void ModbusSource::identify(const CmmHeader& header) {
  next_command_ = command_for(settings_.map, header, ring_.next(), opening_);
  status_.link = LinkState::up;
  if (stage_ == Stage::identify) stage_ = Stage::announce;
  back_off_.succeeded();
}

void ModbusSource::records_read() {
  const std::size_t size = std::size_t{batch_.count} * settings_.map.record_size;
  const bool good = ring_.accept(batch_, std::span(registers_).first(size), host_time_us());
  // A bad record is looked at again after the header has told whether it still stands in the ring.
  if (!good) next_header_ = std::min(next_header_, Clock::now());
}

void ModbusSource::transaction_failed(LinkEvent event) {
  if (event == LinkEvent::broken) return link_lost(link_->fault());
  const Purpose purpose = std::exchange(purpose_, Purpose::none);
  note_fault(status_, link_->fault());
  if (event == LinkEvent::damaged) ++status_.damaged;
  if (event == LinkEvent::refused || event == LinkEvent::busy) return request_refused(purpose, event);
  if (event != LinkEvent::timeout) return;
  ++timeouts_;
  ++status_.resends;
  if (timeouts_ >= kTimeoutsToLost) status_.link = LinkState::lost;
  // A serial port stays open for a silent device. A TCP connection may be dead without telling.
  if (settings_.transport == ModbusTransport::tcp && timeouts_ >= settings_.timeouts_to_reconnect) {
    link_->close();
    link_lost(link_->fault());
  }
}

/// What was refused is asked again, a poll period later: a refused write must not keep from reading, nor the reverse.
void ModbusSource::request_refused(Purpose purpose, LinkEvent event) {
  read_first_ = purpose == Purpose::acknowledge || purpose == Purpose::command;
  Clock::time_point& next = read_first_ ? next_write_ : next_read_;
  next = Clock::now() + settings_.poll_period;
  if (opening_ && event == LinkEvent::refused) {
    refusal_ = link_->fault() + "; correct the addresses, or lower batch, in the device file";
  }
}

void ModbusSource::link_lost(const std::string& fault) {
  purpose_ = Purpose::none;
  stage_ = Stage::down;
  status_.link = LinkState::lost;
  note_fault(status_, fault);
  back_off_.failed(Clock::now());
}

/// Writes once and waits for the reply until `until`.
bool ModbusSource::write_now(const NumberField& field, std::uint32_t value, Clock::time_point until) {
  if (!field.present || !link_->is_open()) return false;
  std::this_thread::sleep_until(std::min(until, link_->ready_at()));
  if (link_->send(write_request(settings_.map, field, value)) != LinkEvent::done) return false;
  return link_->receive(registers_, until) == LinkEvent::done;
}

void ModbusSource::close() {
  const Clock::time_point until = Clock::now() + kCloseTime;
  if (link_->is_open() && purpose_ != Purpose::none) finish_transaction(until);
  const CmmMap& map = settings_.map;
  const bool talks = link_->is_open() && status_.link == LinkState::up && foreign_headers_ == 0;
  if (talks && stored_ != sent_ && write_now(map.acknowledge, stored_, until)) sent_ = stored_;
  if (talks && !write_now(map.command, map.command_stop, until) && map.command.present) {
    note_fault(status_, "the device did not confirm the stop; stop it at its own screen");
  }
  link_->close();
  stage_ = Stage::down;
  purpose_ = Purpose::none;
}

}  // namespace bladefit

#include "drivers/modbus/modbus_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "drivers/modbus/cmm_requests.hpp"
#include "drivers/modbus/device_habits.hpp"
#include "drivers/source/host_clock.hpp"
#include "drivers/source/source_fault.hpp"

namespace bladefit {
namespace {

constexpr int kOpenTransactions = 10;  ///< that many reply timeouts are granted to open()
constexpr std::chrono::milliseconds kCloseTime{700};

}  // namespace

ModbusSource::ModbusSource(const ModbusSettings& settings, std::string name)
    : settings_(settings),
      name_(std::move(name)),
      ring_(settings_, status_),
      link_(make_modbus_link(settings)),
      health_(settings.reconnect_first, settings.reconnect_longest),
      schedule_(settings.poll_period),
      registers_(MODBUS_MAX_READ_REGISTERS) {}

/// A setting that does not fit counts as a fault of the device, too: one of the two is to be changed, and only who
/// stands beside the machine knows which.
Failure ModbusSource::open_error(const std::string& what) {
  link_->close();
  stage_ = Stage::down;
  opening_ = false;
  return device_failure(fmt::format("{}: {}", name_, what));
}

Failure ModbusSource::open(std::uint32_t after, std::uint32_t run_id) {
  status_ = {};
  ring_.restart(after);
  acknowledgement_.restart(after, 0);
  headers_.restart(run_id);
  health_.restart();
  refusal_.clear();
  if (const Failure failure = check_map(settings_.map)) return open_error(failure.message);
  if (const Failure failure = link_->prepare()) return open_error(failure.message);
  for (const std::string& remark : give_up_unsafe_writes(settings_.map)) note_remark(status_, remark);
  opening_ = true;
  transaction_ = {};
  stage_ = Stage::connecting;
  link_->start_connect();
  const Clock::time_point deadline =
      Clock::now() + settings_.connect_timeout + kOpenTransactions * settings_.reply_timeout;
  while (stage_ != Stage::running || !headers_.enough_to_open()) {
    step(Clock::now() + settings_.reply_timeout);
    if (headers_.surely_foreign()) break;
    if (ring_.stopped()) return open_error(status_.stopped);
    const bool never_connected = stage_ == Stage::down && !health_.ever_made();
    if (never_connected || Clock::now() > deadline) return open_error(status_.last_fault);
    if (!refusal_.empty()) return open_error(refusal_);
    if (health_.seems_lost()) return open_error(silence_text(settings_.unit, link_->other_unit()));
  }
  opening_ = false;
  return {};
}

/// Goes on with whatever is under way. Returns as soon as something has changed, at `until` at the latest.
void ModbusSource::step(Clock::time_point until) {
  if (ring_.stopped()) {
    std::this_thread::sleep_until(until);
  } else if (!link_->is_open()) {
    reconnect(until);
  } else if (transaction_.purpose != Purpose::none) {
    finish_transaction(until);
  } else {
    begin_transaction(until);
  }
}

void ModbusSource::reconnect(Clock::time_point until) {
  if (stage_ != Stage::connecting) {
    if (Clock::now() < health_.retry_at()) {
      std::this_thread::sleep_until(std::min(until, health_.retry_at()));
      return;
    }
    stage_ = Stage::connecting;
    link_->start_connect();
  }
  const LinkEvent event = link_->connect(until);
  if (event == LinkEvent::broken) link_lost(link_->fault());
  if (event != LinkEvent::done) return;
  if (health_.make()) ++status_.reconnects;
  if (!link_->remark().empty()) status_.last_fault = link_->remark();
  stage_ = Stage::identify;
  headers_.link_made();
  schedule_.restart(link_->ready_at());
}

void ModbusSource::begin_transaction(Clock::time_point until) {
  const Clock::time_point now = Clock::now();
  if (now < link_->ready_at()) return std::this_thread::sleep_until(std::min(until, link_->ready_at()));
  if (schedule_.may_write(now) && begin_write()) return;
  begin_read(now, until);
}

/// The acknowledge, or the command after it. Returns false where there is nothing to be written.
bool ModbusSource::begin_write() {
  if (headers_.foreign() || ring_.stopped()) return false;
  const CmmMap& map = settings_.map;
  if (may_acknowledge()) {
    const std::uint32_t sequence = acknowledgement_.send();
    if (map.acknowledge.present) {
      begin(Purpose::acknowledge, write_request(map, map.acknowledge, sequence));
      return true;
    }
    acknowledgement_.confirm();
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

/// A device that numbers again must not be told that records which it has yet to measure are stored.
bool ModbusSource::may_acknowledge() const {
  if (ring_.knows(acknowledgement_.stored()))
    return stage_ == Stage::announce || (stage_ == Stage::running && acknowledgement_.is_due());
  return stage_ == Stage::announce && ring_.holds_none();
}

/// The header when it is due, records otherwise. On a slow line the header is always due: records come after it.
void ModbusSource::begin_read(Clock::time_point now, Clock::time_point until) {
  const CmmMap& map = settings_.map;
  // While open() waits for the start, the ring may hold an earlier run. Later a refused write keeps no record back.
  const bool wanted = stage_ == Stage::running || (!opening_ && stage_ != Stage::identify);
  const RecordBatch batch = wanted && schedule_.may_read(now) ? ring_.next_batch() : RecordBatch{};
  if (schedule_.take_header_turn(now, batch.count > 0)) {
    const RegisterBlock block = header_block(map);
    begin(Purpose::header, read_request(map, block.first, block.count));
  } else if (batch.count > 0) {
    transaction_.batch = batch;
    const auto registers = static_cast<std::uint16_t>(batch.count * map.record_size);
    begin(Purpose::records, read_request(map, batch.address, registers));
  } else {
    return std::this_thread::sleep_until(std::min(until, schedule_.next_turn()));
  }
  schedule_.reading();
}

void ModbusSource::begin(Purpose purpose, const ModbusRequest& request) {
  transaction_.purpose = purpose;
  if (link_->send(request) == LinkEvent::broken) link_lost(link_->fault());
}

void ModbusSource::finish_transaction(Clock::time_point until) {
  const LinkEvent event = link_->receive(registers_, until);
  if (event == LinkEvent::done) return transaction_done();
  if (event != LinkEvent::pending) transaction_failed(event);
}

void ModbusSource::transaction_done() {
  health_.reply_came();
  const Purpose purpose = std::exchange(transaction_.purpose, Purpose::none);
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
      acknowledgement_.confirm();
      if (stage_ == Stage::announce) stage_ = Stage::command;
      break;
    case Purpose::command:
      if (stage_ == Stage::command) stage_ = Stage::running;
      if (next_command_ == settings_.map.command_restart) ring_.goes_on_behind(acknowledgement_.known());
      schedule_.delay_header(Clock::now());
      break;
  }
}

void ModbusSource::header_read() {
  schedule_.delay_header(Clock::now());
  const CmmHeader header = decode_header(registers_, settings_.map);
  const Failure failure = check_header(header, settings_.map);
  if (!failure) return header_accepted(header);
  ++status_.damaged;
  note_fault(status_, failure.message);
  if (headers_.refuse() && opening_) refusal_ = failure.message;
}

void ModbusSource::header_accepted(const CmmHeader& header) {
  note_good(status_);
  if (header.status_unknown)
    note_remark(status_, "the device file gives no meaning to the status of the device; add it to status_values");
  const bool records_taken = ring_.next() > 1;
  // Those read while the device refuses the start cannot show its run.
  headers_.accept(header.run_id, records_taken, stage_ == Stage::identify || stage_ == Stage::running);
  ring_.observe(header);
  if (stage_ != Stage::running && !headers_.foreign() && !ring_.stopped()) identify(header);
  if (!records_taken) headers_.adopt(status_.run_id);
}

/// A good header before the device has taken its command: each decides again which one that is.
void ModbusSource::identify(const CmmHeader& header) {
  next_command_ = command_for(settings_.map, header, ring_.next(), opening_);
  status_.link = LinkState::up;
  if (stage_ == Stage::identify) stage_ = Stage::announce;
  health_.recognise();
}

void ModbusSource::records_read() {
  const std::size_t size = std::size_t{transaction_.batch.count} * settings_.map.record_size;
  const bool good = ring_.accept(transaction_.batch, std::span(registers_).first(size), host_time_us());
  // A bad record is read again once the header has shown whether it still stands in the ring.
  if (!good) schedule_.hasten_header(Clock::now());
}

void ModbusSource::transaction_failed(LinkEvent event) {
  if (event == LinkEvent::broken) return link_lost(link_->fault());
  const Purpose purpose = std::exchange(transaction_.purpose, Purpose::none);
  const bool lacking = event == LinkEvent::unknown || event == LinkEvent::absent;
  if (lacking && adapt(purpose, event)) return;
  if (lacking) event = LinkEvent::refused;
  note_fault(status_, link_->fault());
  if (event == LinkEvent::damaged) ++status_.damaged;
  if (event == LinkEvent::refused || event == LinkEvent::busy) return request_refused(purpose, event);
  if (event != LinkEvent::timeout) return;
  health_.reply_missing();
  ++status_.resends;
  if (health_.seems_lost()) status_.link = LinkState::lost;
  // A serial port stays open for a silent device. A TCP connection may be dead without a sign.
  if (settings_.transport == ModbusTransport::tcp && health_.timeouts() >= settings_.timeouts_to_reconnect) {
    link_->close();
    link_lost(link_->fault());
  }
}

/// The device lacks the function or register of a request. False where there is no other way to what it was for.
bool ModbusSource::adapt(Purpose purpose, LinkEvent event) {
  CmmMap& map = settings_.map;
  // A register that was there when the session began is waited for.
  if (event == LinkEvent::absent && !(writes(purpose) && opening_)) return false;
  NumberField& written = purpose == Purpose::command ? map.command : map.acknowledge;
  const std::vector<std::string> remarks =
      writes(purpose) ? give_up_writing(written, link_->fault()) : read_holding_instead(map);
  if (!map.command.present) next_command_ = 0;
  for (const std::string& remark : remarks) note_remark(status_, remark);
  return !remarks.empty();
}

/// What was refused is asked again, a poll period later.
void ModbusSource::request_refused(Purpose purpose, LinkEvent event) {
  writes(purpose) ? schedule_.write_refused(Clock::now()) : schedule_.read_refused(Clock::now());
  if (opening_ && event == LinkEvent::refused)
    refusal_ = link_->fault() + "; correct the addresses, or lower batch, in the device file";
}

void ModbusSource::link_lost(const std::string& fault) {
  transaction_.purpose = Purpose::none;
  stage_ = Stage::down;
  status_.link = LinkState::lost;
  note_fault(status_, fault);
  health_.fail(Clock::now());
}

/// Writes once and waits for the reply until `until`.
bool ModbusSource::write_now(const NumberField& field, std::uint32_t value, Clock::time_point until) {
  if (!field.present || !link_->is_open()) return false;
  return link_->exchange(write_request(settings_.map, field, value), registers_, until);
}

void ModbusSource::close() {
  const Clock::time_point until = Clock::now() + kCloseTime;
  if (link_->is_open() && transaction_.purpose != Purpose::none) finish_transaction(until);
  const CmmMap& map = settings_.map;
  const bool talks = link_->is_open() && status_.link == LinkState::up && !headers_.foreign();
  const bool due = acknowledgement_.is_due() && ring_.knows(acknowledgement_.stored());
  if (talks && due && write_now(map.acknowledge, acknowledgement_.send(), until)) acknowledgement_.confirm();
  if (talks && !write_now(map.command, map.command_stop, until) && map.command.present)
    note_fault(status_, "the device did not confirm the stop; stop it at its own screen");
  link_->close();
  stage_ = Stage::down;
  transaction_.purpose = Purpose::none;
}

}  // namespace bladefit

#include "drivers/serial/serial_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "drivers/serial/protocol_v1.hpp"
#include "drivers/source_fault.hpp"

namespace bladefit {

namespace protocol = serial_protocol_v1;

namespace {

constexpr int kStartsToLost = 3;       ///< unanswered $START in a row after which the link counts as lost
constexpr int kSilencesToRestart = 5;  ///< intervals of silence after which $START asks whether the device still lives

}  // namespace

void SerialSession::restart(std::uint32_t after) {
  stage_ = Stage::down;
  points_.clear();
  output_.clear();
  next_ = after + 1;
  stored_ = acknowledged_ = after;
  run_known_ = finished_ = false;
  asked_for_ = 0;
  asked_ = 0;
}

void SerialSession::link_made(Clock::time_point now) {
  output_.clear();
  starts_ = 0;
  start(now);
}

void SerialSession::start(Clock::time_point now) {
  stage_ = Stage::starting;
  started_at_ = now;
  ++starts_;
  output_ += encode_line(protocol::kStartTag, stored_ + 1);
}

void SerialSession::received(const SerialMessage& message, Clock::time_point now, std::int64_t time_us) {
  if (stage_ == Stage::down || stage_ == Stage::stopped) return;
  if (message.kind == SerialMessage::Kind::damaged) return damaged(message.damage, now);
  if (message.kind == SerialMessage::Kind::host) {
    return damaged("the host's own line came back; set echo = true or check the RS-485 wiring", now);
  }
  heard_at_ = now;
  silences_ = 0;
  note_good(status_);
  if (message.kind == SerialMessage::Kind::run) return run_told(message.number, now);
  // What comes ahead of $RUN may be of another run; $START makes the device send it again.
  if (stage_ != Stage::running) return;
  if (message.kind == SerialMessage::Kind::finished) return end_told(message.number, now);
  point_came(message.point, now, time_us);
}

void SerialSession::run_told(std::uint32_t run_id, Clock::time_point now) {
  if (run_known_ && next_ > 1 && run_id != status_.run_id) {
    stage_ = Stage::stopped;
    finished_ = false;
    note_fault(status_,
               fmt::format("the device has begun another run ({} instead of {}) and numbers its records from 1 "
                           "again; end this session and start a new one",
                           run_id, status_.run_id));
    status_.run_id = run_id;
    return;
  }
  run_known_ = true;
  status_.run_id = run_id;
  status_.link = LinkState::up;
  stage_ = Stage::running;
  starts_ = 0;
  heard_at_ = now;
}

void SerialSession::point_came(const ProbePoint& point, Clock::time_point now, std::int64_t time_us) {
  ++status_.records;
  if (point.sequence < next_) {
    ++status_.duplicates;
    return;
  }
  if (point.sequence > next_ && !give_up_before(point.sequence, now)) return ask_again(now);
  ProbePoint stamped = point;
  stamped.time_us = time_us;
  points_.push(stamped);
  next_ = point.sequence + 1;
  finished_ = false;
}

void SerialSession::end_told(std::uint32_t last, Clock::time_point now) {
  if (last >= next_) {
    if (!give_up_before(last + 1, now)) return ask_again(now);
    next_ = last + 1;
  }
  finished_ = last + 1 == next_;
}

/// Whether the records from next_ to before `sequence` count as lost, because the device was asked for them often
/// enough.
bool SerialSession::give_up_before(std::uint32_t sequence, Clock::time_point now) {
  const bool asked_enough = asked_for_ == next_ && asked_ >= settings_.resend_tries;
  if (!asked_enough || now < asked_at_ + settings_.resend_interval) return false;
  status_.gap = true;
  note_fault(status_,
             fmt::format("records {}..{} are lost: the device did not send them in {} tries; probe these points "
                         "again",
                         next_, sequence - 1, asked_));
  return true;
}

void SerialSession::ask_again(Clock::time_point now) {
  const bool same = asked_for_ == next_;
  if (same && now < asked_at_ + settings_.resend_interval) return;
  asked_ = same ? asked_ + 1 : 1;
  asked_for_ = next_;
  asked_at_ = now;
  ++status_.resends;
  output_ += encode_line(protocol::kMissingTag, next_);
}

void SerialSession::damaged(const std::string& what, Clock::time_point now) {
  ++status_.damaged;
  note_fault(status_, what);
  if (stage_ == Stage::running && !finished_) ask_again(now);
}

void SerialSession::tick(Clock::time_point now) {
  if (now < next_tick()) return;
  if (stage_ == Stage::starting) {
    if (starts_ >= kStartsToLost) status_.link = LinkState::lost;
    note_fault(status_, fmt::format("the device has not answered {} starts", starts_));
    start(now);
  } else if (stage_ == Stage::running) {
    break_silence(now);
  }
}

/// Something may have been lost without a trace: the last record, the end, an acknowledge the device waits for. A
/// device that merely has nothing to say stays as it is.
void SerialSession::break_silence(Clock::time_point now) {
  heard_at_ = now;
  ++silences_;
  if (stored_ > 0) output_ += encode_line(protocol::kAcknowledgeTag, stored_);
  if (finished_) return;
  if (silences_ % kSilencesToRestart == 0) {
    starts_ = 0;
    start(now);
  } else {
    output_ += encode_line(protocol::kMissingTag, next_);
  }
}

SerialSession::Clock::time_point SerialSession::next_tick() const {
  switch (stage_) {
    case Stage::starting:
      return started_at_ + settings_.start_interval;
    case Stage::running:
      return heard_at_ + settings_.silence;
    case Stage::down:
    case Stage::stopped:
      break;
  }
  return Clock::time_point::max();
}

void SerialSession::acknowledge(std::uint32_t sequence) { stored_ = std::max(stored_, sequence); }

std::string SerialSession::take_output() {
  if (stage_ == Stage::running && stored_ > acknowledged_) {
    output_ += encode_line(protocol::kAcknowledgeTag, stored_);
    acknowledged_ = stored_;
  }
  return std::exchange(output_, {});
}

}  // namespace bladefit

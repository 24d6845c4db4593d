#include "drivers/serial/serial_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "drivers/serial/protocol_v1.hpp"
#include "drivers/source/source_fault.hpp"

namespace bladefit {

namespace protocol = serial_protocol_v1;

namespace {

constexpr std::size_t kMostAhead = 4096;  ///< records kept behind a missing one
constexpr int kStartsToLost = 3;          ///< unanswered $START in a row after which the link counts as lost
constexpr int kSilencesToRestart = 5;  ///< intervals of silence after which $START asks whether the device still lives

}  // namespace

void SerialSession::restart(std::uint32_t after, std::uint32_t run_id) {
  stage_ = Stage::down;
  points_.clear();
  output_.clear();
  ahead_.clear();
  next_ = after + 1;
  stored_ = acknowledged_ = after;
  doubtful_ = false;
  end_.reset();
  run_id_ = run_id;
  asked_for_ = 0;
  asked_ = 0;
}

void SerialSession::link_made(Clock::time_point now) {
  output_.clear();
  starts_ = 0;
  doubtful_ = false;
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
  status_.run_id = run_id;
  if (next_ > 1 && run_id != run_id_) {
    stage_ = Stage::stopped;
    end_.reset();
    note_fault(status_,
               fmt::format("the device has begun another run ({} instead of {}) and numbers its records from 1 "
                           "again; end this session and start a new one",
                           run_id, run_id_));
    return;
  }
  run_id_ = run_id;
  status_.link = LinkState::up;
  stage_ = Stage::running;
  starts_ = 0;
  heard_at_ = now;
}

void SerialSession::point_came(const ProbePoint& point, Clock::time_point now, std::int64_t time_us) {
  ++status_.records;
  ProbePoint stamped = point;
  stamped.time_us = time_us;
  if (point.sequence > next_) {
    if (ahead_.size() < kMostAhead && !ahead_.emplace(point.sequence, stamped).second) ++status_.duplicates;
    return ask_again(now);
  }
  if (point.sequence < next_) {
    ++status_.duplicates;
    return;
  }
  deliver(stamped);
}

/// Hands out a record and those kept behind it. A record beyond the end told before means that probing goes on.
void SerialSession::deliver(const ProbePoint& point) {
  doubtful_ = false;
  points_.push(point);
  next_ = point.sequence + 1;
  while (!ahead_.empty() && ahead_.begin()->first <= next_) {
    if (ahead_.begin()->first == next_) {
      points_.push(ahead_.begin()->second);
      ++next_;
    }
    ahead_.erase(ahead_.begin());
  }
  if (end_ && next_ > *end_ + 1) end_.reset();
}

void SerialSession::end_told(std::uint32_t last, Clock::time_point now) {
  if (last + 1 < next_) return;
  end_ = last;
  if (complete()) {
    doubtful_ = false;
  } else {
    ask_again(now);
  }
}

/// The device was asked for the record next_ often enough.
bool SerialSession::asked_in_vain(Clock::time_point now) const {
  return asked_for_ == next_ && asked_ >= settings_.resend_tries && now >= asked_at_ + settings_.resend_interval;
}

void SerialSession::give_up_before(std::uint32_t sequence) {
  note_loss(status_,
            lost_points(next_, sequence - 1, fmt::format("not sent by the device though asked for {} times", asked_)));
  next_ = sequence;
}

/// When the first missing record may be asked for.
SerialSession::Clock::time_point SerialSession::ask_at() const {
  return asked_at_ + (asked_for_ == next_ ? settings_.resend_interval : settings_.resend_pause);
}

/// Asks for the first missing record, unless it is too early, or gives it up.
void SerialSession::ask_again(Clock::time_point now) {
  if (now < ask_at()) return;
  if (behind() && asked_in_vain(now)) {
    if (ahead_.empty()) return give_up_before(*end_ + 1);
    give_up_before(ahead_.begin()->first);
    return deliver(ProbePoint(ahead_.begin()->second));
  }
  asked_ = asked_for_ == next_ ? asked_ + 1 : 1;
  asked_for_ = next_;
  asked_at_ = now;
  doubtful_ = false;
  ++status_.resends;
  output_ += encode_line(protocol::kMissingTag, next_);
}

/// The line may have been a resent one that is not needed, so it is seen first whether the next record follows.
void SerialSession::damaged(const std::string& what, Clock::time_point now) {
  ++status_.damaged;
  note_fault(status_, what);
  if (stage_ != Stage::running || complete()) return;
  doubtful_ = true;
  doubted_at_ = now;
}

void SerialSession::tick(Clock::time_point now) {
  if (now < next_tick() || stage_ == Stage::down || stage_ == Stage::stopped) return;
  if (stage_ == Stage::starting) {
    if (starts_ >= kStartsToLost) status_.link = LinkState::lost;
    note_fault(status_, fmt::format("the device has not answered {} starts", starts_));
    start(now);
    return;
  }
  if (now >= heard_at_ + settings_.silence) return break_silence(now);
  ask_again(now);
}

/// Something may have been lost without a trace: the last record, the end, an acknowledge the device waits for. A
/// device that merely has nothing to say stays as it is.
void SerialSession::break_silence(Clock::time_point now) {
  heard_at_ = now;
  ++silences_;
  if (stored_ > 0) output_ += encode_line(protocol::kAcknowledgeTag, stored_);
  if (complete()) return;
  if (silences_ % kSilencesToRestart == 0) {
    starts_ = 0;
    start(now);
  } else {
    output_ += encode_line(protocol::kMissingTag, next_);
  }
}

SerialSession::Clock::time_point SerialSession::next_tick() const {
  if (stage_ == Stage::starting) return started_at_ + settings_.start_interval;
  if (stage_ != Stage::running) return Clock::time_point::max();
  const Clock::time_point silent_at = heard_at_ + settings_.silence;
  if (behind()) return std::min(silent_at, ask_at());
  if (doubtful_) return std::min(silent_at, std::max(ask_at(), doubted_at_ + settings_.resend_pause));
  return silent_at;
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

#include "drivers/serial/serial_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "drivers/serial/protocol_v1.hpp"
#include "drivers/source/source_fault.hpp"

namespace bladefit {

namespace protocol = serial_protocol_v1;

namespace {

constexpr int kStartsToLost = 3;       ///< unanswered $START in a row after which the link counts as lost
constexpr int kOlderEndsToStop = 2;    ///< ends in a row that lie before a record which was taken
constexpr int kSilencesToRestart = 5;  ///< intervals of silence after which $START asks whether the device still lives

}  // namespace

void SerialSession::restart(std::uint32_t after, std::uint32_t run_id) {
  stage_ = Stage::down;
  records_.restart(after);
  resend_.restart();
  acknowledgement_.restart(after, after);
  output_.clear();
  run_id_ = run_id;
  older_ends_ = 0;
}

void SerialSession::link_made(Clock::time_point now) {
  output_.clear();
  starts_ = 0;
  resend_.dispel_doubt();
  start(now);
}

bool SerialSession::numbers_are_used_up() const { return records_.next() > std::numeric_limits<std::uint32_t>::max(); }

/// The numbering has restarted, or must.
void SerialSession::stop(const std::string& why) {
  stage_ = Stage::stopped;
  records_.forget_end();
  note_fault(status_, why);
}

void SerialSession::start(Clock::time_point now) {
  if (acknowledgement_.stored() == std::numeric_limits<std::uint32_t>::max()) {
    status_.stopped =
        "the session holds record 4294967295, and there is no number beyond that; start a session in "
        "another folder for further records";
    return stop(status_.stopped);
  }
  stage_ = Stage::starting;
  started_at_ = now;
  ++starts_;
  output_ += encode_line(protocol::kStartTag, acknowledgement_.stored() + 1);
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
  if (message.kind == SerialMessage::Kind::run) return run_named(message.number, now);
  // What comes ahead of $RUN may be of another run; $START makes the device send it again.
  if (stage_ != Stage::running) return;
  if (message.kind == SerialMessage::Kind::finished) return end_named(message.number, now);
  point_came(message.point, now, time_us);
}

void SerialSession::run_named(std::uint32_t run_id, Clock::time_point now) {
  status_.run_id = run_id;
  if (records_.next() > 1 && run_id != run_id_) {
    return stop(
        fmt::format("the device has begun another run ({} instead of {}) and numbers its records from 1 again; end "
                    "this session and start a new one",
                    run_id, run_id_));
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
  const RecordOrder::Place place = records_.take(stamped);
  if (place == RecordOrder::Place::old || place == RecordOrder::Place::ahead_again) ++status_.duplicates;
  if (place == RecordOrder::Place::delivered) {
    older_ends_ = 0;
    return resend_.dispel_doubt();
  }
  if (place != RecordOrder::Place::old) ask_again(now);
}

void SerialSession::end_named(std::uint32_t last, Clock::time_point now) {
  if (!records_.end_at(last)) return older_end_named(last);
  older_ends_ = 0;
  if (records_.complete()) {
    resend_.dispel_doubt();
  } else {
    ask_again(now);
  }
}

/// The program of a device that numbers its records again ends before those of the blade before. Once may be an older
/// line.
void SerialSession::older_end_named(std::uint32_t last) {
  if (++older_ends_ < kOlderEndsToStop) return;
  status_.stopped = fmt::format(
      "the device's program ends with record {} although record {} was read before: it has begun to number its records "
      "again, and its run id has not changed; start a session in another folder for the new records",
      last, records_.next() - 1);
  stop(status_.stopped);
}

void SerialSession::give_up_missing() {
  const RecordOrder::Gap gap = records_.skip_missing();
  if (gap.delivered) resend_.dispel_doubt();
  note_loss(status_, lost_points(gap.first, gap.last,
                                 fmt::format("not sent by the device though asked for {} times", resend_.times())));
}

/// Asks for the first missing record, unless it is too early, or gives it up.
void SerialSession::ask_again(Clock::time_point now) {
  if (numbers_are_used_up()) return resend_.dispel_doubt();
  const auto missing = static_cast<std::uint32_t>(records_.next());
  if (now < resend_.due(missing)) return;
  if (behind() && resend_.in_vain(missing, now)) return give_up_missing();
  resend_.ask(missing, now);
  ++status_.resends;
  output_ += encode_line(protocol::kMissingTag, missing);
}

void SerialSession::damaged(const std::string& what, Clock::time_point now) {
  ++status_.damaged;
  note_fault(status_, what);
  if (stage_ == Stage::running && !records_.complete()) resend_.doubt(now);
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
  if (acknowledgement_.stored() > 0) output_ += encode_line(protocol::kAcknowledgeTag, acknowledgement_.stored());
  if (records_.complete() || numbers_are_used_up()) return;
  if (silences_ % kSilencesToRestart == 0) {
    starts_ = 0;
    start(now);
  } else {
    output_ += encode_line(protocol::kMissingTag, static_cast<std::uint32_t>(records_.next()));
  }
}

SerialSession::Clock::time_point SerialSession::next_tick() const {
  if (stage_ == Stage::starting) return started_at_ + settings_.start_interval;
  if (stage_ != Stage::running) return Clock::time_point::max();
  const Clock::time_point silent_at = heard_at_ + settings_.silence;
  const auto missing = static_cast<std::uint32_t>(records_.next());
  if (behind()) return std::min(silent_at, resend_.due(missing));
  if (resend_.doubtful()) return std::min(silent_at, resend_.due_after_doubt(missing));
  return silent_at;
}

void SerialSession::acknowledge(std::uint32_t sequence) { acknowledgement_.store(sequence); }

std::string SerialSession::take_output() {
  if (stage_ == Stage::running && acknowledgement_.is_due()) {
    output_ += encode_line(protocol::kAcknowledgeTag, acknowledgement_.send());
    acknowledgement_.confirm();
  }
  return std::exchange(output_, {});
}

}  // namespace bladefit

#pragma once
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "drivers/serial/serial_message.hpp"
#include "drivers/serial/serial_settings.hpp"
#include "drivers/source/point_queue.hpp"
#include "drivers/source/probe_source.hpp"

namespace bladefit {

/// The host's side of serial protocol v1. No I/O and no clock of its own: lines and times go in, points and lines to
/// send come out.
///
///   down --link_made--> starting --$RUN--> running --another $RUN id--> stopped
///                       ^ $START again every start_interval
///                       ^------------- long silence --------------'
///
/// While running, a jump in the sequence or a damaged line is answered by $NAK of the first missing record, for the
/// same record at most once per resend_interval; records behind the jump are dropped, because the device sends them
/// again. $START names the first record that is not stored, never one beyond: the device may forget what is before it.
class SerialSession {
 public:
  using Clock = std::chrono::steady_clock;

  SerialSession(const SerialSettings& settings, SourceStatus& status) : settings_(settings), status_(status) {}

  /// Forgets everything; the next record wanted is after + 1. Those before it are of the run `run_id`.
  void restart(std::uint32_t after, std::uint32_t run_id);

  /// The port is open.
  void link_made(Clock::time_point now);

  /// The port is lost.
  void link_lost() { stage_ = Stage::down; }

  /// A line came that `message` was made of.
  void received(const SerialMessage& message, Clock::time_point now, std::int64_t time_us);

  /// Something came that is no line.
  void damaged(const std::string& what, Clock::time_point now);

  /// Does what the time asks for.
  void tick(Clock::time_point now);

  /// When tick() has something to do next.
  [[nodiscard]] Clock::time_point next_tick() const;

  /// Every record up to `sequence` is stored.
  void acknowledge(std::uint32_t sequence);

  /// Takes the lines to send.
  [[nodiscard]] std::string take_output();

  [[nodiscard]] PointQueue& points() { return points_; }

  /// The device has answered $START.
  [[nodiscard]] bool running() const { return stage_ == Stage::running; }

  /// The numbering has restarted: nothing more is delivered.
  [[nodiscard]] bool stopped() const { return stage_ == Stage::stopped; }

  /// Records are missing ahead of others that came, or ahead of the end that the device told.
  [[nodiscard]] bool behind() const { return !ahead_.empty() || (end_ && *end_ >= next_); }

  /// The device said that the program is finished, and every record was handed out.
  [[nodiscard]] bool finished() const { return complete() && points_.empty(); }

 private:
  enum class Stage : std::uint8_t { down, starting, running, stopped };

  [[nodiscard]] bool complete() const { return end_ && *end_ + 1 == next_; }
  void start(Clock::time_point now);
  void run_told(std::uint32_t run_id, Clock::time_point now);
  void point_came(const ProbePoint& point, Clock::time_point now, std::int64_t time_us);
  void end_told(std::uint32_t last, Clock::time_point now);
  void deliver(const ProbePoint& point);
  void ask_again(Clock::time_point now);
  [[nodiscard]] bool asked_in_vain(Clock::time_point now) const;
  void give_up_before(std::uint32_t sequence);
  [[nodiscard]] Clock::time_point ask_at() const;
  void break_silence(Clock::time_point now);

  const SerialSettings& settings_;
  SourceStatus& status_;
  Stage stage_ = Stage::down;
  PointQueue points_;
  std::string output_;
  std::map<std::uint32_t, ProbePoint> ahead_;  ///< records behind a missing one
  std::uint32_t next_ = 1;
  std::optional<std::uint32_t> end_;  ///< last sequence of the program, as $END told it
  std::uint32_t run_id_ = 0;          ///< of the records that were taken; what $RUN told where none were
  std::uint32_t stored_ = 0, acknowledged_ = 0;
  bool doubtful_ = false;           ///< a damaged line came since the last good record
  int starts_ = 0;                  ///< $START sent in a row without an answer
  int silences_ = 0;                ///< intervals of silence in a row
  std::uint32_t asked_for_ = 0;     ///< record of the last $NAK; 0 = none
  int asked_ = 0;                   ///< how often it was asked for
  Clock::time_point asked_at_{};    ///< time of the last $NAK
  Clock::time_point doubted_at_{};  ///< time of the damaged line
  Clock::time_point started_at_{};  ///< time of the last $START
  Clock::time_point heard_at_{};    ///< time of the last line, or of the last try to break the silence
};

}  // namespace bladefit

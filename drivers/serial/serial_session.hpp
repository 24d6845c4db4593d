#pragma once
#include <chrono>
#include <cstdint>
#include <string>

#include "drivers/serial/record_order.hpp"
#include "drivers/serial/resend_request.hpp"
#include "drivers/serial/serial_message.hpp"
#include "drivers/serial/serial_settings.hpp"
#include "drivers/source/acknowledgement.hpp"
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
/// same record at most once per resend_interval; records behind the jump are kept, although the device sends them
/// again. $START names the first record that is not stored, never one beyond: the device may forget what is before it.
class SerialSession {
 public:
  using Clock = std::chrono::steady_clock;

  SerialSession(const SerialSettings& settings, SourceStatus& status)
      : settings_(settings), status_(status), resend_(settings) {}

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

  [[nodiscard]] PointQueue& points() { return records_.points(); }

  /// The device has answered $START.
  [[nodiscard]] bool running() const { return stage_ == Stage::running; }

  /// The numbering has restarted: nothing more is delivered.
  [[nodiscard]] bool stopped() const { return stage_ == Stage::stopped; }

  /// Records are missing ahead of others that came, or ahead of the end that the device gave.
  [[nodiscard]] bool behind() const { return records_.behind(); }

  /// Sequence of the newest record that was delivered or given up.
  [[nodiscard]] std::uint32_t last() const { return static_cast<std::uint32_t>(records_.next() - 1); }

  /// The device said that the program is finished, and every record was handed out.
  [[nodiscard]] bool finished() const { return records_.complete() && records_.points().empty(); }

 private:
  enum class Stage : std::uint8_t { down, starting, running, stopped };

  [[nodiscard]] bool numbers_are_used_up() const;
  void stop(const std::string& why);
  void start(Clock::time_point now);
  void run_named(std::uint32_t run_id, Clock::time_point now);
  void point_came(const ProbePoint& point, Clock::time_point now, std::int64_t time_us);
  void end_named(std::uint32_t last, Clock::time_point now);
  void ask_again(Clock::time_point now);
  void older_end_named(std::uint32_t last);
  void give_up_missing();
  void break_silence(Clock::time_point now);

  const SerialSettings& settings_;
  SourceStatus& status_;
  Stage stage_ = Stage::down;
  RecordOrder records_;
  ResendRequest resend_;
  Acknowledgement acknowledgement_;
  std::string output_;
  std::uint32_t run_id_ = 0;        ///< of the records that were taken; what $RUN named where none were
  int older_ends_ = 0;              ///< in a row
  int starts_ = 0;                  ///< $START sent in a row without an answer
  Clock::time_point started_at_{};  ///< time of the last $START
  int silences_ = 0;                ///< intervals of silence in a row
  Clock::time_point heard_at_{};    ///< time of the last line, or of the last try to break the silence
};

}  // namespace bladefit

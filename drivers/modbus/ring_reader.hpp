#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/modbus/cmm_header.hpp"
#include "drivers/modbus/modbus_settings.hpp"
#include "drivers/source/point_queue.hpp"
#include "drivers/source/probe_source.hpp"

namespace bladefit {

/// Records to read at once: neighbours in the ring.
struct RecordBatch {
  std::uint32_t sequence = 0;  ///< of the first
  std::uint16_t count = 0;     ///< 0 = nothing to read
  std::uint16_t address = 0;   ///< register of the first
};

/// Which records of the device's ring come next, and what becomes of those that were read. No I/O and no clock: it sees
/// headers and records in the order of their arrival.
/// What cannot be taken back (records lost, another run, program finished) is believed only when headers in a row say
/// so, because a header has no check sum and may be an older reply that came late.
class RingReader {
 public:
  RingReader(const ModbusSettings& settings, SourceStatus& status);

  /// Forgets everything; the next record wanted is after + 1.
  void restart(std::uint32_t after);

  /// Takes note of a header that check_header() has accepted.
  void observe(const CmmHeader& header);

  /// The records that are there to be read now.
  [[nodiscard]] RecordBatch next_batch() const;

  /// Takes the registers of a batch. Returns true when every record was good; the others are wanted again, and were
  /// noted as faults.
  bool accept(const RecordBatch& batch, std::span<const std::uint16_t> registers, std::int64_t time_us);

  [[nodiscard]] PointQueue& points() { return points_; }

  /// Sequence of the next record wanted.
  [[nodiscard]] std::uint32_t next() const { return next_; }

  /// The numbering has restarted: nothing more is delivered.
  [[nodiscard]] bool stopped() const { return stopped_; }

 private:
  [[nodiscard]] bool adopt_identity(const CmmHeader& header);
  void note_losses(const CmmHeader& header);
  void note_overflow(bool reported);
  void note_finish(const CmmHeader& header);
  void take_back_overshoot(const CmmHeader& header);
  void damaged(const std::string& fault);
  void skip_to(std::uint32_t sequence, const std::string& why);

  const ModbusSettings& settings_;
  SourceStatus& status_;
  PointQueue points_;
  std::optional<CmmHeader> current_;   ///< the header whose identity is believed, newest included
  std::optional<CmmHeader> previous_;  ///< the header before this one
  std::uint32_t next_ = 1;
  std::uint32_t taken_ = 0;  ///< last record that was good
  int tries_ = 0;            ///< how often the record next_ was found damaged
  int losses_seen_ = 0, overflow_changes_seen_ = 0, finishes_seen_ = 0, overshoots_seen_ = 0;
  bool overflow_ = false;  ///< the overflow bit is set, as headers in a row say
  bool stopped_ = false;
};

}  // namespace bladefit

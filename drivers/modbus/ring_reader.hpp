#pragma once
#include <algorithm>
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

  /// Sequence of the next record wanted; 2^32 where every number is used up.
  [[nodiscard]] std::uint64_t next() const { return next_; }

  /// The numbering has restarted: nothing more is delivered.
  [[nodiscard]] bool stopped() const { return stopped_; }

  /// The device was told to go on behind this record: it may show older ones again.
  void goes_on_behind(std::uint32_t sequence) { floor_ = std::min(floor_, sequence); }

  /// Whether the device, as its last header has it, holds or held the record: it must not be told that others are
  /// stored. One that was switched on again and has no record yet is to be told where to go on.
  [[nodiscard]] bool knows(std::uint32_t sequence) const { return seen_.going_back == 0 && newest_ >= sequence; }
  [[nodiscard]] bool holds_none() const { return newest_ == 0; }

 private:
  [[nodiscard]] bool adopt_identity(const CmmHeader& header);
  void note_losses(const CmmHeader& header);
  void note_overflow(bool reported);
  void note_finish(const CmmHeader& header);
  void take_back_overshoot(const CmmHeader& header);
  [[nodiscard]] bool goes_back(const CmmHeader& header);
  void note_last(const CmmHeader& header);
  void damaged(const std::string& fault);
  void skip_to(std::uint64_t sequence, const std::string& why);

  const ModbusSettings& settings_;
  SourceStatus& status_;
  PointQueue points_;
  std::optional<CmmHeader> current_;   ///< the header whose identity is believed, newest included
  std::optional<CmmHeader> previous_;  ///< the header before this one
  std::uint64_t next_ = 1;
  std::uint32_t taken_ = 0;   ///< last record that was good
  std::uint32_t floor_ = 0;   ///< the device's newest record is not older, or it numbers again
  std::uint32_t newest_ = 0;  ///< as the last header has it, whether it is believed or not
  int tries_ = 0;             ///< how often the record next_ was found damaged
  /// How many headers in a row say so.
  struct Seen {
    int losses = 0, overflow_changes = 0, finishes = 0, overshoots = 0;
    int going_back = 0;
    int given_up = 0;  ///< that they know of the records given up last
  } seen_;
  bool overflow_ = false;  ///< the overflow bit is set, as headers in a row say
  bool stopped_ = false;
};

}  // namespace bladefit

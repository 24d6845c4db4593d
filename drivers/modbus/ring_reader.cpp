#include "drivers/modbus/ring_reader.hpp"

#include <fmt/format.h>
#include <modbus.h>

#include <algorithm>
#include <limits>

#include "drivers/modbus/cmm_record.hpp"
#include "drivers/source/source_fault.hpp"

namespace bladefit {
namespace {

constexpr int kHeadersForLoss = 2;
constexpr int kHeadersForFinish = 3;
constexpr int kHeadersForOvershoot = 3;
constexpr int kHeadersForRestart = 2;

}  // namespace

RingReader::RingReader(const ModbusSettings& settings, SourceStatus& status) : settings_(settings), status_(status) {}

void RingReader::restart(std::uint32_t after) {
  points_.clear();
  current_.reset();
  previous_.reset();
  next_ = std::uint64_t{after} + 1;
  taken_ = floor_ = after;
  newest_ = 0;
  tries_ = 0;
  seen_ = {};
  overflow_ = stopped_ = false;
}

void RingReader::observe(const CmmHeader& header) {
  const bool adopted = adopt_identity(header);
  previous_ = header;
  newest_ = header.newest;
  if (!adopted || stopped_ || goes_back(header)) return;
  current_ = header;
  const bool fault = (header.status & settings_.map.fault_mask) != 0;
  if (fault && !status_.device_fault) note_fault(status_, "the device reports a fault; see its own screen");
  status_.device_fault = fault;
  note_losses(header);
  take_back_overshoot(header);
  note_finish(header);
  note_last(header);
}

/// A newest record older than one that was taken: the device has begun to number again and has not said so by its run
/// id. Its records would be taken for those of the blade before.
bool RingReader::goes_back(const CmmHeader& header) {
  const bool older = header.newest != 0 && header.newest < floor_;
  seen_.going_back = older ? seen_.going_back + 1 : 0;
  if (seen_.going_back < kHeadersForRestart) return older;
  stopped_ = true;
  const char* const why =
      taken_ == std::numeric_limits<std::uint32_t>::max()
          ? "there is no number beyond that"
          : "it has begun to number its records from the beginning again, and its run id has not changed";
  note_stop(status_, fmt::format("the device's newest record is {} although record {} was read before: {}; start a "
                                 "session in another folder for the new records",
                                 header.newest, taken_, why));
  return true;
}

/// What was given up is so for good once headers in a row know of the records: else those were never there.
void RingReader::note_last(const CmmHeader& header) {
  const bool given_up = next_ > std::uint64_t{taken_} + 1;
  const bool known = std::uint64_t{header.newest} + 1 >= next_;
  if (given_up) seen_.given_up = known ? std::min(seen_.given_up + 1, kHeadersForOvershoot) : 0;
  const bool certain = !given_up || seen_.given_up == kHeadersForOvershoot;
  if (points_.empty() && certain) status_.last = static_cast<std::uint32_t>(next_ - 1);
  status_.behind = tries_ > 0 || !certain;
}

/// Records were given up because headers named newer ones, which later headers know nothing of: the former were wrong.
void RingReader::take_back_overshoot(const CmmHeader& header) {
  const bool overshot = next_ > std::uint64_t{taken_} + 1 && std::uint64_t{header.newest} + 1 < next_;
  seen_.overshoots = overshot ? seen_.overshoots + 1 : 0;
  if (seen_.overshoots < kHeadersForOvershoot) return;
  seen_.overshoots = 0;
  note_fault(status_, fmt::format("the device named records up to {} that it does not hold; reading goes on at {}",
                                  next_ - 1, taken_ + 1));
  next_ = std::uint64_t{taken_} + 1;
  tries_ = 0;
}

bool RingReader::adopt_identity(const CmmHeader& header) {
  if (current_ && current_->same_identity(header)) return true;
  if (current_ && !(previous_ && previous_->same_identity(header))) return false;
  const bool began = next_ > 1 && current_;
  if (began && header.run_id != current_->run_id) {
    stopped_ = true;
    status_.finished = false;
    note_fault(status_,
               fmt::format("the device has begun another run ({} instead of {}) and numbers its records from 1 "
                           "again; end this session and start a new one",
                           header.run_id, current_->run_id));
  }
  status_.run_id = header.run_id;
  return true;
}

void RingReader::note_losses(const CmmHeader& header) {
  note_overflow((header.status & settings_.map.overflow_mask) != 0);
  const bool lost = header.newest > header.capacity && header.newest - header.capacity >= next_;
  seen_.losses = lost ? seen_.losses + 1 : 0;
  if (seen_.losses < kHeadersForLoss) return;
  seen_.losses = 0;
  skip_to(std::uint64_t{header.newest} - header.capacity + 1, "overwritten in the device before they were read");
}

/// The bit may stay set for long after a loss; it means another one only after it was cleared.
void RingReader::note_overflow(bool reported) {
  seen_.overflow_changes = reported != overflow_ ? seen_.overflow_changes + 1 : 0;
  if (seen_.overflow_changes < kHeadersForLoss) return;
  seen_.overflow_changes = 0;
  overflow_ = reported;
  if (!reported) return;
  note_unnumbered_loss(status_,
                       "the device reports an overflow: points were lost in it; probe the missing points again");
}

void RingReader::note_finish(const CmmHeader& header) {
  const bool finished = (header.status & settings_.map.finished_mask) != 0 && header.newest == next_ - 1;
  seen_.finishes = finished ? std::min(seen_.finishes + 1, kHeadersForFinish) : 0;
  status_.finished = seen_.finishes == kHeadersForFinish && points_.empty();
}

RecordBatch RingReader::next_batch() const {
  if (!current_ || stopped_ || seen_.losses > 0 || seen_.going_back > 0 || current_->newest < next_) return {};
  const auto first = static_cast<std::uint32_t>(next_);
  const std::uint32_t slot = (first - 1) % current_->capacity;
  const auto most = static_cast<std::uint32_t>(MODBUS_MAX_READ_REGISTERS / settings_.map.record_size);
  const std::uint32_t count = std::min(
      {static_cast<std::uint32_t>(settings_.batch), most, current_->newest - (first - 1), current_->capacity - slot});
  return {first, static_cast<std::uint16_t>(count),
          static_cast<std::uint16_t>(settings_.map.records + slot * settings_.map.record_size)};
}

bool RingReader::accept(const RecordBatch& batch, std::span<const std::uint16_t> registers, std::int64_t time_us) {
  for (std::uint16_t index = 0; index < batch.count; ++index) {
    const std::size_t size = settings_.map.record_size;
    ProbePoint point;
    if (const Failure failure = decode_record(registers.subspan(index * size, size), settings_.map,
                                              static_cast<std::uint32_t>(next_), point)) {
      damaged(failure.message);
      status_.behind = true;
      return false;
    }
    point.time_us = time_us;
    points_.push(point);
    ++status_.records;
    taken_ = floor_ = static_cast<std::uint32_t>(next_++);
    tries_ = 0;
    status_.finished = false;
  }
  note_good(status_);
  status_.behind = false;
  return true;
}

/// The first bad look is not counted: the device may just have been writing the record.
void RingReader::damaged(const std::string& fault) {
  ++tries_;
  ++status_.resends;
  if (tries_ < 2) return;
  ++status_.damaged;
  note_fault(status_, fault);
  if (tries_ < settings_.record_tries) return;
  skip_to(next_ + 1, fmt::format("damaged in {} looks ({})", tries_, fault));
}

void RingReader::skip_to(std::uint64_t sequence, const std::string& why) {
  note_loss(status_, lost_points(static_cast<std::uint32_t>(next_), static_cast<std::uint32_t>(sequence - 1), why));
  next_ = sequence;
  tries_ = seen_.given_up = 0;
}

}  // namespace bladefit

#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "tools/simulate/points_file.hpp"

namespace bladefit::simulate {

using Clock = std::chrono::steady_clock;

struct MachineSettings {
  double rate = 200;             ///< [points/s]; 0 = as fast as the reader acknowledges
  std::uint32_t capacity = 512;  ///< records that the ring holds
  std::uint32_t run_id = 1;
  bool overflow = false;  ///< probing goes on when the ring is full, and the oldest records are lost
};

/// The measuring program of the machine: which records there are at which time. Knows no transport and no clock.
/// Record s is point s - 1 of the file.
class Machine {
 public:
  Machine(std::vector<MachinePoint> points, const MachineSettings& settings);

  /// Begins or goes on probing.
  void start(Clock::time_point now);
  void stop() { probing_ = false; }

  /// Goes back (or, after the machine was off, ahead) to the acknowledged record and probes from the next one on.
  void restart(Clock::time_point now);

  /// Sets the last record that the reader has stored. Returns false, and changes nothing, for one behind the last
  /// point.
  bool acknowledge(std::uint32_t sequence);

  /// Makes the records available that are due at `now`.
  void advance(Clock::time_point now);

  /// When the next record is due; nothing while the machine waits for a command or an acknowledge.
  [[nodiscard]] std::optional<Clock::time_point> next_due() const;

  [[nodiscard]] std::uint32_t available() const { return available_; }  ///< newest record; 0 = none yet
  [[nodiscard]] std::uint32_t acknowledged() const { return acknowledged_; }
  [[nodiscard]] std::uint32_t total() const { return static_cast<std::uint32_t>(points_.size()); }
  [[nodiscard]] std::uint32_t oldest_kept() const;  ///< oldest record still in the ring
  [[nodiscard]] bool probing() const { return probing_ && !finished(); }
  [[nodiscard]] bool finished() const { return available_ == total(); }
  [[nodiscard]] bool overflowed() const { return overflowed_; }
  [[nodiscard]] const MachinePoint& point(std::uint32_t sequence) const { return points_.at(sequence - 1); }
  [[nodiscard]] const MachineSettings& settings() const { return settings_; }

 private:
  [[nodiscard]] bool ring_full() const;

  std::vector<MachinePoint> points_;
  MachineSettings settings_;
  Clock::duration period_;
  Clock::time_point next_due_;
  std::uint32_t available_ = 0;
  std::uint32_t acknowledged_ = 0;
  bool probing_ = false;
  bool overflowed_ = false;
};

}  // namespace bladefit::simulate

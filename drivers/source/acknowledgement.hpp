#pragma once
#include <algorithm>
#include <cstdint>

namespace bladefit {

/// How far the records are stored, and how far the device knows it.
class Acknowledgement {
 public:
  /// Records up to `sequence` are stored; the device is believed to know of `known`.
  void restart(std::uint32_t sequence, std::uint32_t known) {
    stored_ = sequence;
    confirmed_ = known;
  }

  /// Every record up to `sequence` is stored.
  void store(std::uint32_t sequence) { stored_ = std::max(stored_, sequence); }

  /// The newest that is stored.
  [[nodiscard]] std::uint32_t stored() const { return stored_; }

  /// The device does not know yet what is stored.
  [[nodiscard]] bool is_due() const { return stored_ != confirmed_; }

  /// The newest that the device knows to be stored.
  [[nodiscard]] std::uint32_t known() const { return confirmed_; }

  /// What is stored now is on its way to the device.
  [[nodiscard]] std::uint32_t send() { return sending_ = stored_; }

  /// The device has what send() gave last.
  void confirm() { confirmed_ = sending_; }

 private:
  std::uint32_t stored_ = 0;
  std::uint32_t confirmed_ = 0;
  std::uint32_t sending_ = 0;
};

}  // namespace bladefit

#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "drivers/source/crc16.hpp"
#include "tests/unit/drivers/collecting.hpp"

/// What the Modbus machines of these tests have in common, whatever the link.
namespace bladefit {

using Bytes = std::vector<std::uint8_t>;

inline constexpr std::uint32_t kCapacity = 16;

inline std::uint16_t word_at(const Bytes& bytes, std::size_t at) {
  return static_cast<std::uint16_t>((bytes[at] << 8U) | bytes[at + 1]);
}

inline void put_double(std::span<std::uint16_t> words, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (std::size_t word = 0; word < 4; ++word) words[word] = static_cast<std::uint16_t>(bits >> (48U - 16U * word));
}
/// The registers of a machine with map v1, and answers to requests without their envelope.
class Registers {
 public:
  Registers() {
    inputs_[0] = 1;
    inputs_[1] = 2;
    inputs_[4] = kCapacity;
    inputs_[5] = 20;
    inputs_[7] = 5;
    put_double(std::span(inputs_).subspan(8, 4), 12345.678);
  }

  void set(std::size_t address, std::uint16_t value) {
    const std::lock_guard lock(mutex_);
    inputs_[address] = value;
  }

  [[nodiscard]] std::uint16_t holding(std::size_t address) {
    const std::lock_guard lock(mutex_);
    return holdings_[address];
  }

  /// Puts the records up to `newest` into the ring.
  void probe(std::uint32_t newest) {
    const std::lock_guard lock(mutex_);
    for (std::uint32_t sequence = inputs_[3] + 1U; sequence <= newest; ++sequence) {
      const std::span<std::uint16_t> record = std::span(inputs_).subspan(100 + (sequence - 1) % kCapacity * 20, 20);
      record[1] = static_cast<std::uint16_t>(sequence);
      put_double(record.subspan(2, 4), sequence);
      record[19] = crc16(std::span<const std::uint16_t>(record.first(19)));
    }
    inputs_[3] = static_cast<std::uint16_t>(newest);
  }

  /// Refuses the next `count` requests of a function at register `first` or behind it.
  void refuse(std::uint8_t function, std::uint8_t exception, int count, std::uint16_t first = 0) {
    const std::lock_guard lock(mutex_);
    refused_function_ = function;
    exception_ = exception;
    refusals_left_ = count;
    first_refused_ = first;
  }

  /// Answers a function with the exception that it does not know it, from now on.
  void forget_function(std::uint8_t function) {
    const std::lock_guard lock(mutex_);
    unknown_.push_back(function);
  }

  /// Bytes of every register come swapped, or only those of numbers of several registers.
  void swap_bytes(bool everywhere) {
    const std::lock_guard lock(mutex_);
    const auto swap = [](std::uint16_t& word) { word = static_cast<std::uint16_t>((word << 8U) | (word >> 8U)); };
    for (std::size_t address = 0; address < inputs_.size(); ++address) {
      const std::size_t place = address < 100 ? address : 100 + (address - 100) % 20;
      const bool in_long = place == 2 || place == 3 || (place > 5 && place < 12) || (place >= 100 && place < 114);
      if (everywhere || in_long) swap(inputs_[address]);
    }
    if (everywhere) return;
    for (std::size_t record = 100; record < inputs_.size(); record += 20) {
      inputs_[record + 19] = crc16(std::span<const std::uint16_t>(inputs_).subspan(record, 19));
    }
  }

  [[nodiscard]] int refusals() {
    const std::lock_guard lock(mutex_);
    return refusals_;
  }

  Bytes answer(const Bytes& pdu) {
    const std::lock_guard lock(mutex_);
    const std::uint16_t address = word_at(pdu, 1);
    if (pdu[0] == refused_function_ && address >= first_refused_ && refusals_left_ > 0) {
      --refusals_left_;
      ++refusals_;
      return {static_cast<std::uint8_t>(pdu[0] | 0x80U), exception_};
    }
    if (std::find(unknown_.begin(), unknown_.end(), pdu[0]) != unknown_.end())
      return {static_cast<std::uint8_t>(pdu[0] | 0x80U), 1};
    const std::uint16_t count = word_at(pdu, 3);
    if (pdu[0] == 3 || pdu[0] == 4) {
      if (address + count > inputs_.size()) return {static_cast<std::uint8_t>(pdu[0] | 0x80U), 2};
      Bytes reply = {pdu[0], static_cast<std::uint8_t>(2 * count)};
      for (std::size_t index = 0; index < count; ++index) {
        reply.push_back(static_cast<std::uint8_t>(inputs_[address + index] >> 8U));
        reply.push_back(static_cast<std::uint8_t>(inputs_[address + index] & 0xFFU));
      }
      return reply;
    }
    if (pdu[0] == 6) holdings_[address] = count;
    for (std::size_t index = 0; pdu[0] == 16 && index < count; ++index)
      holdings_[address + index] = word_at(pdu, 6 + 2 * index);
    return {pdu.begin(), pdu.begin() + 5};
  }

 private:
  std::mutex mutex_;
  std::array<std::uint16_t, 100 + kCapacity * 20> inputs_{};
  std::array<std::uint16_t, 8> holdings_{};
  Bytes unknown_;
  std::uint8_t refused_function_ = 0, exception_ = 0;
  std::uint16_t first_refused_ = 0;
  int refusals_left_ = 0, refusals_ = 0;
};

/// What a server does with the next replies.
enum class Mischief : std::uint8_t { none, silent, late, foreign_first, hang_up, noise_first, wrong_length };
/// Sequences of the points that come, whose x coordinate is their sequence.
inline Sequences collect_checked(ProbeSource& source, std::size_t count) {
  const std::vector<ProbePoint> points = collect_points(source, count);
  for (const ProbePoint& point : points) EXPECT_EQ(point.position[0], point.sequence);
  return sequences_of(points);
}

/// Lets a machine that gave no replies answer again, and expects its first point.
template <typename Machine>
void expect_answers_again(Machine& machine, ProbeSource& source) {
  machine.dumb = false;
  machine.registers.probe(1);
  EXPECT_EQ(collect_checked(source, 1), counted(1, 1));
  EXPECT_EQ(source.status().link, LinkState::up);
}

}  // namespace bladefit

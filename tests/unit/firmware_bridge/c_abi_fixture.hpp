#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <new>
#include <vector>

#include "tests/unit/firmware_bridge/c_abi.h"
#include "tests/unit/firmware_bridge/fixtures.hpp"

/// A fit made through the C interface.
namespace bladefit::testing {

struct AlignedDelete {
  void operator()(std::byte* memory) const { ::operator delete (memory, std::align_val_t{BLADEFIT_MEMORY_ALIGNMENT}); }
};
using Memory = std::unique_ptr<std::byte, AlignedDelete>;

inline Memory take_memory(std::size_t size) {
  return Memory(static_cast<std::byte*>(::operator new (size, std::align_val_t{BLADEFIT_MEMORY_ALIGNMENT})));
}

inline bladefit_point point_at(std::uint32_t sequence) {
  static const std::vector<ProbePoint> points = measured_points(200);
  const ProbePoint& from = points.at(sequence - 1);
  bladefit_point point{};
  point.struct_size = sizeof point;
  point.sequence = sequence;
  std::ranges::copy(from.position, point.position);
  std::ranges::copy(from.approach, point.approach);
  return point;
}

inline bladefit_verdict empty_verdict() {
  bladefit_verdict verdict{};
  verdict.struct_size = sizeof verdict;
  return verdict;
}

/// A fit with some points in it.
class BridgeCAbi : public ::testing::Test {
 protected:
  void SetUp() override {
    config_ = c_defaults();
    config_.capacity = 512;
    size_ = bladefit_memory_required(&config_, design_.data(), design_.size());
    ASSERT_GT(size_, 0U);
    memory_ = take_memory(size_ + BLADEFIT_MEMORY_ALIGNMENT);
    ASSERT_EQ(init(), BLADEFIT_OK);
    bladefit_verdict verdict = empty_verdict();
    for (std::uint32_t sequence = 1; sequence <= 40; ++sequence) {
      const bladefit_point point = point_at(sequence);
      ASSERT_GE(bladefit_push(handle_, &point, &verdict), 0);
    }
  }

  bladefit_status init() {
    return bladefit_init(memory_.get(), size_, design_.data(), design_.size(), &config_, &handle_);
  }

  [[nodiscard]] bladefit_fit_report report() const {
    bladefit_fit_report report{};
    report.struct_size = sizeof report;
    EXPECT_EQ(bladefit_fit(handle_, &report), BLADEFIT_OK);
    return report;
  }

  const std::vector<std::byte>& design_ = blade_bytes();
  bladefit_config config_{};
  std::size_t size_ = 0;
  Memory memory_;
  bladefit_handle* handle_ = nullptr;
};

}  // namespace bladefit::testing

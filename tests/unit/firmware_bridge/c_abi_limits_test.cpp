// The C interface: memory as a constant, copies, the last number of a point, a design by itself.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/unit/firmware_bridge/c_abi_fixture.hpp"

namespace bladefit {
namespace {

using testing::empty_verdict;
using testing::Memory;
using testing::point_at;
using testing::take_memory;

class BridgeCAbiLimits : public testing::BridgeCAbi {};

TEST_F(BridgeCAbiLimits, ACopyIsNoHandle) {
  const Memory copy = take_memory(size_);
  std::memcpy(copy.get(), memory_.get(), size_);
  EXPECT_EQ(bladefit_reset(reinterpret_cast<bladefit_handle*>(copy.get())), BLADEFIT_BAD_HANDLE);
  EXPECT_EQ(report().points, 40U);
}

TEST_F(BridgeCAbiLimits, ThePointAfterTheLastNumberIsADuplicate) {
  bladefit_verdict verdict = empty_verdict();
  bladefit_point point = point_at(41);
  point.sequence = UINT32_MAX;
  EXPECT_GE(bladefit_push(handle_, &point, &verdict), 0);
  point.sequence = 1;
  EXPECT_EQ(bladefit_push(handle_, &point, &verdict), BLADEFIT_DUPLICATE);
  EXPECT_EQ(bladefit_reset(handle_), BLADEFIT_OK);
  EXPECT_GE(bladefit_push(handle_, &point, &verdict), 0);
  EXPECT_EQ(verdict.sequence, 1U);
}

TEST_F(BridgeCAbiLimits, TheConstantCoversWhatIsNeededAndLittleMore) {
  constexpr std::size_t kAtMostTooMuch = 8192;
  static_assert(BLADEFIT_MEMORY_BYTES(4096, BLADEFIT_LEAST_SQUARES) > 0, "a constant");
  config_.leading_edge_tolerance_mm = config_.rest_tolerance_mm = 1;
  for (config_.mode = BLADEFIT_LEAST_SQUARES; config_.mode <= BLADEFIT_CONSTRAINED; ++config_.mode) {
    for (const std::uint32_t capacity : {6U, 7U, 64U, 1001U, 65536U, BLADEFIT_MAX_CAPACITY}) {
      config_.capacity = capacity;
      const std::size_t needed = bladefit_memory_required(&config_, design_.data(), design_.size());
      const std::size_t constant = BLADEFIT_MEMORY_BYTES(capacity, config_.mode);
      EXPECT_GE(constant, needed) << config_.mode << " " << capacity;
      EXPECT_LE(constant, needed + kAtMostTooMuch) << config_.mode << " " << capacity;
    }
  }
}

TEST_F(BridgeCAbiLimits, ADesignIsCheckedByItself) {
  EXPECT_EQ(bladefit_design_check(design_.data(), design_.size()), BLADEFIT_OK);
  EXPECT_EQ(bladefit_design_check(nullptr, design_.size()), BLADEFIT_NULL_ARGUMENT);
  EXPECT_EQ(bladefit_design_check(design_.data(), design_.size() - 8), BLADEFIT_BAD_LENGTH);
  EXPECT_EQ(bladefit_memory_required(&config_, design_.data(), design_.size() - 8), 0U);
  std::vector<std::byte> damaged = design_;
  damaged[damaged.size() / 2] ^= std::byte{1};
  EXPECT_EQ(bladefit_design_check(damaged.data(), damaged.size()), BLADEFIT_BAD_CRC);
  EXPECT_EQ(bladefit_memory_required(&config_, damaged.data(), damaged.size()), size_) << "looks at the head alone";
}

}  // namespace
}  // namespace bladefit

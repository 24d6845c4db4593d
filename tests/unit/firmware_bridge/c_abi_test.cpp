// The C interface: a session run from C, and every bad argument.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "tests/unit/firmware_bridge/c_abi_fixture.hpp"

namespace bladefit {
namespace {

using testing::BridgeCAbi;
using testing::empty_verdict;
using testing::Memory;
using testing::point_at;
using testing::take_memory;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(BridgeCAbiSession, RunsFromC) {
  const std::vector<ProbePoint> points = testing::measured_points(2000);
  std::vector<double> numbers;
  for (const ProbePoint& point : points) {
    numbers.insert(numbers.end(), point.position.begin(), point.position.end());
    numbers.insert(numbers.end(), point.approach.begin(), point.approach.end());
  }
  constexpr std::size_t kPlenty = 8U << 20U;
  const Memory memory = take_memory(kPlenty);
  const std::vector<std::byte>& design = testing::blade_bytes();
  bladefit_fit_report report{};
  std::uint32_t verdicts = 0, revisions = 0;
  EXPECT_EQ(c_session(memory.get(), kPlenty, design.data(), design.size(), numbers.data(), 2000, &report, &verdicts,
                      &revisions),
            BLADEFIT_OK);
  EXPECT_EQ(verdicts, 2000U);
  EXPECT_GT(revisions, 0U);
  EXPECT_EQ(report.status, static_cast<std::uint32_t>(BLADEFIT_FIT_CONVERGED));
  EXPECT_EQ(report.determined, 6U);
  // truth/full.json of the case
  EXPECT_NEAR(report.rms_mm, 0.04713, 5e-6);
  EXPECT_EQ(
      c_session(memory.get(), 4096, design.data(), design.size(), numbers.data(), 2000, &report, &verdicts, &revisions),
      BLADEFIT_NOT_ENOUGH_MEMORY);
}

TEST(BridgeCAbiText, EveryStatusHasOne) {
  EXPECT_EQ(bladefit_abi_version(), BLADEFIT_ABI_VERSION);
  for (int status = -40; status < 20; ++status) {
    ASSERT_NE(bladefit_status_text(status), nullptr);
    EXPECT_GT(std::strlen(bladefit_status_text(status)), 1U);
  }
  EXPECT_STRNE(bladefit_status_text(BLADEFIT_BAD_SIZE), bladefit_status_text(BLADEFIT_BAD_HANDLE));
}

TEST_F(BridgeCAbi, InitRefusesBadPointersAndSizes) {
  bladefit_handle* const before = handle_;
  auto* const memory = memory_.get();
  const void* const design = design_.data();
  const std::size_t length = design_.size();
  EXPECT_EQ(bladefit_init(nullptr, size_, design, length, &config_, &handle_), BLADEFIT_NULL_ARGUMENT);
  EXPECT_EQ(bladefit_init(memory, size_, nullptr, length, &config_, &handle_), BLADEFIT_NULL_ARGUMENT);
  EXPECT_EQ(bladefit_init(memory, size_, design, length, nullptr, &handle_), BLADEFIT_NULL_ARGUMENT);
  EXPECT_EQ(bladefit_init(memory, size_, design, length, &config_, nullptr), BLADEFIT_NULL_ARGUMENT);
  EXPECT_EQ(bladefit_init(memory + 8, size_, design, length, &config_, &handle_), BLADEFIT_MISALIGNED);
  EXPECT_EQ(bladefit_init(memory, size_ - 1, design, length, &config_, &handle_), BLADEFIT_NOT_ENOUGH_MEMORY);
  EXPECT_EQ(bladefit_init(memory, 0, design, length, &config_, &handle_), BLADEFIT_NOT_ENOUGH_MEMORY);
  EXPECT_EQ(bladefit_init(memory, size_, design, length - 8, &config_, &handle_), BLADEFIT_BAD_LENGTH);
  EXPECT_EQ(bladefit_init(memory, size_, design, 0, &config_, &handle_), BLADEFIT_BAD_LENGTH);
  EXPECT_EQ(handle_, before);
  EXPECT_EQ(report().points, 40U) << "a refused init must leave the fit in the memory as it is";
}

TEST_F(BridgeCAbi, InitRefusesADamagedDesign) {
  std::vector<std::byte> damaged = design_;
  damaged[damaged.size() / 2] ^= std::byte{1};
  EXPECT_EQ(bladefit_init(memory_.get(), size_, damaged.data(), damaged.size(), &config_, &handle_), BLADEFIT_BAD_CRC);
  damaged[0] = std::byte{'X'};
  EXPECT_EQ(bladefit_init(memory_.get(), size_, damaged.data(), damaged.size(), &config_, &handle_),
            BLADEFIT_BAD_MAGIC);
  EXPECT_EQ(bladefit_memory_required(&config_, damaged.data(), damaged.size()), 0U);
  EXPECT_EQ(report().points, 40U);
}

struct BadConfig {
  const char* name;
  std::function<void(bladefit_config&)> spoil;
  bladefit_status expected;
};

const std::vector<BadConfig>& bad_configs() {
  static const std::vector<BadConfig> configs = {
      {"size 0", [](auto& c) { c.struct_size = 0; }, BLADEFIT_BAD_SIZE},
      {"size - 1", [](auto& c) { --c.struct_size; }, BLADEFIT_BAD_SIZE},
      {"size + 1", [](auto& c) { ++c.struct_size; }, BLADEFIT_BAD_SIZE},
      {"capacity 5", [](auto& c) { c.capacity = 5; }, BLADEFIT_OUT_OF_RANGE},
      {"capacity huge", [](auto& c) { c.capacity = UINT32_MAX; }, BLADEFIT_OUT_OF_RANGE},
      {"refresh 1", [](auto& c) { c.refresh_per_push = 1; }, BLADEFIT_OUT_OF_RANGE},
      {"refresh 65", [](auto& c) { c.refresh_per_push = 65; }, BLADEFIT_OUT_OF_RANGE},
      {"approach 2", [](auto& c) { c.use_approach = 2; }, BLADEFIT_OUT_OF_RANGE},
      {"edges 2", [](auto& c) { c.edges = 2; }, BLADEFIT_OUT_OF_RANGE},
      {"boxes 33", [](auto& c) { c.box_count = 33; }, BLADEFIT_OUT_OF_RANGE},
      {"reserved 1", [](auto& c) { c.reserved = 1; }, BLADEFIT_OUT_OF_RANGE},
      {"reserved 1 of a box", [](auto& c) { c.boxes[0].reserved = c.box_count = 1; }, BLADEFIT_OUT_OF_RANGE},
      {"boxes huge", [](auto& c) { c.box_count = UINT32_MAX; }, BLADEFIT_OUT_OF_RANGE},
      {"radius NaN", [](auto& c) { c.probe_radius_mm = kNan; }, BLADEFIT_NOT_FINITE},
      {"radius inf", [](auto& c) { c.probe_radius_mm = kInfinity; }, BLADEFIT_NOT_FINITE},
      {"radius < 0", [](auto& c) { c.probe_radius_mm = -1; }, BLADEFIT_OUT_OF_RANGE},
      {"noise 0", [](auto& c) { c.noise_floor_mm = 0; }, BLADEFIT_OUT_OF_RANGE},
      {"noise NaN", [](auto& c) { c.noise_floor_mm = kNan; }, BLADEFIT_NOT_FINITE},
      {"determined < 0", [](auto& c) { c.determined_mm = -1; }, BLADEFIT_OUT_OF_RANGE},
      {"tolerance 0", [](auto& c) { c.leading_edge_tolerance_mm = 0; }, BLADEFIT_OUT_OF_RANGE},
      {"tolerance NaN", [](auto& c) { c.leading_edge_tolerance_mm = kNan; }, BLADEFIT_NOT_FINITE},
      {"rest NaN", [](auto& c) { c.rest_tolerance_mm = kNan; }, BLADEFIT_NOT_FINITE},
      {"rest < 0", [](auto& c) { c.rest_tolerance_mm = -kInfinity; }, BLADEFIT_OUT_OF_RANGE},
      {"transition NaN", [](auto& c) { c.transition = kNan; }, BLADEFIT_NOT_FINITE},
      {"transition < 0", [](auto& c) { c.transition = -0.1; }, BLADEFIT_OUT_OF_RANGE},
      {"window NaN", [](auto& c) { c.window_low = kNan; }, BLADEFIT_NOT_FINITE},
      {"window empty", [](auto& c) { c.window_low = 1; }, BLADEFIT_OUT_OF_RANGE},
      {"window > 1", [](auto& c) { c.window_high = 1.5; }, BLADEFIT_OUT_OF_RANGE},
      {"rotation NaN", [](auto& c) { c.start_rotation[4] = kNan; }, BLADEFIT_NOT_FINITE},
      {"rotation scaled", [](auto& c) { c.start_rotation[0] = 1.001; }, BLADEFIT_OUT_OF_RANGE},
      {"mirrored", [](auto& c) { c.start_rotation[0] = -1; }, BLADEFIT_OUT_OF_RANGE},
      {"translation inf", [](auto& c) { c.start_translation[2] = kInfinity; }, BLADEFIT_NOT_FINITE},
      {"box NaN", [](auto& c) { c.box_count = 1, c.boxes[0].u_min = kNan; }, BLADEFIT_NOT_FINITE},
      {"box reversed", [](auto& c) { c.box_count = 1, c.boxes[0].v_min = 0.5; }, BLADEFIT_OUT_OF_RANGE},
      {"box patch", [](auto& c) { c.box_count = 1, c.boxes[0].patch = 1; }, BLADEFIT_OUT_OF_RANGE},
  };
  return configs;
}

TEST_F(BridgeCAbi, InitRefusesEveryBadField) {
  const bladefit_config good = config_;
  for (const BadConfig& bad : bad_configs()) {
    config_ = good;
    bad.spoil(config_);
    EXPECT_EQ(init(), bad.expected) << bad.name;
    EXPECT_EQ(bladefit_memory_required(&config_, design_.data(), design_.size()), 0U) << bad.name;
  }
  EXPECT_EQ(report().points, 40U);
}

TEST_F(BridgeCAbi, PushRefusesBadArgumentsAndChangesNothing) {
  const bladefit_fit_report before = report();
  bladefit_verdict verdict = empty_verdict();
  const bladefit_point good = point_at(41);
  EXPECT_EQ(bladefit_push(nullptr, &good, &verdict), BLADEFIT_NULL_ARGUMENT);
  EXPECT_EQ(bladefit_push(handle_, nullptr, &verdict), BLADEFIT_NULL_ARGUMENT);
  EXPECT_EQ(bladefit_push(handle_, &good, nullptr), BLADEFIT_NULL_ARGUMENT);
  const auto expect = [&](bladefit_status expected, const std::function<void(bladefit_point&)>& spoil) {
    bladefit_point bad = good;
    spoil(bad);
    EXPECT_EQ(bladefit_push(handle_, &bad, &verdict), expected);
  };
  expect(BLADEFIT_BAD_SIZE, [](auto& p) { p.struct_size = 8; });
  expect(BLADEFIT_OUT_OF_RANGE, [](auto& p) { p.sequence = 0; });
  expect(BLADEFIT_OUT_OF_RANGE, [](auto& p) { p.path = 65536; });
  expect(BLADEFIT_OUT_OF_RANGE, [](auto& p) { p.reserved = 1; });
  expect(BLADEFIT_OUT_OF_RANGE, [](auto& p) { p.approach[0] = 3; });
  expect(BLADEFIT_NOT_FINITE, [](auto& p) { p.position[2] = kNan; });
  expect(BLADEFIT_NOT_FINITE, [](auto& p) { p.position[0] = -kInfinity; });
  expect(BLADEFIT_NOT_FINITE, [](auto& p) { p.approach[1] = kNan; });
  expect(BLADEFIT_DUPLICATE, [](auto& p) { p.sequence = 40; });
  bladefit_verdict wrong_size = verdict;
  wrong_size.struct_size = 4;
  EXPECT_EQ(bladefit_push(handle_, &good, &wrong_size), BLADEFIT_BAD_SIZE);
  EXPECT_EQ(verdict.sequence, 0U) << "no verdict may be written";
  const bladefit_fit_report after = report();
  EXPECT_EQ(std::memcmp(&before, &after, sizeof before), 0);
  EXPECT_GE(bladefit_push(handle_, &good, &verdict), 0);
  EXPECT_EQ(verdict.sequence, 41U);
}

TEST_F(BridgeCAbi, MisalignedPointersAreRefused) {
  alignas(8) std::array<std::byte, 1024> room{};
  bladefit_verdict verdict = empty_verdict();
  auto* const point = reinterpret_cast<bladefit_point*>(room.data() + 1);
  EXPECT_EQ(bladefit_push(handle_, point, &verdict), BLADEFIT_MISALIGNED);
  auto* const odd_verdict = reinterpret_cast<bladefit_verdict*>(room.data() + 4);
  EXPECT_EQ(bladefit_next_revision(handle_, odd_verdict), BLADEFIT_MISALIGNED);
  auto* const odd_handle = reinterpret_cast<bladefit_handle*>(memory_.get() + 8);
  EXPECT_EQ(bladefit_reset(odd_handle), BLADEFIT_MISALIGNED);
  EXPECT_EQ(bladefit_conclude(odd_handle), BLADEFIT_MISALIGNED);
  EXPECT_EQ(bladefit_fit(handle_, reinterpret_cast<bladefit_fit_report*>(room.data() + 2)), BLADEFIT_MISALIGNED);
}

TEST_F(BridgeCAbi, AHandleThatIsNoneIsRefused) {
  const Memory zeros = take_memory(4096);
  std::memset(zeros.get(), 0, 4096);
  auto* const none = reinterpret_cast<bladefit_handle*>(zeros.get());
  bladefit_verdict verdict = empty_verdict();
  bladefit_fit_report report{};
  report.struct_size = sizeof report;
  const bladefit_point point = point_at(1);
  EXPECT_EQ(bladefit_push(none, &point, &verdict), BLADEFIT_BAD_HANDLE);
  EXPECT_EQ(bladefit_next_revision(none, &verdict), BLADEFIT_BAD_HANDLE);
  EXPECT_EQ(bladefit_refine(none, 1), BLADEFIT_BAD_HANDLE);
  EXPECT_EQ(bladefit_conclude(none), BLADEFIT_BAD_HANDLE);
  EXPECT_EQ(bladefit_fit(none, &report), BLADEFIT_BAD_HANDLE);
  EXPECT_EQ(bladefit_verdict_of(none, 1, &verdict), BLADEFIT_BAD_HANDLE);
  EXPECT_EQ(bladefit_reset(none), BLADEFIT_BAD_HANDLE);
  EXPECT_EQ(bladefit_refine(nullptr, 1), BLADEFIT_NULL_ARGUMENT);
  EXPECT_EQ(bladefit_conclude(nullptr), BLADEFIT_NULL_ARGUMENT);
  EXPECT_EQ(bladefit_reset(nullptr), BLADEFIT_NULL_ARGUMENT);
}

TEST_F(BridgeCAbi, FindsVerdictsAndResets) {
  bladefit_verdict verdict = empty_verdict();
  EXPECT_EQ(bladefit_verdict_of(handle_, 40, &verdict), BLADEFIT_OK);
  EXPECT_EQ(verdict.sequence, 40U);
  EXPECT_EQ(bladefit_verdict_of(handle_, 41, &verdict), BLADEFIT_NOT_FOUND);
  EXPECT_EQ(verdict.sequence, 40U);
  EXPECT_EQ(bladefit_reset(handle_), BLADEFIT_OK);
  EXPECT_EQ(report().points, 0U);
  EXPECT_EQ(bladefit_next_revision(handle_, &verdict), BLADEFIT_NOT_FOUND);
}

/// With few points verdicts wait for more; conclude() says that none come, and the next push takes it back.
TEST_F(BridgeCAbi, ConcludesUntilTheNextPush) {
  ASSERT_EQ(bladefit_reset(handle_), BLADEFIT_OK);
  bladefit_verdict verdict = empty_verdict();
  for (std::uint32_t sequence = 1; sequence <= 10; ++sequence) {
    const bladefit_point point = point_at(20 * sequence - 19);
    ASSERT_GE(bladefit_push(handle_, &point, &verdict), 0);
  }
  const auto refine_and_ask = [&] {
    while (bladefit_refine(handle_, 100) == BLADEFIT_MORE_WORK) {
    }
    EXPECT_EQ(bladefit_verdict_of(handle_, 1, &verdict), BLADEFIT_OK);
    return verdict.state;
  };
  EXPECT_EQ(refine_and_ask(), static_cast<std::uint32_t>(BLADEFIT_PENDING));
  ASSERT_EQ(bladefit_conclude(handle_), BLADEFIT_OK);
  EXPECT_NE(refine_and_ask(), static_cast<std::uint32_t>(BLADEFIT_PENDING));
  EXPECT_EQ(report().determined, 6U);
  const bladefit_point next = point_at(200);
  ASSERT_GE(bladefit_push(handle_, &next, &verdict), 0);
  EXPECT_EQ(verdict.state, static_cast<std::uint32_t>(BLADEFIT_PENDING));
}

}  // namespace
}  // namespace bladefit

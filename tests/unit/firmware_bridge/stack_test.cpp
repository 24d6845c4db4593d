// The stack that every call of the C interface takes, measured: what bladefit.h says of it is held here.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "tests/support/reference_case.hpp"
#include "tests/unit/firmware_bridge/c_abi_fixture.hpp"
#include "tests/unit/firmware_bridge/painted_stack.hpp"

namespace bladefit {
namespace {

using testing::empty_verdict;
using testing::PaintedStack;

constexpr std::size_t kPushed = 400;

/// Most of the stack that each call has taken, by its name.
using StackUse = std::map<std::string, std::size_t>;

/// One fit, every call of it measured.
class MeasuredFit {
 public:
  MeasuredFit(const std::string& name, std::uint32_t mode, StackUse& use) : use_(use) {
    const testing::ReferenceCase reference = testing::read_case(name);
    const std::vector<std::byte>& design = testing::reference_design(name).bytes();
    config_ = c_defaults();
    config_.capacity = 300;  // fewer than come
    config_.mode = mode;
    config_.box_count = 1;
    config_.boxes[0] = {0.4, 0.6, 0.0, 1.0, 0, 0};
    config_.leading_edge_tolerance_mm = 0.1;
    config_.rest_tolerance_mm = 0.2;
    std::size_t size = 0;
    measure("memory_required", [&] { size = bladefit_memory_required(&config_, design.data(), design.size()); });
    measure("design_check", [&] { EXPECT_EQ(bladefit_design_check(design.data(), design.size()), BLADEFIT_OK); });
    memory_ = testing::take_memory(size);
    measure("init", [&] {
      EXPECT_EQ(bladefit_init(memory_.get(), size, design.data(), design.size(), &config_, &handle_), BLADEFIT_OK);
    });
    const std::vector<ProbePoint> measured = testing::thinned(reference, 0, 1);
    for (const ProbePoint& from : measured) {
      if (points_.size() == kPushed) break;
      bladefit_point point{
          sizeof(bladefit_point), static_cast<std::uint32_t>(points_.size() + 1), from.path, 0, {}, {}, 0};
      std::ranges::copy(from.position, point.position);
      std::ranges::copy(from.approach, point.approach);
      points_.push_back(point);
    }
  }

  void run() {
    bladefit_verdict verdict = empty_verdict();
    const std::size_t half = points_.size() / 2;
    measure("push", [&] {
      for (std::size_t k = 0; k < half; ++k) (void)bladefit_push(handle_, &points_[k], &verdict);
    });
    std::vector<bladefit_verdict> verdicts(points_.size(), verdict);
    std::vector<bladefit_status> statuses(points_.size());
    measure("push_many", [&] {
      (void)bladefit_push_many(handle_, &points_[half], points_.size() - half, verdicts.data(), statuses.data());
    });
    measure("next_revision", [&] {
      while (bladefit_next_revision(handle_, &verdict) == BLADEFIT_OK) {
      }
    });
    measure("conclude", [&] { (void)bladefit_conclude(handle_); });
    measure("refine", [&] {
      while (bladefit_refine(handle_, 100) == BLADEFIT_MORE_WORK) {
      }
    });
    bladefit_fit_report report{};
    report.struct_size = sizeof report;
    measure("fit", [&] { (void)bladefit_fit(handle_, &report); });
    measure("verdict_of", [&] { (void)bladefit_verdict_of(handle_, 7, &verdict); });
    measure("reset", [&] { (void)bladefit_reset(handle_); });
    const bladefit_zone zone = {sizeof zone, BLADEFIT_REST, nullptr, 0, 0, 0.0, INFINITY, 0.1, 0.2};
    measure("set_zones", [&] { EXPECT_EQ(bladefit_set_zones(handle_, &zone, 1, nullptr), BLADEFIT_OK); });
    measure("status_text", [&] { (void)bladefit_status_text(BLADEFIT_BAD_CRC); });
  }

 private:
  void measure(const std::string& call, const std::function<void()>& work) {
    use_[call] = std::max(use_[call], stack_.used_by(work));
  }

  StackUse& use_;
  bladefit_config config_{};
  testing::Memory memory_;
  bladefit_handle* handle_ = nullptr;
  std::vector<bladefit_point> points_;
  PaintedStack stack_;
};

TEST(PaintedStackTest, SeesWhatACallTakes) {
  PaintedStack stack;
  const std::size_t little = stack.used_by([] {});
  const std::size_t much = stack.used_by([] {
    std::array<volatile char, 20000> room;
    room[0] = 1;
    EXPECT_EQ(room[0], 1);
  });
  EXPECT_LT(little, 1000U);
  EXPECT_GE(much, 20000U);
  EXPECT_LT(much, 22000U);
}

void measure_all(StackUse& use) {
  for (const std::string& name : testing::reference_case_names()) {
    for (std::uint32_t mode = BLADEFIT_LEAST_SQUARES; mode <= BLADEFIT_CONSTRAINED; ++mode) {
      MeasuredFit fit(name, mode, use);
      fit.run();
    }
  }
}

TEST(BridgeStack, NoCallTakesMoreThanTheHeaderSays) {
  StackUse use;
  measure_all(use);
  use.clear();  // the first call of a function of the C library takes what finds it
  measure_all(use);
  for (const auto& [call, bytes] : use) {
    std::printf("stack of bladefit_%s: %zu bytes\n", call.c_str(), bytes);
    EXPECT_LE(bytes, BLADEFIT_STACK_BYTES) << call;
  }
}

}  // namespace
}  // namespace bladefit

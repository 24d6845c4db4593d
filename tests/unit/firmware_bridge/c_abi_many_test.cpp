// A batch of points through the C interface: the same bits as one at a time, and what it costs.
#include <gtest/gtest.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "tests/unit/firmware_bridge/c_abi_fixture.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kBatchPoints = 1500;

/// The measured points, with records in between that no push takes.
std::vector<bladefit_point> points_with_bad_ones() {
  std::vector<bladefit_point> points;
  std::uint32_t sequence = 0;
  for (const ProbePoint& from : testing::measured_points(kBatchPoints)) {
    bladefit_point point{sizeof(bladefit_point), ++sequence, from.path, 0, {}, {}, 0};
    std::ranges::copy(from.position, point.position);
    std::ranges::copy(from.approach, point.approach);
    points.push_back(point);
    if (sequence % 97 != 0) continue;
    const bladefit_point good = point;
    points.push_back(good);  // a duplicate
    point.sequence = sequence + 1;
    point.position[1] = std::numeric_limits<double>::quiet_NaN();
    points.push_back(point);
    point = good, point.sequence = sequence + 1, point.approach[0] = 7;
    points.push_back(point);
    point = good, point.struct_size = 1;
    points.push_back(point);
    point = good, point.reserved = 1, point.sequence = sequence + 1;
    points.push_back(point);
  }
  return points;
}

/// What a fit has answered: bytes, so that every bit counts.
struct Answers {
  std::vector<bladefit_status> statuses;
  std::vector<bladefit_verdict> verdicts;
  std::vector<bladefit_verdict> revisions;
  bladefit_fit_report report{};
};

template <class Row>
bool same_bytes(const std::vector<Row>& a, const std::vector<Row>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Row)) == 0;
}

/// A fit of some mode that keeps fewer points than come.
class OwnFit {
 public:
  OwnFit(std::uint32_t mode, std::uint32_t capacity) {
    bladefit_config config = c_defaults();
    config.capacity = capacity;
    config.mode = mode;
    config.box_count = 1;
    config.boxes[0] = {0.4, 0.6, 0.0, 1.0, 0, 0};
    config.leading_edge_tolerance_mm = 0.1;
    config.rest_tolerance_mm = 0.2;
    const std::vector<std::byte>& design = testing::blade_bytes();
    const std::size_t size = bladefit_memory_required(&config, design.data(), design.size());
    memory_ = testing::take_memory(size);
    if (bladefit_init(memory_.get(), size, design.data(), design.size(), &config, &handle) != BLADEFIT_OK) std::abort();
  }

  void take_revisions(Answers& answers) {
    bladefit_verdict verdict = testing::empty_verdict();
    while (bladefit_next_revision(handle, &verdict) == BLADEFIT_OK) answers.revisions.push_back(verdict);
  }

  void conclude(Answers& answers) {
    EXPECT_EQ(bladefit_conclude(handle), BLADEFIT_OK);
    while (bladefit_refine(handle, 4096) == BLADEFIT_MORE_WORK) {
    }
    take_revisions(answers);
    answers.report.struct_size = sizeof answers.report;
    EXPECT_EQ(bladefit_fit(handle, &answers.report), BLADEFIT_OK);
  }

  bladefit_handle* handle = nullptr;

 private:
  testing::Memory memory_;
};

/// In batches of `batch` points, 0: one push a point. Revisions are taken after as many points in either case.
Answers answers_of(const std::vector<bladefit_point>& points, std::uint32_t mode, std::uint32_t capacity,
                   std::size_t batch, bool by_batch) {
  OwnFit fit(mode, capacity);
  Answers answers;
  answers.statuses.resize(points.size());
  answers.verdicts.assign(points.size(), testing::empty_verdict());
  for (std::size_t first = 0; first < points.size(); first += batch) {
    const std::size_t count = std::min(batch, points.size() - first);
    bladefit_status* const statuses = answers.statuses.data() + first;
    bladefit_verdict* const verdicts = answers.verdicts.data() + first;
    if (by_batch) {
      const bladefit_status outcome = bladefit_push_many(fit.handle, &points[first], count, verdicts, statuses);
      const bool refused = std::any_of(statuses, statuses + count, [](bladefit_status s) { return s < 0; });
      EXPECT_EQ(outcome, refused ? BLADEFIT_POINTS_REFUSED : BLADEFIT_OK);
    } else {
      for (std::size_t k = 0; k < count; ++k) statuses[k] = bladefit_push(fit.handle, &points[first + k], verdicts + k);
    }
    fit.take_revisions(answers);
  }
  fit.conclude(answers);
  return answers;
}

class BridgeCAbiMany : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(BridgeCAbiMany, ABatchAnswersBitForBitAsOneAtATime) {
  const std::vector<bladefit_point> points = points_with_bad_ones();
  for (const std::uint32_t capacity : {2048U, 300U}) {
    for (const std::size_t batch : {std::size_t{1}, std::size_t{64}, points.size()}) {
      SCOPED_TRACE(std::to_string(capacity) + " places, batches of " + std::to_string(batch));
      const Answers single = answers_of(points, GetParam(), capacity, batch, false);
      const Answers many = answers_of(points, GetParam(), capacity, batch, true);
      EXPECT_EQ(many.statuses, single.statuses);
      EXPECT_TRUE(same_bytes(many.verdicts, single.verdicts));
      EXPECT_TRUE(same_bytes(many.revisions, single.revisions));
      EXPECT_EQ(std::memcmp(&many.report, &single.report, sizeof many.report), 0);
      for (const bladefit_status wanted :
           {BLADEFIT_DUPLICATE, BLADEFIT_NOT_FINITE, BLADEFIT_OUT_OF_RANGE, BLADEFIT_BAD_SIZE}) {
        EXPECT_EQ(std::ranges::count(many.statuses, wanted) > 0, true) << wanted;
      }
      EXPECT_EQ(std::ranges::count(many.statuses, BLADEFIT_MEMORY_FULL) > 0, capacity < kBatchPoints);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, BridgeCAbiMany,
                         ::testing::Values(BLADEFIT_LEAST_SQUARES, BLADEFIT_MINIMAX, BLADEFIT_RANGE,
                                           BLADEFIT_MIN_TOLERANCE, BLADEFIT_CONSTRAINED));

class BridgeCAbiBatch : public testing::BridgeCAbi {};

TEST_F(BridgeCAbiBatch, WrongArgumentsChangeNothing) {
  const bladefit_point point = testing::point_at(41);
  bladefit_verdict verdict = testing::empty_verdict();
  bladefit_status status = 77;
  EXPECT_EQ(bladefit_push_many(nullptr, &point, 1, &verdict, &status), BLADEFIT_NULL_ARGUMENT);
  EXPECT_EQ(bladefit_push_many(handle_, nullptr, 1, &verdict, &status), BLADEFIT_NULL_ARGUMENT);
  EXPECT_EQ(bladefit_push_many(handle_, &point, 1, nullptr, &status), BLADEFIT_NULL_ARGUMENT);
  EXPECT_EQ(bladefit_push_many(handle_, &point, 1, &verdict, nullptr), BLADEFIT_NULL_ARGUMENT);
  const auto* const askew = reinterpret_cast<const bladefit_point*>(reinterpret_cast<const char*>(&point) + 1);
  EXPECT_EQ(bladefit_push_many(handle_, askew, 1, &verdict, &status), BLADEFIT_MISALIGNED);
  EXPECT_EQ(bladefit_push_many(handle_, &point, 0, &verdict, &status), BLADEFIT_OK);
  EXPECT_EQ(status, 77);
  EXPECT_EQ(report().points, 40U);
  verdict.struct_size = 0;
  EXPECT_EQ(bladefit_push_many(handle_, &point, 1, &verdict, &status), BLADEFIT_POINTS_REFUSED);
  EXPECT_EQ(status, BLADEFIT_BAD_SIZE);
  EXPECT_EQ(report().points, 40U);
  EXPECT_STREQ(bladefit_status_text(BLADEFIT_POINTS_REFUSED), "some points of the batch were not taken");
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// How long a piece of work takes [s of this thread].
template <class Work>
double time_of(Work work) {
  const double begun = cpu_seconds();
  work();
  return cpu_seconds() - begun;
}

/// The pose is settled: all points came before, and are probed again.
TEST(BridgeCAbiBatchCost, ABatchCostsNoMoreThanItsPushes) {
  std::vector<bladefit_point> points;
  for (const ProbePoint& from : testing::measured_points(kBatchPoints)) {
    bladefit_point point{sizeof(bladefit_point), from.sequence, from.path, 0, {}, {}, 0};
    std::ranges::copy(from.position, point.position);
    std::ranges::copy(from.approach, point.approach);
    points.push_back(point);
  }
  std::vector<bladefit_verdict> verdicts(points.size(), testing::empty_verdict());
  std::vector<bladefit_status> statuses(points.size());
  OwnFit single(BLADEFIT_LEAST_SQUARES, 65536), many(BLADEFIT_LEAST_SQUARES, 65536);
  const auto probe_again = [&points] {
    for (bladefit_point& point : points) point.sequence += static_cast<std::uint32_t>(points.size());
  };
  double one_s = std::numeric_limits<double>::infinity(), many_s = one_s, copy_s = one_s;
  std::vector<bladefit_point> copy(points.size());
  // In turn, so that what else the machine does strikes all of them.
  for (int run = 0; run < 8; ++run) {
    probe_again();
    one_s = std::min(one_s, time_of([&] {
                       for (std::size_t k = 0; k < points.size(); ++k)
                         statuses[k] = bladefit_push(single.handle, &points[k], &verdicts[k]);
                     }));
    many_s = std::min(many_s, time_of([&] {
                        (void)bladefit_push_many(many.handle, points.data(), points.size(), verdicts.data(),
                                                 statuses.data());
                      }));
    copy_s = std::min(copy_s, time_of([&] {
                        for (int k = 0; k < 1000; ++k) {
                          std::memcpy(copy.data(), points.data(), points.size() * sizeof points[0]);
                          points[0].path ^= 1U;  // so that no copy can be left out
                        }
                      }));
  }
  EXPECT_EQ(std::ranges::count_if(statuses, [](bladefit_status s) { return s < 0; }), 0);
  const double count = static_cast<double>(points.size());
  RecordProperty("points_a_second", static_cast<int>(count / many_s));
  std::printf("a batch: %.0f points a second, %.2f times one at a time, %.0f times a memcpy of the points\n",
              count / many_s, many_s / one_s, many_s / (copy_s / 1000));
  EXPECT_LT(many_s, 2 * one_s);
}

}  // namespace
}  // namespace bladefit

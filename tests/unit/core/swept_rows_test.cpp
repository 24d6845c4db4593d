// Sums of a sweep: in a block of lanes the same bits as one row at a time, and what QuadraticModel adds up.

#include "core/fit/swept_rows.hpp"

#include <gtest/gtest.h>

#include "tests/support/random_places.hpp"

namespace bladefit::testing {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct WeighedRow {
  DistanceRow row;
  double weight = 1;
  LossTerms terms;
  bool counts = true;
};

class SweptSums : public ::testing::TestWithParam<Loss> {
 protected:
  SweptSums() {
    std::mt19937_64 random(17);
    for (int k = 0; k < 97; ++k) rows_.push_back(drawn_row(random));
  }

  [[nodiscard]] WeighedRow drawn_row(std::mt19937_64& random) const {
    WeighedRow out;
    out.row.distance = uniform(random, -0.2, 0.2);
    for (int j = 0; j < 6; ++j) {
      out.row.gradient[j] = uniform(random, -1.0, 1.0);
      for (int i = 0; i <= j; ++i) out.row.bend(i, j) = out.row.bend(j, i) = uniform(random, -1.0, 1.0);
    }
    out.weight = uniform(random, 0.1, 3.0);
    out.terms = loss_terms(GetParam(), 0.02, out.row.distance);
    out.counts = random() % 5 != 0;
    return out;
  }

  /// Where a point does not count, its lane holds anything.
  static void put(const WeighedRow& from, std::uint32_t lane, LaneRows& rows) {
    int entry = 0;
    for (int j = 0; j < 6; ++j) {
      rows.gradient[j][lane] = from.counts ? from.row.gradient[j] : kNan;
      for (int i = 0; i <= j; ++i, ++entry) rows.bend[entry][lane] = from.counts ? from.row.bend(i, j) : kNan;
    }
  }

  /// In blocks; every third counted row of a block is added by itself.
  [[nodiscard]] QuadraticModel in_blocks() const {
    SweptRows swept;
    swept.clear();
    for (std::size_t first = 0; first < rows_.size(); first += kLanes) {
      LaneRows block{};
      for (std::size_t k = first; k < std::min(first + kLanes, rows_.size()); ++k) {
        const auto lane = static_cast<std::uint32_t>(k - first);
        const WeighedRow& r = rows_[k];
        put(r, lane, block);
        if (!r.counts) continue;
        if (k % 3 == 0) {
          swept.add(lane, r.row, r.weight, r.terms);
          WeighedRow none;
          none.counts = false;
          put(none, lane, block);
        } else {
          swept.count_in_block(lane, r.weight, r.terms);
        }
      }
      swept.add_block(block);
    }
    return moved(swept);
  }

  [[nodiscard]] QuadraticModel one_at_a_time() const {
    SweptRows swept;
    swept.clear();
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      if (rows_[k].counts) swept.add(k % kLanes, rows_[k].row, rows_[k].weight, rows_[k].terms);
    }
    return moved(swept);
  }

  [[nodiscard]] QuadraticModel by_model() const {
    QuadraticModel model;
    for (const WeighedRow& r : rows_) {
      if (r.counts) model.add(r.row, Vec6::Zero(), r.weight, r.terms);
    }
    return model;
  }

  static QuadraticModel moved(SweptRows& swept) {
    QuadraticModel model;
    swept.move_to(model);
    const QuadraticModel once = model;
    swept.move_to(model);  // nothing is left
    EXPECT_EQ(model.gauss, once.gauss);
    EXPECT_EQ(model.count, once.count);
    return once;
  }

  std::vector<WeighedRow> rows_;
};

TEST_P(SweptSums, AreTheSameBitsInBlocks) {
  const QuadraticModel a = in_blocks(), b = one_at_a_time();
  EXPECT_EQ(a.gauss, b.gauss);
  EXPECT_EQ(a.bend, b.bend);
  EXPECT_EQ(a.gradient, b.gradient);
  EXPECT_EQ(a.half_square, b.half_square);
  EXPECT_EQ(a.weight, b.weight);
  EXPECT_EQ(a.count, b.count);
}

TEST_P(SweptSums, AreThoseOfTheModel) {
  const QuadraticModel a = in_blocks(), b = by_model();
  EXPECT_LT((a.gauss - b.gauss).norm(), 1e-14 * b.gauss.norm());
  EXPECT_EQ(a.gauss, Mat6(a.gauss.transpose()));
  EXPECT_LT((a.bend - b.bend).norm(), 1e-14 * (b.bend.norm() + b.gauss.norm()));
  EXPECT_LT((a.gradient - b.gradient).norm(), 1e-14 * b.gauss.norm());
  EXPECT_NEAR(a.half_square, b.half_square, 1e-14 * b.half_square);
  EXPECT_NEAR(a.weight, b.weight, 1e-13);
  EXPECT_EQ(a.count, b.count);
}

INSTANTIATE_TEST_SUITE_P(Losses, SweptSums, ::testing::Values(Loss::none, Loss::huber, Loss::tukey),
                         [](const auto& of) { return std::string(word_of(of.param)); });

}  // namespace
}  // namespace bladefit::testing

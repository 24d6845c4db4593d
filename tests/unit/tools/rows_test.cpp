#include "tools/files/rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <string>

#include "tools/batch/ranked_value.hpp"

namespace bladefit {
namespace {

struct LongRow {
  std::size_t number = 0;
  double weight = 0;
};

constexpr std::size_t kManyRows = 100000;

/// As many as take several blocks.
Rows<LongRow> many_rows() {
  Rows<LongRow> rows;
  for (std::size_t k = 0; k < kManyRows; ++k) rows.push_back({k, 0.5 * static_cast<double>(k)});
  return rows;
}

void expect_many(const Rows<LongRow>& rows) {
  ASSERT_EQ(rows.size(), kManyRows);
  std::size_t wanted = 0;
  for (const LongRow& row : rows) {
    ASSERT_EQ(row.number, wanted);
    ASSERT_EQ(row.weight, 0.5 * static_cast<double>(wanted++));
  }
  EXPECT_EQ(rows.front().number, 0U);
  EXPECT_EQ(rows[70000].number, 70000U);
  EXPECT_EQ(rows[3].number, 3U) << "backwards as well";
  EXPECT_EQ(rows.back().number, kManyRows - 1);
}

/// The folder of temporary files is this one while it lives.
struct TemporaryFolder {
  explicit TemporaryFolder(const char* path) {
    if (const char* const before = std::getenv("TMPDIR")) before_ = before;
    setenv("TMPDIR", path, 1);
  }
  ~TemporaryFolder() { before_.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", before_.c_str(), 1); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

 private:
  std::string before_;
};

TEST(Rows, ComeBackAsTheyWereAdded) { expect_many(many_rows()); }

TEST(Rows, StayInMemoryWhereThereIsNoFolderForThem) {
  const TemporaryFolder none("/nonexistent");
  expect_many(many_rows());
}

TEST(Rows, GoWithTheListThatIsMoved) {
  Rows<LongRow> from = many_rows();
  Rows<LongRow> to = std::move(from);
  expect_many(to);
  from = Rows<LongRow>();
  from.push_back({7, 1.0});
  EXPECT_EQ(from.size(), 1U);
  EXPECT_EQ(from[0].number, 7U);
  to = std::move(from);
  EXPECT_EQ(to.size(), 1U);
  to.clear();
  EXPECT_TRUE(to.empty());
  EXPECT_EQ(to.begin(), to.end());
}

TEST(Rows, AreChangedEach) {
  Rows<LongRow> rows = many_rows();
  rows.change_each([](LongRow row) {
    row.weight = 1;
    return row;
  });
  EXPECT_EQ(rows.size(), kManyRows);
  EXPECT_EQ(std::count_if(rows.begin(), rows.end(), [](const LongRow& row) { return row.weight == 1; }),
            static_cast<std::ptrdiff_t>(kManyRows));
}

TEST(RankedValue, IsThatOfTheSortedNumbers) {
  std::mt19937_64 random(11);
  std::vector<double> numbers = {0.0, 0.0, 1e-300, 1e300, 0.25, 0.25, 0.25};
  for (int k = 0; k < 500; ++k) numbers.push_back(std::ldexp(static_cast<double>(random() % 1000), k % 40 - 20));
  std::vector<double> sorted = numbers;
  std::ranges::sort(sorted);
  const auto each = [&numbers](const std::function<void(double)>& take) { std::ranges::for_each(numbers, take); };
  for (const std::size_t rank : {std::size_t{0}, std::size_t{1}, numbers.size() / 2, numbers.size() - 1})
    EXPECT_EQ(ranked_value(rank, each), sorted[rank]);
}

}  // namespace
}  // namespace bladefit

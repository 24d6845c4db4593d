// Points from read-out lines: lines of one axis are gathered, and a number that lost a character is seen.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drivers/dro/axis_gatherer.hpp"
#include "drivers/dro/readout_format.hpp"

namespace bladefit {
namespace {

using std::chrono::milliseconds;

/// What lines of a read-out come to. They come one millisecond apart; "" is a pause between points, "~" a long silence,
/// "?" a line that cannot be read.
class ReadOut {
 public:
  explicit ReadOut(const DroSettings& settings = {}, bool from_silence = true)
      : settings_(settings), gatherer_(settings_), format_(settings_) {
    gatherer_.restart(from_silence);
  }

  ReadOut& lines(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) take(line);
    return *this;
  }

  /// x of the points so far.
  [[nodiscard]] std::vector<double> points() const {
    std::vector<double> values;
    for (const DroPoint& point : outcome_.points) values.push_back(point[0].mm);
    return values;
  }
  /// Whether every point has the same number in each axis, as those of these tests have.
  [[nodiscard]] bool unmixed() const {
    for (const DroPoint& point : outcome_.points) {
      if (point[0].mm != point[1].mm || point[0].mm != point[2].mm) return false;
    }
    return true;
  }
  [[nodiscard]] const std::vector<std::string>& losses() const { return outcome_.losses; }
  [[nodiscard]] const std::vector<std::string>& faults() const { return outcome_.faults; }
  [[nodiscard]] bool loss_says(const std::string& words) const {
    return !losses().empty() && losses().back().find(words) != std::string::npos;
  }

 private:
  void take(const std::string& text) {
    now_ += milliseconds(1);
    std::vector<DroPoint> points;
    if (text.empty() || text == "~") {
      now_ += text.empty() ? AxisGatherer::kPause : AxisGatherer::kPatience;
      gatherer_.silence(now_, points, outcome_);
    } else if (text == "?") {
      gatherer_.line_lost();
    } else {
      DroLine line;
      EXPECT_EQ(parse_dro_line(text, settings_, line).message, "") << text;
      gatherer_.take(line, now_, points, outcome_);
    }
    for (const DroPoint& point : points) format_.take(point, outcome_);
  }

  DroSettings settings_;
  AxisGatherer gatherer_;
  ReadoutFormat format_;
  DroOutcome outcome_;
  AxisGatherer::Time now_{std::chrono::hours(1)};
};

using Values = std::vector<double>;
using Lines = std::vector<std::string>;

TEST(DroAxisLines, ThreeMakeAPoint) {
  ReadOut read_out;
  read_out.lines({"X 1.5", "Y 1.5", "Z 1.5", "X 2.5", "Z 2.5", "Y 2.5"});
  EXPECT_EQ(read_out.points(), (Values{1.5, 2.5}));
  EXPECT_TRUE(read_out.losses().empty());
}

TEST(DroAxisLines, AMissingOrRepeatedAxisIsALossAndNeverAMixedPoint) {
  const Lines whole = {"X 1.5", "Y 1.5", "Z 1.5", "X 2.5", "Y 2.5", "Z 2.5",
                       "X 3.5", "Y 3.5", "Z 3.5", "X 4.5", "Y 4.5", "Z 4.5"};
  for (std::size_t first = 0; first < whole.size(); ++first) {
    for (std::size_t last = first; last < std::min(first + 2, whole.size()); ++last) {
      Lines lines = whole;
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(first),
                  lines.begin() + static_cast<std::ptrdiff_t>(last + 1));
      lines.push_back("~");
      ReadOut read_out;
      read_out.lines(lines);
      EXPECT_TRUE(read_out.unmixed()) << "without lines " << first << ".." << last;
      const std::size_t spoilt = last / 3 - first / 3 + 1;
      EXPECT_EQ(read_out.points().size(), 4 - spoilt) << "without lines " << first << ".." << last;
      EXPECT_GE(read_out.losses().size(), 1U) << "without lines " << first << ".." << last;
    }
    Lines repeated = whole;
    repeated.insert(repeated.begin() + static_cast<std::ptrdiff_t>(first), whole[first]);
    ReadOut read_out;
    read_out.lines(repeated);
    EXPECT_TRUE(read_out.unmixed()) << "line " << first << " twice";
    EXPECT_GE(read_out.losses().size(), 1U) << "line " << first << " twice";
    Lines unreadable = whole;
    unreadable[first] = "?";
    unreadable.push_back("~");
    ReadOut spoilt;
    spoilt.lines(unreadable);
    EXPECT_TRUE(spoilt.unmixed()) << "line " << first << " cannot be read";
    EXPECT_EQ(spoilt.points().size(), 3U) << "line " << first << " cannot be read";
  }
}

TEST(DroAxisLines, APauseShowsWithWhichAxisAPointBegins) {
  ReadOut burst;
  burst.lines({"Z 1.5", "X 1.5", "Y 1.5", "Z 2.5", "X 2.5", "Y 2.5"});
  EXPECT_TRUE(burst.points().empty()) << "another order than xyz is not known yet";
  burst.lines({"", "Z 3.5", "X 3.5", "Y 3.5"});
  EXPECT_EQ(burst.points(), (Values{1.5, 2.5, 3.5}));
  EXPECT_TRUE(burst.unmixed());
  ReadOut by_hand;
  by_hand.lines({"Z 1.5", "X 1.5", "Y 1.5", "", "Z 2.5", "X 2.5", "Y 2.5"});
  EXPECT_EQ(by_hand.points(), (Values{1.5, 2.5}));
  ReadOut given([] {
    DroSettings settings;
    settings.order = "zxy";
    settings.order_given = true;
    return settings;
  }());
  given.lines({"Y 1.5", "Z 2.5", "X 2.5", "Y 2.5"});
  EXPECT_EQ(given.points(), (Values{2.5}));
  EXPECT_TRUE(given.loss_says("Y came without Z before it")) << given.losses().size();
}

TEST(DroAxisLines, WhatTheLinkHasCutIsLeftOut) {
  ReadOut read_out({}, false);
  read_out.lines({"Y 1.5", "Z 1.5", "X 2.5", "Y 2.5", "Z 2.5", "X 3.5", "Y 3.5", "Z 3.5", ""});
  EXPECT_EQ(read_out.points(), (Values{2.5, 3.5}));
  EXPECT_TRUE(read_out.losses().empty());
  EXPECT_EQ(read_out.faults().size(), 1U);
}

TEST(DroAxisLines, WithoutAKnownOrderThereIsNoPoint) {
  ReadOut read_out({}, false);
  read_out.lines({"X 1.5", "Y 1.5", "Z 2.5", "X 2.5", "Y 2.5", "Z 3.5", "X 3.5", "Y 3.5", "~"});
  EXPECT_TRUE(read_out.points().empty());
  ASSERT_FALSE(read_out.faults().empty());
  EXPECT_NE(read_out.faults()[0].find("set order"), std::string::npos);
}

TEST(DroAxisLines, APointThatStaysIncompleteIsALoss) {
  ReadOut read_out;
  read_out.lines({"X 1.5", "Y 1.5", "~", "Z 1.5", "X 2.5", "Y 2.5", "Z 2.5"});
  EXPECT_EQ(read_out.points(), (Values{2.5}));
  EXPECT_GE(read_out.losses().size(), 1U);
}

TEST(DroAxisLines, ALineOfThePointsOfThreeIsCutWhereOneAxisIsLeft) {
  ReadOut read_out;
  read_out.lines({"X 1.5 Y 1.5 Z 1.5", "Z 2.5", "X 3.5 Y 3.5 Z 3.5"});
  EXPECT_EQ(read_out.points(), (Values{1.5, 3.5}));
  EXPECT_TRUE(read_out.loss_says("Z stands alone in its line"));
  ReadOut cut({}, false);
  cut.lines({"Z 1.5", "X 2.5 Y 2.5 Z 2.5"});
  EXPECT_EQ(cut.points(), (Values{2.5}));
  EXPECT_TRUE(cut.losses().empty());
}

struct CutCase {
  const char* before;  ///< two whole points
  const char* between;
  const char* cut;
  const char* says;
};

class DroCutLines : public ::testing::TestWithParam<CutCase> {};

TEST_P(DroCutLines, AreNoPoints) {
  ReadOut read_out;
  read_out.lines({GetParam().before, GetParam().between, GetParam().cut, GetParam().before});
  EXPECT_EQ(read_out.points().size(), 3U);
  ASSERT_EQ(read_out.losses().size(), 1U);
  EXPECT_TRUE(read_out.loss_says(GetParam().says)) << read_out.losses()[0];
}

INSTANTIATE_TEST_SUITE_P(
    All, DroCutLines,
    ::testing::Values(CutCase{"X 7.8702 Y 3.9861 Z 7.5149", "X 34.9271 Y 3.9698 Z 4.7101", "X 52.2734 Y 3.9584 Z 1.90",
                              "Z has 2 decimals, not 4 as before"},
                      CutCase{"X 7.8702 Y 3.9861 Z 7.5149", "X 34.9271 Y 3.9698 Z 4.7101", "X 52.273 Y 3.9584 Z 1.9060",
                              "X has 3 decimals, not 4 as before"},
                      CutCase{"X +0123.4567 Y -0001.2000 Z 0000.0000", "X +0123.4567 Y +0012.2000 Z 0000.0000",
                              "X +023.4567 Y +0012.2000 Z 0000.0000", "X takes fewer characters"},
                      CutCase{"X=+   7.8702 Y=+   3.9861 Z=+   7.5149", "X=+  34.9271 Y=+   3.9698 Z=+   4.7101",
                              "X=+  4.9271 Y=+   3.9698 Z=+   4.7101", "X takes fewer characters"},
                      CutCase{"X    7.8702 Y   -3.9861 Z    7.5149", "X   34.9271 Y    3.9698 Z  -14.7101",
                              "X   34.9271 Y    3.9698 Z  -4.7101", "Z takes fewer characters"},
                      CutCase{"X 7.8702R Y 3.9861R Z 7.5149R", "X 34.9271R Y 3.9698R Z 4.7101R",
                              "X 34.9271R Y 3.9698R Z 4.7101", "the marks behind Z are \"\", not \"R\""},
                      CutCase{"X 7.8702 mm Y 3.9861 mm Z 7.5149 mm", "X 34.9271 mm Y 3.9698 mm Z 4.7101 mm",
                              "X 34.9271 Y 3.9698 mm Z 4.7101 mm", "its units may have been switched"}));

TEST(DroFormat, ANumberNeedNotBeFilledUp) {
  ReadOut read_out;
  read_out.lines({"X 107.8702 Y 3.9861 Z 7.5149", "X 4.9271 Y -3.9698 Z 0.7101", "X 52.2734 Y 13.9584 Z -101.9012"});
  EXPECT_EQ(read_out.points().size(), 3U);
}

TEST(DroFormat, ALongNumberAmongFilledUpOnesIsNoMeasureForThem) {
  DroSettings counts;
  counts.scale = 0.0001;
  ReadOut read_out(counts);
  read_out.lines({"X 78715 Y 132451 Z 08442", "X 08715 Y 32451 Z 108442", "X 78715 Y 132451 Z 18442"});
  EXPECT_EQ(read_out.points().size(), 3U);
  read_out.lines({"X 7871 Y 132451 Z 18442"});
  EXPECT_TRUE(read_out.loss_says("X takes fewer characters"));
  ReadOut blanks;
  blanks.lines({"X   7.5 Y  7.5 Z  7.5", "X  17.5 Y  7.5 Z  7.5", "X 1234.5 Y  7.5 Z  7.5", "X   7.5 Y  7.5 Z  7.5"});
  EXPECT_EQ(blanks.points().size(), 4U);
}

TEST(DroFormat, TheFirstPointWaitsWhereItsNumbersDiffer) {
  ReadOut cut;
  cut.lines({"X 7.8702 Y 3.9861 Z 7.51"});
  EXPECT_TRUE(cut.points().empty());
  cut.lines({"X 34.9271 Y 3.9698 Z 4.7101"});
  EXPECT_EQ(cut.points(), (Values{34.9271}));
  EXPECT_TRUE(cut.loss_says("Z has 2 decimals, not 4"));
  ReadOut coarse;
  coarse.lines({"X 7.8702 Y 3.9861 Z 7.51", "X 34.9271 Y 3.9698 Z 4.71"});
  EXPECT_EQ(coarse.points(), (Values{7.8702, 34.9271}));
}

TEST(DroFormat, NumbersWithoutADecimalMarkNeedAScale) {
  ReadOut read_out;
  read_out.lines({"X 78702 Y 39861 Z 75149"});
  EXPECT_TRUE(read_out.points().empty());
  EXPECT_TRUE(read_out.loss_says("set scale"));
}

TEST(DroFormat, DroppedZerosAreReadWhereTheSettingsSaySo) {
  DroSettings settings;
  settings.fixed_decimals = false;
  ReadOut read_out(settings);
  read_out.lines({"X 7.8702 Y 3.986 Z 7.5", "X 4 Y 0 Z 0"});
  EXPECT_EQ(read_out.points(), (Values{7.8702, 4}));
}

}  // namespace
}  // namespace bladefit

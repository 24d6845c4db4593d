#include "config/point_plan.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "config/session_settings.hpp"
#include "tests/support/scratch_folder.hpp"

namespace bladefit {
namespace {

/// Reads a session file of this one text.
Failure load_plan(const testing::ScratchFolder& folder, const std::string& text, SessionSettings& settings) {
  return load_session(folder.write("plan.toml", text), settings);
}

TEST(PointPlan, IsANumberOfPointsOrAFile) {
  PointPlan plan;
  ASSERT_EQ(parse_point_plan("2000", plan).message, "");
  EXPECT_EQ(plan.count, 2000U);
  EXPECT_EQ(plan.file, "");
  ASSERT_EQ(parse_point_plan("4294967295", plan).message, "");
  EXPECT_EQ(plan.count, 4294967295U);
  for (const char* const file : {"points.csv", "./2000", "-", "2000.csv", "e"}) {
    ASSERT_EQ(parse_point_plan(file, plan).message, "") << file;
    EXPECT_EQ(plan.count, 0U);
    EXPECT_EQ(plan.file, file);
  }
}

TEST(PointPlan, RefusesNumbersThatCountNoPoints) {
  PointPlan plan{7, ""};
  for (const char* const text : {"", "0", "-5", "+5", "1e3", "12.5", "2,000", "4294967296", "99999999999999999999"}) {
    EXPECT_EQ(parse_point_plan(text, plan).message,
              "'" + std::string(text) + "': give a number of points from 1 to 4294967295, or a CSV file of the points");
  }
  EXPECT_EQ(plan.count, 7U) << "left as it was";
}

TEST(SessionFile, SaysHowManyPointsWillCome) {
  const testing::ScratchFolder folder;
  SessionSettings settings;
  ASSERT_EQ(load_plan(folder, "headless = true\n", settings).message, "");
  EXPECT_FALSE(settings.plan);
  ASSERT_EQ(load_plan(folder, "plan = 1500\n", settings).message, "");
  EXPECT_EQ(settings.plan.value().count, 1500U);
  ASSERT_EQ(load_plan(folder, "plan = \"points.csv\"\n", settings).message, "");
  EXPECT_EQ(settings.plan.value().count, 0U);
  EXPECT_EQ(settings.plan.value().file, folder / "points.csv") << "taken from the folder of the file";
  ASSERT_EQ(load_plan(folder, "plan = \"-\"\n", settings).message, "");
  EXPECT_EQ(settings.plan.value().file, "-");
}

TEST(SessionFile, RefusesAPlanThatCountsNoPoints) {
  const testing::ScratchFolder folder;
  SessionSettings settings;
  const auto message = [&](const std::string& text) {
    const std::string told = load_plan(folder, text, settings).message;
    const std::string place = folder / "plan.toml:1: key 'plan': ";
    EXPECT_EQ(told.substr(0, place.size()), place) << text;
    return told.substr(std::min(told.size(), place.size()));
  };
  EXPECT_EQ(message("plan = 0"), "0 is out of range; it must be a whole number from 1 to 4294967295");
  EXPECT_EQ(message("plan = 12.5"), "must be a whole number, not a number");
  EXPECT_EQ(message("plan = true"), "must be a whole number, not true or false");
  EXPECT_EQ(message("plan = \"12.5\""),
            "'12.5': give a number of points from 1 to 4294967295, or a CSV file of the points");
  EXPECT_EQ(message("plan = \"\""), "'': give a number of points from 1 to 4294967295, or a CSV file of the points");
  EXPECT_FALSE(settings.plan);
}

}  // namespace
}  // namespace bladefit

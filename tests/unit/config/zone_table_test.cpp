// The tables [[zone]]: what they say, and what of them is refused in which words.

#include "config/zone_table.hpp"

#include <gtest/gtest.h>

#include "config/fit_option.hpp"
#include "config/fit_settings.hpp"
#include "config/session_settings.hpp"
#include "tests/support/scratch_folder.hpp"

namespace bladefit {
namespace {

/// A file that holds these lines while the test runs.
struct ZonesFile {
  explicit ZonesFile(const std::string& text) : path(folder.write("zones.toml", text)) {}
  bladefit::testing::ScratchFolder folder;
  std::string path;
};

std::string table_of(const std::string& name, const std::string& where, const std::string& limits) {
  return "[[zone]]\nname = \"" + name + "\"\nwhere = \"" + where + "\"\n" + limits + "\n";
}

const std::string kLimits = "plus = 0.1\nminus = 0.05";

TEST(ZoneTables, AreReadInTheirOrder) {
  const ZonesFile file("[fit]\nrest_tolerance = 0.5\n" + table_of("tip edge", "auto:5mm r/R 0.7:1.0", kLimits) +
                       table_of("pieces", "0:u:0.4:0.6 1:v:0:0.1", "plus = \"0.2mm\"\nminus = \"0.01 in\"") +
                       table_of("tip", "r/R 0.9:1.2", kLimits));
  FitSettings settings;
  ASSERT_EQ(load_fit(file.path, settings).message, "");
  ASSERT_TRUE(settings.zones);
  const std::vector<ZoneSettings>& zones = *settings.zones;
  ASSERT_EQ(zones.size(), 3U);
  EXPECT_EQ(zones[0].name, "tip edge");
  EXPECT_EQ(zones[0].place.edges.at(0).reach, 5);
  EXPECT_EQ(zones[0].place.band->low, 0.7);
  EXPECT_EQ(zones[0].place.band->high, 1.0);
  EXPECT_EQ(zones[0].plus, Length{0.1});
  EXPECT_EQ(zones[0].minus, Length{0.05});
  ASSERT_EQ(zones[1].place.edges.size(), 2U);
  EXPECT_EQ(zones[1].place.edges[1].box.patch, 1U);
  EXPECT_FALSE(zones[1].place.band);
  EXPECT_EQ(zones[1].plus, (Length{0.2, Unit::mm}));
  EXPECT_EQ(zones[1].minus, (Length{0.01, Unit::inch}));
  EXPECT_TRUE(zones[2].place.edges.empty());
  EXPECT_EQ(zones[2].where, "r/R 0.9:1.2");
}

TEST(ZoneTables, OfASessionAreThoseOfItsFit) {
  const ZonesFile file(table_of("tip", "r/R 0.9:1", kLimits));
  SessionSettings session;
  ASSERT_EQ(load_session(file.path, session).message, "");
  ASSERT_TRUE(session.fit.zones);
  FitSettings flags;
  EXPECT_EQ(merged(flags, session.fit).zones->at(0).name, "tip");
  flags.zones.emplace();
  EXPECT_TRUE(merged(flags, session.fit).zones->empty()) << "flags win";
}

TEST(ZoneTables, AFileOfZonesMustHaveOne) {
  const ZonesFile some("[report]\npart = \"7\"\n" + table_of("tip", "r/R 0.9:1", kLimits)), none("[fit]\n");
  std::optional<std::vector<ZoneSettings>> zones;
  EXPECT_EQ(load_zones(some.path, zones).message, "");
  EXPECT_EQ(zones->size(), 1U);
  EXPECT_EQ(load_zones(none.path, zones).message,
            none.path + ": has no table [[zone]]; write one with name, where, plus and minus");
}

struct BadZone {
  std::string text;
  const char* error;  ///< what follows the name of the file
};

class ZoneErrors : public ::testing::TestWithParam<BadZone> {};

TEST_P(ZoneErrors, NameZoneFieldAndFixInOneLine) {
  const ZonesFile file(GetParam().text);
  FitSettings settings;
  const Failure failure = load_fit(file.path, settings);
  EXPECT_EQ(failure.kind, Failure::Kind::bad_input);
  EXPECT_EQ(failure.message.find(file.path + GetParam().error), 0U) << failure.message;
  EXPECT_EQ(failure.message.find('\n'), std::string::npos);
  EXPECT_FALSE(settings.zones);
}

const std::string kTip = table_of("tip", "r/R 0.9:1", kLimits);

INSTANTIATE_TEST_SUITE_P(
    All, ZoneErrors,
    ::testing::Values(
        BadZone{kTip + table_of("tip", "r/R 0.5:1", kLimits), ":7: key 'zone[2].name': 'tip' is also that of zone 1"},
        BadZone{table_of("", "r/R 0.5:1", kLimits), ":2: key 'zone[1].name': is empty"},
        BadZone{table_of("rest", "r/R 0.5:1", kLimits), ":2: key 'zone[1].name': 'rest' is what lies outside"},
        BadZone{"[[zone]]\nwhere = \"r/R 0.5:1\"\n" + kLimits, ":1: key 'zone[1].name': is missing"},
        BadZone{"[[zone]]\nname = \"a\"\n" + kLimits, ":1: key 'zone[1].where': is missing"},
        BadZone{table_of("a", "r/R 0.5:1", "plus = 0.1"), ":1: key 'zone[1].minus': is missing"},
        BadZone{table_of("a", "r/R 0.5:1", "plus = 0.1\nminus = -0.05"),
                ":5: key 'zone[1].minus': -0.05 is out of range; give one above 0"},
        BadZone{table_of("a", "r/R 0.5:1", "plus = 0\nminus = 0.05"), ":4: key 'zone[1].plus': 0 is out of range"},
        BadZone{table_of("a", "r/R 0.5:1.3", kLimits), ":3: key 'zone[1].where': 'r/R 0.5:1.3' is not a band"},
        BadZone{table_of("a", "r/R 0.9:0.5", kLimits), ":3: key 'zone[1].where': 'r/R 0.9:0.5' is not a band"},
        BadZone{table_of("a", "r/R", kLimits), ":3: key 'zone[1].where': 'r/R ' is not a band"},
        BadZone{table_of("a", "r/R 0:1 r/R 0:1", kLimits), ":3: key 'zone[1].where': has two bands"},
        BadZone{table_of("a", "w:0.4:0.6", kLimits), ":3: key 'zone[1].where': 'w:0.4:0.6' is not a leading-edge box"},
        BadZone{table_of("a", "", kLimits), ":3: key 'zone[1].where': names no place"},
        BadZone{table_of("a", "r/R 0.5:1", kLimits + "\npluss = 1"),
                ":6: unknown key 'zone[1].pluss'; did you mean 'plus'?"},
        BadZone{"[zone]\nname = \"a\"\n", ":1: key 'zone': must be tables, each with [[zone]] above it"}));

TEST(ZoneTables, AreSixteenAtMost) {
  std::string text;
  for (int k = 0; k < 17; ++k) text += table_of(std::to_string(k), "r/R 0.5:1", kLimits);
  const ZonesFile file(text);
  FitSettings settings;
  EXPECT_NE(load_fit(file.path, settings).message.find("17 zones, at most 16 are possible"), std::string::npos);
}

}  // namespace
}  // namespace bladefit

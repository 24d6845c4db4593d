// The table of fit options: what is made from it agrees with it, and each option does what its row says.

#include "config/fit_option.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "config/fit_toml.hpp"

namespace bladefit {
namespace {

/// The row of a key.
const FitOption& option_of(std::string_view key) {
  for (const FitOption& option : fit_options()) {
    if (option.key == key) return option;
  }
  throw std::out_of_range(std::string(key));
}

Failure set_number(std::string_view key, double value, FitSettings& settings) {
  return set(std::get<NumberOption>(option_of(key).kind), value, settings);
}

Failure set_length(std::string_view key, double value, FitSettings& settings) {
  return set(std::get<LengthOption>(option_of(key).kind), Length{.value = value}, settings);
}

std::string contents(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Reads a text as a TOML file.
Failure load(const std::string& text, FitSettings& settings) {
  std::string folder = "/tmp/bladefit_option_XXXXXX";
  if (::mkdtemp(folder.data()) == nullptr) return bad_input("no folder");
  std::ofstream(folder + "/fit.toml", std::ios::binary) << text;
  const Failure error = load_fit(folder + "/fit.toml", settings);
  std::filesystem::remove_all(folder);
  return error;
}

TEST(FitOptions, ShippedFileIsMadeFromTheTable) {
  EXPECT_EQ(contents(std::string(BLADEFIT_TEST_DATA) + "/../../config/fit.toml"), fit_toml())
      << "copy the text of fit_toml() to config/fit.toml";
}

TEST(FitOptions, EveryExampleCanBeUsed) {
  std::string text = "[fit]\n";
  for (const FitOption& option : fit_options()) {
    text += std::string(option.key) + " = " + std::string(option.example) + "\n";
  }
  FitSettings settings;
  ASSERT_EQ(load(text, settings).message, "");
  for (const FitOption& option : fit_options()) {
    std::visit([&](const auto& kind) { EXPECT_TRUE((settings.*kind.value).has_value()) << option.key; }, option.kind);
  }
}

TEST(FitOptions, KeysAreDifferentAndHaveHelp) {
  std::set<std::string_view> keys;
  for (const FitOption& option : fit_options()) {
    EXPECT_TRUE(keys.insert(option.key).second) << option.key;
    EXPECT_GT(option.help.size(), 10U) << option.key;
    EXPECT_EQ(option.help.find("--"), std::string_view::npos) << option.key;
  }
  EXPECT_EQ(keys.size(), 30U);
  EXPECT_EQ(flag_of(option_of("leading_edge")), "--leading-edge");
}

TEST(FitOptions, ShippedValuesAreTheDefaultsBesideTheTolerance) {
  FitSettings settings;
  ASSERT_EQ(load(fit_toml(), settings).message, "");
  LocalizerConfig config;
  apply_fit_options(settings, 1.0, config);
  const LocalizerConfig plain;
  EXPECT_EQ(config.mode, plain.mode);
  EXPECT_EQ(config.ratio, plain.ratio);
  EXPECT_EQ(config.regions, plain.regions);
  EXPECT_EQ(config.edges, plain.edges);
  EXPECT_EQ(config.loss, plain.loss);
  EXPECT_EQ(config.use_approach, plain.use_approach);
  EXPECT_EQ(config.probe_radius_mm, plain.probe_radius_mm);
  EXPECT_EQ(config.tolerance.transition, plain.tolerance.transition);
}

TEST(FitOptions, RangesHoldForFilesAndFlagsAlike) {
  FitSettings settings;
  for (const double bad : {0.0, -1.0, 1.1e9, std::nan("")}) {
    EXPECT_TRUE(set_length("tolerance", bad, settings)) << bad;
    EXPECT_TRUE(load("[fit]\ntolerance = " + std::to_string(bad) + "\n", settings)) << bad;
  }
  EXPECT_FALSE(settings.tolerance);
  EXPECT_FALSE(set_length("tolerance", 1e-15, settings));
  EXPECT_FALSE(load("[fit]\ntolerance = 1e-15\n", settings));
  EXPECT_EQ(set_number("ratio", 0.5, settings).message, "0.5 is out of range; give a number from 1 to 1000000000");
  EXPECT_EQ(set_length("probe_radius", -1, settings).message, "-1 is out of range; give 0 or more, up to 1000000000");
  EXPECT_FALSE(set_length("probe_radius", 0, settings));
}

TEST(FitOptions, ALengthHasAUnitOfItsOwnOrThatOfTheOthers) {
  Length length;
  for (const auto& [text, value, unit] : {std::tuple{"0.1", 0.1, std::optional<Unit>()},
                                          {"0.1mm", 0.1, Unit::mm},
                                          {" 4e-3 in", 0.004, Unit::inch},
                                          {"0.5cm", 0.5, Unit::cm},
                                          {"-1m", -1.0, Unit::metre}}) {
    ASSERT_FALSE(parse_length(text, length)) << text;
    EXPECT_EQ(length, (Length{value, unit})) << text;
  }
  for (const char* wrong : {"", "mm", "0.1 furlong", "0.1mmm", "nan", "1e400mm", "1,5mm", "0.1 0.2"})
    EXPECT_TRUE(parse_length(wrong, length)) << wrong;
  EXPECT_DOUBLE_EQ((Length{0.1, Unit::inch}).in_mm(1), 2.54);
  EXPECT_DOUBLE_EQ((Length{2.54, Unit::mm}).in_units(kMmPerInch), 0.1);
  EXPECT_DOUBLE_EQ(Length{2.54}.in_units(kMmPerInch), 2.54);
}

TEST(FitOptions, LengthsWithUnitsMeanTheSameInAnyUnits) {
  FitSettings settings;
  ASSERT_EQ(load("[fit]\ntolerance = \"0.1mm\"\nprobe_radius = \"0.5 cm\"\nrest_tolerance = 0.5\n", settings).message,
            "");
  LocalizerConfig config;
  apply_fit_options(settings, kMmPerInch, config);
  EXPECT_DOUBLE_EQ(config.tolerance.leading_edge_mm, 0.1);
  EXPECT_DOUBLE_EQ(config.probe_radius_mm, 5);
  EXPECT_DOUBLE_EQ(config.tolerance.rest_mm, 12.7) << "in the units of the others";
  EXPECT_NE(load("[fit]\ntolerance = \"0.1 miles\"\n", settings).message.find("'0.1 miles' is not a number"),
            std::string::npos);
}

TEST(FitOptions, EveryWordIsTheEnumeratorOfItsPlace) {
  FitSettings settings;
  const auto& modes = std::get<ChoiceOption<FitMode>>(option_of("mode").kind);
  for (std::size_t k = 0; k < modes.words.size(); ++k) {
    ASSERT_FALSE(set(modes, std::string(modes.words[k]), settings));
    EXPECT_EQ(word_of(*settings.mode), modes.words[k]);
  }
  EXPECT_EQ(word_of(FitMode::constrained), "constrained");
  EXPECT_EQ(word_of(Loss::tukey), "tukey");
  EXPECT_EQ(word_of(EdgePolicy::use), "use");
  EXPECT_EQ(word_of(RegionPolicy::fixed), "fixed");
  EXPECT_EQ(word_of(Unit::inch), "in");
  EXPECT_EQ(set(modes, "best", settings).message,
            "'best' is none of: least_squares, minimax, range, min_tolerance, constrained");
}

TEST(FitOptions, OutwardIsASideOrASideForEachFace) {
  const auto& outward = std::get<OutwardKind>(option_of("outward").kind);
  FitSettings settings;
  ASSERT_FALSE(set(outward, "-", settings));
  EXPECT_EQ(settings.outward, OutwardChoice(OutwardOption::minus));
  ASSERT_FALSE(set(outward, "SUCTION*:+,3:-", settings));
  EXPECT_EQ(settings.outward->faces, (std::vector<FaceSide>{{"SUCTION*", true}, {"3", false}}));
  for (const char* wrong : {"", "up", ":+", "3:", "3:+,", "3:+,4", "3:++"}) {
    const bool refused = static_cast<bool>(set(outward, wrong, settings));
    EXPECT_EQ(refused, std::string(wrong) != "3:+,") << wrong;
  }
}

TEST(FitOptions, FlagsWinOverTheFile) {
  FitSettings file, flags;
  ASSERT_FALSE(load("[fit]\ntolerance = 1\nmode = \"range\"\nignore_approach = true\n", file));
  ASSERT_FALSE(set_length("tolerance", 2, flags));
  const FitSettings both = merged(flags, file);
  EXPECT_EQ(both.tolerance, Length{2});
  EXPECT_EQ(both.mode, FitMode::range);
  EXPECT_EQ(both.ignore_approach, true);
  EXPECT_FALSE(both.ratio);
}

TEST(FitOptions, RatioGivesTheRestToleranceAndThatOfMinTolerance) {
  FitSettings settings;
  ASSERT_FALSE(load("[fit]\ntolerance = 2\nratio = 3\n", settings));
  LocalizerConfig config;
  apply_fit_options(settings, 25.4, config);
  EXPECT_EQ(config.tolerance.leading_edge_mm, 2 * 25.4);
  EXPECT_EQ(config.tolerance.rest_mm, 3 * (2 * 25.4));
  EXPECT_EQ(config.ratio, 3);
  FitSettings two;
  ASSERT_FALSE(load("[fit]\nmode = \"min_tolerance\"\ntolerance = 2\nrest_tolerance = 8\n", two));
  LocalizerConfig derived;
  apply_fit_options(two, 1.0, derived);
  EXPECT_EQ(derived.ratio, 4);
  EXPECT_EQ(derived.tolerance.rest_mm, 8);
}

TEST(FitOptions, TheRestIsApplied) {
  FitSettings settings;
  ASSERT_FALSE(
      load("[fit]\nleading_edge = [\"u:0.1:0.2\", \"1:v:0:1\"]\nwindow = \"0.1:0.9\"\nprobe_radius = 2\n"
           "transition = 0.5\nlock = \"ty\"\nloss = \"huber\"\nloss_scale = 3\nregions = \"fixed\"\n"
           "edges = \"use\"\nignore_approach = true\n",
           settings));
  LocalizerConfig config;
  apply_fit_options(settings, 10.0, config);
  EXPECT_EQ(config.tolerance.box_count, 2U);
  EXPECT_EQ(config.tolerance.boxes[1].patch, 1U);
  EXPECT_EQ(config.window_low, 0.1);
  EXPECT_EQ(config.window_high, 0.9);
  EXPECT_EQ(config.probe_radius_mm, 20);
  EXPECT_EQ(config.tolerance.transition, 0.5);
  EXPECT_EQ(config.locked, 2);
  EXPECT_EQ(config.loss, Loss::huber);
  EXPECT_EQ(config.loss_scale_mm, 30);
  EXPECT_EQ(config.regions, RegionPolicy::fixed);
  EXPECT_EQ(config.edges, EdgePolicy::use);
  EXPECT_FALSE(config.use_approach);
}

TEST(FitOptions, AnAxisIsALetterOrAPointAndADirection) {
  ShaftAxis axis;
  ASSERT_FALSE(parse_axis("z", axis));
  EXPECT_EQ(axis.direction, Vec3(0, 0, 1));
  ASSERT_FALSE(parse_axis("1, 2,3,0,0,-4", axis));
  EXPECT_EQ(axis.point, Vec3(1, 2, 3));
  EXPECT_EQ(axis.direction, Vec3(0, 0, -1));
  EXPECT_DOUBLE_EQ(axis.radius_of(Vec3(4, 6, 100)), 5);
  for (const char* wrong :
       {"", "w", "xy", "1,2,3", "1,2,3,0,0", "1,2,3,0,0,1,1", "1,2,3,0,0,nan", "1,2,3,a,0,1", "1,2,3,0,0,0"})
    EXPECT_TRUE(parse_axis(wrong, axis)) << wrong;
  EXPECT_EQ(axis.point, Vec3(1, 2, 3));
}

TEST(FitOptions, TheWordForASearchIsNoPath) {
  FitSettings settings;
  ASSERT_EQ(load("[fit]\nstart = \"search\"\n", settings).message, "");
  EXPECT_EQ(settings.start, "search");
  ASSERT_EQ(load("[fit]\nstart = \"pairs.csv\"\n", settings).message, "");
  EXPECT_NE(settings.start, "pairs.csv");
}

}  // namespace
}  // namespace bladefit

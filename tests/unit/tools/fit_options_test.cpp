// The flags of the fit options are those of the table, and say which of them cannot be used and why.

#include "tools/batch/fit_options.hpp"

#include <gtest/gtest.h>
#include <string>

#include "tools/commands/fit_flags.hpp"

namespace bladefit {
namespace {

/// What these arguments set.
FitSettings parsed(const std::string& arguments) {
  CLI::App app;
  FitSettings flags;
  add_fit_options(app, flags);
  app.parse(arguments);
  return flags;
}

std::string refusal(const std::string& arguments) {
  try {
    static_cast<void>(parsed(arguments));
  } catch (const ToolError& error) {
    return error.what();
  }
  return "";
}

TEST(FitFlags, EachOptionOfTheTableHasOne) {
  CLI::App app;
  FitSettings flags;
  add_fit_options(app, flags);
  for (const FitOption& option : fit_options()) {
    const CLI::Option* flag = app.get_option_no_throw(flag_of(option));
    ASSERT_NE(flag, nullptr) << option.key;
    EXPECT_EQ(flag->get_description(), option.help);
    EXPECT_EQ(flag->get_group(), "Fit");
  }
}

TEST(FitFlags, ValuesArriveParsed) {
  const FitSettings flags = parsed(
      "--mode minimax --leading-edge u:0.1:0.2 --leading-edge 1:v:0:1 --tolerance 2 --units in --outward - --lock "
      "tx,rz "
      "--window 0.1:0.9 --start pairs.csv --ignore-approach");
  EXPECT_EQ(flags.mode, FitMode::minimax);
  ASSERT_EQ(flags.leading_edge->size(), 2U);
  EXPECT_EQ(flags.leading_edge->at(1).box.patch, 1U);
  EXPECT_EQ(flags.tolerance, Length{2});
  EXPECT_EQ(parsed("--tolerance 0.004in").tolerance, (Length{0.004, Unit::inch}));
  EXPECT_EQ(flags.units, Unit::inch);
  EXPECT_EQ(design_choice_of(flags).outward, OutwardChoice(OutwardOption::minus));
  EXPECT_EQ(flags.lock, 33);
  EXPECT_EQ(flags.window->high, 0.9);
  EXPECT_EQ(flags.start, "pairs.csv");
  EXPECT_EQ(flags.ignore_approach, true);
  EXPECT_FALSE(flags.ratio || flags.loss || flags.edges);
  EXPECT_FALSE(parsed("").ignore_approach);
}

TEST(FitFlags, WhatCannotBeUsedIsNamedWithTheFlag) {
  EXPECT_EQ(refusal("--edges keep"), "--edges: 'keep' is none of: skip, use");
  EXPECT_EQ(refusal("--rest-tolerance 0"), "--rest-tolerance: 0 is out of range; give one above 0, up to 1000000000");
  EXPECT_EQ(refusal("--lock qq").find("--lock: 'qq' is not a degree of freedom"), 0U);
  EXPECT_EQ(refusal("--leading-edge w:0:1").find("--leading-edge: 'w:0:1' is not a leading-edge box"), 0U);
  EXPECT_EQ(refusal("--window 0.9:0.1").find("--window: '0.9:0.1' is not a window"), 0U);
  EXPECT_EQ(refusal("--tolerance 1"), "");
  EXPECT_EQ(refusal("--tolerance 1furlong").find("--tolerance: '1furlong' is not a number, nor one with its unit"), 0U);
}

}  // namespace
}  // namespace bladefit

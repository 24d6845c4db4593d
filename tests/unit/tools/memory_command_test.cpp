// `bladefit memory`: its figures are those of the C interface, and its parts make up the whole.

#include <gtest/gtest.h>

#include "core/fit/fit_mode.hpp"
#include "firmware_bridge/bladefit.h"
#include "tests/support/json_file.hpp"
#include "tests/support/process.hpp"
#include "tests/support/reference_design.hpp"

namespace bladefit {
namespace {

struct Told {
  std::optional<int> exit_code;
  std::string out, err;
};

Told tell_memory(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {BLADEFIT_COMMAND, "memory"});
  hil::Process command(arguments);
  const std::optional<int> code = command.exit_code();
  return {code, command.out(), command.err()};
}

std::size_t required(std::uint32_t capacity, std::uint32_t mode) {
  bladefit_config config = BLADEFIT_CONFIG_DEFAULTS;
  config.capacity = capacity;
  config.mode = mode;
  config.leading_edge_tolerance_mm = config.rest_tolerance_mm = 1;
  const std::vector<std::byte>& design = testing::reference_design("dtmb4119").bytes();
  return bladefit_memory_required(&config, design.data(), design.size());
}

TEST(MemoryCommand, ItsPartsAreTheBlockOfTheCInterface) {
  for (std::uint32_t mode = BLADEFIT_LEAST_SQUARES; mode <= BLADEFIT_CONSTRAINED; ++mode) {
    for (const std::uint32_t capacity : {6U, 1001U, BLADEFIT_MAX_CAPACITY}) {
      const Told told = tell_memory(
          {"--mode", std::string(kFitModeWords[mode]), "--capacity", std::to_string(capacity), "--json", "-"});
      ASSERT_EQ(told.exit_code, 0) << told.err;
      const nlohmann::json figures = testing::parse_json(told.out);
      EXPECT_EQ(figures.at("total_bytes"), required(capacity, mode)) << told.out;
      EXPECT_EQ(figures.at("static_bytes"), BLADEFIT_MEMORY_BYTES(capacity, mode));
      EXPECT_TRUE(figures.at("design_bytes").is_null());
      std::uint64_t sum = 0;
      for (const nlohmann::json& part : figures.at("parts")) sum += part.at("bytes").get<std::uint64_t>();
      EXPECT_EQ(sum, figures.at("total_bytes")) << told.out;
    }
  }
}

TEST(MemoryCommand, TakesCapacityModeAndDesignOfASession) {
  const testing::ScratchFolder folder;
  const std::string design = folder.write(
      "blade.bfd", std::string(reinterpret_cast<const char*>(testing::reference_design("dtmb4119").bytes().data()),
                               testing::reference_design("dtmb4119").bytes().size()));
  const std::string session = folder.write(
      "session.toml", "design = \"blade.bfd\"\ncapacity = 4096\n[fit]\nmode = \"minimax\"\ntolerance = 0.1\n");
  const Told told = tell_memory({"--config", session});
  ASSERT_EQ(told.exit_code, 0) << told.err;
  for (const std::string& words :
       {std::to_string(required(4096, BLADEFIT_MINIMAX)) + " bytes", std::string("4096 points in the mode minimax"),
        std::string("BLADEFIT_MEMORY_BYTES(4096, BLADEFIT_MINIMAX)"),
        std::to_string(testing::reference_design("dtmb4119").bytes().size()) + " bytes\n"}) {
    EXPECT_NE(told.out.find(words), std::string::npos) << words << "\n" << told.out;
  }
  const Told over = tell_memory({"--config", session, "--capacity", "100", "--mode", "least_squares"});
  EXPECT_NE(over.out.find("for 100 points in the mode least_squares"), std::string::npos) << over.out;
}

TEST(MemoryCommand, RefusesCapacitiesThatNoFitHas) {
  for (const char* capacity : {"5", "16777217", "7.5", "-1", "many"}) {
    const Told told = tell_memory({"--capacity=" + std::string(capacity)});
    EXPECT_EQ(told.exit_code, 2) << capacity;
    EXPECT_NE(told.err.find("--capacity"), std::string::npos) << told.err;
  }
}

}  // namespace
}  // namespace bladefit

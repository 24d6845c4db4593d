// Points that never arrive are known to the end: in the verdict, the result, a resumed session and the report.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/hil/session.hpp"

namespace bladefit::hil {
namespace {

std::uint32_t records_lost(const nlohmann::json& result) {
  std::uint32_t records = 0;
  for (const nlohmann::json& range : result.at("verdict").at("lost"))
    records += range[1].get<std::uint32_t>() - range[0].get<std::uint32_t>() + 1;
  return records;
}

bool has_reason(const nlohmann::json& result, const std::string& code) {
  for (const nlohmann::json& reason : result.at("verdict").at("reasons")) {
    if (reason.at("code") == code) return true;
  }
  return false;
}

/// Tolerances that no point misses.
std::vector<std::string> lenient(const std::string& source, const std::string& session, const std::string& json) {
  return {BLADEFIT_COMMAND, "run",         "--design", kBlade,    "--source",   source,         "--leading-edge",
          "u:0.4:0.6",      "--tolerance", "1",        "--ratio", "2",          "--panel",      "127.0.0.1:0",
          "--session",      session,       "--json",   json,      "--headless", "--until-idle", "3"};
}

/// A machine with a small memory that goes on probing while nobody reads.
TEST(RunLosses, AreNeverInTolerance) {
  const ScratchFolder scratch;
  const std::string session = scratch / "session", json = scratch / "result.json";
  const SimulatedMachine machine(
      machine_options(Link::modbus_tcp, "0", kFewPoints, {"--rate", "0", "--capacity", "40", "--faults", "overflow"}));
  const std::vector<std::string> options = lenient(source_of(Link::modbus_tcp, machine.address()), session, json);
  Process run(options);
  EXPECT_EQ(run.exit_code(), 4) << run.out() << run.err();
  const nlohmann::json result = testing::parse_json(read_whole(json));
  EXPECT_EQ(result.at("verdict").at("state"), "not_decided");
  EXPECT_TRUE(has_reason(result, "points_lost"));
  EXPECT_EQ(records_lost(result) + result.at("points").size(), 200U);
  EXPECT_GT(records_lost(result), 100U);
  EXPECT_NE(run.out().find("never arrived"), std::string::npos) << run.out();

  Process resumed(options);
  EXPECT_EQ(resumed.exit_code(), 4) << resumed.out() << resumed.err();
  EXPECT_EQ(testing::parse_json(read_whole(json)).at("verdict"), result.at("verdict"));
  Process report({BLADEFIT_COMMAND, "report", session, "--format", "html", "-o", scratch / "page.html"});
  EXPECT_EQ(report.exit_code(), 0) << report.err();
  EXPECT_NE(read_whole(scratch / "page.html").find("never arrived"), std::string::npos);
}

/// The image holds what leaves out searches, which the file that it was made from does not.
TEST(RunLosses, ASessionOnADesignFileGoesOnWithItsImage) {
  const ScratchFolder scratch;
  const std::string image = scratch / "blade.bfd";
  Process compile({BLADEFIT_COMMAND, "compile", kBlade, "-o", image});
  ASSERT_EQ(compile.exit_code(), 0) << compile.err();
  const SimulatedMachine machine(machine_options(Link::modbus_tcp, "0", kFewPoints, {"--rate", "0"}));
  std::vector<std::string> options =
      lenient(source_of(Link::modbus_tcp, machine.address()), scratch / "session", scratch / "result.json");
  Process begun(options);
  ASSERT_EQ(begun.exit_code(), 0) << begun.err();
  std::replace(options.begin(), options.end(), std::string(kBlade), image);
  Process resumed(options);
  EXPECT_EQ(resumed.exit_code(), 0) << resumed.err();
}

TEST(RunLosses, NothingLostIsInTolerance) {
  const ScratchFolder scratch;
  const std::string json = scratch / "result.json";
  const SimulatedMachine machine(machine_options(Link::modbus_tcp, "0", kFewPoints, {"--rate", "0"}));
  Process run(lenient(source_of(Link::modbus_tcp, machine.address()), scratch / "session", json));
  EXPECT_EQ(run.exit_code(), 0) << run.out() << run.err();
  EXPECT_EQ(testing::parse_json(read_whole(json)).at("verdict").at("state"), "in_tolerance");
}

}  // namespace
}  // namespace bladefit::hil

// A session over a faulty link ends with the very bytes of a session over a clean one.
#include <gtest/gtest.h>

#include <list>

#include "tests/hil/session.hpp"

namespace bladefit::hil {
namespace {

const std::vector<std::string> kModbusFaults = {
    "drop=0.02,seed=11",       "duplicate=0.1,seed=12",
    "corrupt=0.2,seed=13",     "delay=0.02:400ms,seed=14",
    "disconnect=0.02,seed=15", "drop=0.01,duplicate=0.05,corrupt=0.1,delay=0.01:400ms,disconnect=0.01,seed=16"};
const std::vector<std::string> kSerialFaults = {
    "drop=0.05,seed=21",       "duplicate=0.1,seed=22",
    "corrupt=0.05,seed=23",    "delay=0.05:100ms,seed=24",
    "disconnect=0.02,seed=25", "drop=0.02,duplicate=0.05,corrupt=0.02,delay=0.02:100ms,disconnect=0.01,seed=26"};

/// One machine with a fault and one session with it.
struct FaultySession {
  FaultySession(Link link, const std::string& fault_list)
      : faults(fault_list),
        machine(machine_options(link, link == Link::modbus_tcp ? "0" : scratch / "cmm", kFewPoints,
                                {"--rate", "400", "--faults", fault_list, "--verbose"})),
        run(run_options(source_of(link, machine.address()), scratch / "session", scratch / "result.json", kUntilIdle)) {
  }
  std::string faults;
  ScratchFolder scratch;
  SimulatedMachine machine;
  Process run;
};

class RunFaults : public ::testing::TestWithParam<Link> {};

TEST_P(RunFaults, EveryFaultAloneAndAllTogetherLeaveTheResultBitForBit) {
  const std::string clean = clean_result(GetParam(), kFewPoints);
  const nlohmann::json result = testing::parse_json(clean);
  ASSERT_EQ(result.at("points").size(), 200U);
  // All at once, since most of their time is spent in waiting for lost answers.
  std::list<FaultySession> sessions;
  for (const std::string& faults : GetParam() == Link::serial ? kSerialFaults : kModbusFaults) {
    sessions.emplace_back(GetParam(), faults);
  }
  for (FaultySession& session : sessions) {
    SCOPED_TRACE(session.faults);
    EXPECT_EQ(session.run.exit_code(), expected_exit(clean)) << session.run.err();
    EXPECT_NE(session.machine.process().err().find("simulate: fault:"), std::string::npos) << "no fault struck";
    EXPECT_TRUE(read_whole(session.scratch / "result.json") == clean) << "the result differs\n"
                                                                      << session.run.out() << session.run.err();
  }
}

INSTANTIATE_TEST_SUITE_P(Links, RunFaults, ::testing::Values(Link::modbus_tcp, Link::modbus_rtu, Link::serial),
                         [](const auto& tested) {
                           std::string name = name_of(tested.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace bladefit::hil

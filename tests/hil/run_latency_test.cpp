// How long it takes from a record's appearing in the machine's registers to its verdict in the panel's registers.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/hil/session.hpp"

namespace bladefit::hil {
namespace {

/// When each record became readable [ns of CLOCK_MONOTONIC], by sequence - 1.
std::vector<std::int64_t> read_stamps(const std::string& file) {
  std::ifstream stream(file);
  std::vector<std::int64_t> stamps;
  std::uint32_t sequence = 0;
  char comma = 0;
  for (std::int64_t nanoseconds = 0; stream >> sequence >> comma >> nanoseconds;) stamps.push_back(nanoseconds);
  return stamps;
}

TEST(RunLatency, FromTheMachinesRegistersToThePanels) {
  const ScratchFolder scratch;
  SimulatedMachine machine(
      machine_options(Link::modbus_tcp, "0", kAllPoints, {"--rate", "200", "--stamp", scratch / "stamps"}));
  Process run(
      run_options(source_of(Link::modbus_tcp, machine.address()), scratch / "session", scratch / "result.json"));
  const RawPanel panel(panel_port(run));
  // The last sequence and the alarm bits change together; asking without a pause bounds the error by one round trip.
  constexpr std::uint32_t kRecords = 1000;
  std::vector<std::int64_t> seen;
  const Clock::time_point until = Clock::now() + 30s;
  while (seen.size() < kRecords && Clock::now() < until) {
    const std::uint32_t last = panel.number(38);
    if (last > seen.size()) seen.resize(last, Clock::now().time_since_epoch() / 1ns);
    std::this_thread::sleep_for(100us);
  }
  ASSERT_GE(seen.size(), kRecords) << run.err();
  const std::vector<std::int64_t> stamps = read_stamps(scratch / "stamps");
  ASSERT_GE(stamps.size(), seen.size());
  std::vector<double> milliseconds;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    milliseconds.push_back(static_cast<double>(seen[k] - stamps[k]) * 1e-6);
  }
  std::sort(milliseconds.begin(), milliseconds.end());
  const double median = milliseconds[milliseconds.size() / 2];
  fmt::print("record readable to verdict on the panel: median {:.2f} ms, 99 % {:.2f} ms, longest {:.2f} ms\n", median,
             milliseconds[milliseconds.size() * 99 / 100], milliseconds.back());
  EXPECT_GE(milliseconds.front(), 0);
  // Loose, since other tests run beside it: what would be felt at the machine.
  EXPECT_LT(median, 50);
}

}  // namespace
}  // namespace bladefit::hil

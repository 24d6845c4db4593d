// The host from source to result: the same stream gives the same bits, whatever interrupts it.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <bit>
#include <csignal>
#include <mutex>

#include "firmware_bridge/host/journal/journal.hpp"
#include "firmware_bridge/host/journal/journal_reader.hpp"
#include "tests/unit/firmware_bridge/fixtures.hpp"

namespace bladefit {
namespace {

using namespace std::chrono_literals;
using testing::blade;
using testing::blade_config;
using testing::measured_points;
using testing::ScratchFolder;
using testing::ScriptedSource;
using testing::settings_for;

constexpr std::size_t kPoints = 400;

testing::WholeResult run_to_end(const HostSettings& settings, ProbeSource& source) {
  Host host(settings, blade(), source, {});
  const Failure error = host.start();
  if (error) {
    testing::WholeResult failed;
    failed.end = SessionEnd::failed;
    failed.error = error;
    return failed;
  }
  EXPECT_TRUE(host.wait_for_end(60s));
  return testing::finish_whole(host);
}

void expect_same_bits(double left, double right) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(left), std::bit_cast<std::uint64_t>(right));
}

void expect_same_result(const testing::WholeResult& left, const testing::WholeResult& right) {
  for (int entry = 0; entry < 9; ++entry) {
    expect_same_bits(left.report.pose.rotation(entry), right.report.pose.rotation(entry));
  }
  for (int entry = 0; entry < 3; ++entry) {
    expect_same_bits(left.report.pose.translation[entry], right.report.pose.translation[entry]);
  }
  ASSERT_EQ(left.verdicts.size(), right.verdicts.size());
  for (std::size_t index = 0; index < left.verdicts.size(); ++index) {
    EXPECT_EQ(left.verdicts[index].sequence, right.verdicts[index].sequence);
    EXPECT_EQ(left.verdicts[index].state, right.verdicts[index].state);
    expect_same_bits(left.verdicts[index].foot.distance, right.verdicts[index].foot.distance);
    expect_same_bits(left.verdicts[index].foot.u, right.verdicts[index].foot.u);
  }
}

testing::WholeResult clean_session() {
  const ScratchFolder folder;
  ScriptedSource source(measured_points(kPoints), 5);
  return run_to_end(settings_for(folder / "session"), source);
}

TEST(BridgeHost, JudgesEveryPointAcknowledgesItAndConverges) {
  const ScratchFolder folder;
  ScriptedSource source(measured_points(kPoints));
  const testing::WholeResult result = run_to_end(settings_for(folder / "session"), source);
  ASSERT_FALSE(result.error) << result.error.message;
  EXPECT_EQ(result.end, SessionEnd::finished);
  EXPECT_EQ(result.report.status, FitStatus::converged);
  EXPECT_EQ(result.points.size(), kPoints);
  EXPECT_EQ(result.verdicts.size(), kPoints);
  EXPECT_EQ(source.acknowledged, kPoints);
  EXPECT_TRUE(source.closed);
}

TEST(BridgeHost, TheSameStreamInOtherPortionsGivesTheSameBits) {
  const testing::WholeResult clean = clean_session();
  for (const unsigned seed : {1U, 77U, 4000U}) {
    const ScratchFolder folder;
    ScriptedSource source(measured_points(kPoints), seed);
    expect_same_result(run_to_end(settings_for(folder / "session"), source), clean);
  }
}

TEST(BridgeHost, AResumedSessionEndsWithTheSameBits) {
  const testing::WholeResult clean = clean_session();
  const ScratchFolder folder;
  HostSettings settings = settings_for(folder / "session");
  for (const std::size_t cut : {3U, 150U, 151U, 399U}) {
    settings.idle = 150ms;
    ScriptedSource source(measured_points(kPoints));
    source.stop_after = cut;
    const testing::WholeResult partial = run_to_end(settings, source);
    EXPECT_EQ(partial.end, SessionEnd::idle);
    EXPECT_EQ(partial.points.size(), cut);
    EXPECT_EQ(source.acknowledged, cut);
  }
  settings.idle = 0ms;
  ScriptedSource rest(measured_points(kPoints));
  expect_same_result(run_to_end(settings, rest), clean);
  EXPECT_EQ(rest.opened_after, 399U);
  ScriptedSource nothing_new(measured_points(kPoints));
  expect_same_result(run_to_end(settings, nothing_new), clean);
  EXPECT_EQ(nothing_new.opened_after, kPoints);
}

TEST(BridgeHost, AJournalTornAnywhereEndsWithTheSameBits) {
  const testing::WholeResult clean = clean_session();
  const ScratchFolder folder;
  const HostSettings settings = settings_for(folder / "session");
  {
    ScriptedSource source(measured_points(kPoints));
    ASSERT_FALSE(run_to_end(settings, source).error);
  }
  const std::string whole = testing::read_whole(journal_path(settings.session_directory));
  for (const std::size_t size : {std::size_t{10}, sizeof(JournalHeader), sizeof(JournalHeader) + 40, whole.size() / 2,
                                 whole.size() - 80, whole.size() - 1}) {
    testing::write_whole(journal_path(settings.session_directory), whole.substr(0, size));
    ScriptedSource source(measured_points(kPoints));
    expect_same_result(run_to_end(settings, source), clean);
    EXPECT_EQ(testing::read_whole(journal_path(settings.session_directory)).size(), whole.size()) << size;
  }
}

TEST(BridgeHost, RefusesASessionOfOtherSettings) {
  const ScratchFolder folder;
  const HostSettings settings = settings_for(folder / "session");
  ScriptedSource source(measured_points(50));
  ASSERT_FALSE(run_to_end(settings, source).error);
  HostSettings other = settings;
  other.localizer.tolerance.leading_edge_mm = 0.11;
  ScriptedSource again(measured_points(50));
  EXPECT_EQ(run_to_end(other, again).error.kind, Failure::Kind::bad_input);
}

/// Two runs; 0 is one like any other.
struct RunChange {
  std::uint32_t from, to;
};

class BridgeHostRuns : public ::testing::TestWithParam<RunChange> {};

INSTANTIATE_TEST_SUITE_P(All, BridgeHostRuns, ::testing::Values(RunChange{7, 9}, RunChange{0, 7}, RunChange{4, 0}));

TEST_P(BridgeHostRuns, ASessionOfAnotherRunIsRefused) {
  const ScratchFolder folder;
  const HostSettings settings = settings_for(folder / "session");
  ScriptedSource source(measured_points(50));
  source.run_id = GetParam().from;
  ASSERT_FALSE(run_to_end(settings, source).error);
  ScriptedSource another_run(measured_points(50));
  another_run.run_id = GetParam().to;
  const testing::WholeResult refused = run_to_end(settings, another_run);
  EXPECT_EQ(refused.error.kind, Failure::Kind::bad_input);
  const std::string told = "run " + std::to_string(GetParam().to);
  EXPECT_NE(refused.error.message.find(told), std::string::npos) << refused.error.message;
}

TEST_P(BridgeHostRuns, ARunThatRestartsItsNumbersIsAFault) {
  const ScratchFolder folder;
  ScriptedSource source(measured_points(50));
  source.stop_after = 20;
  source.run_id = GetParam().from;
  source.later_run_id = GetParam().to;
  const testing::WholeResult result = run_to_end(settings_for(folder / "session"), source);
  EXPECT_EQ(result.error.kind, Failure::Kind::device);
  const std::string told = "started run " + std::to_string(GetParam().to);
  EXPECT_NE(result.error.message.find(told), std::string::npos) << result.error.message;
  EXPECT_EQ(result.points.size(), 20U);
}

TEST(BridgeHost, ASourceThatCannotBeOpenedLeavesNothingBehind) {
  const ScratchFolder folder;
  ScriptedSource source(measured_points(10));
  source.refusal = "the cable is out; put it in";
  const testing::WholeResult result = run_to_end(settings_for(folder / "session"), source);
  EXPECT_EQ(result.error.kind, Failure::Kind::device);
  EXPECT_EQ(result.error.message, source.refusal);
  EXPECT_EQ(result.end, SessionEnd::failed);
}

TEST(BridgeHost, AFullDiskIsAFaultAndNothingUnstoredIsAcknowledged) {
  const ScratchFolder folder;
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  // Room for a whole group of records at least, however they are grouped.
  constexpr std::uint32_t kRoom = kJournalGroup + 10;
  const rlimit small{sizeof(JournalHeader) + kRoom * sizeof(JournalRecord) + 30, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  ScriptedSource source(measured_points(kPoints));
  const HostSettings settings = settings_for(folder / "session");
  const testing::WholeResult result = run_to_end(settings, source);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(result.end, SessionEnd::failed);
  EXPECT_EQ(result.error.kind, Failure::Kind::device);
  EXPECT_NE(result.error.message.find("journal.bin"), std::string::npos);
  EXPECT_LE(source.acknowledged, kRoom);
  EXPECT_GE(result.points.size(), source.acknowledged);
  ASSERT_GT(result.points.size(), 0U);
  ScriptedSource stored(measured_points(result.points.size()));
  expect_same_result(result, run_to_end(settings_for(folder / "stored"), stored));
  ScriptedSource rest(measured_points(kPoints));
  expect_same_result(run_to_end(settings, rest), clean_session());
}

TEST(BridgeHost, ARecordThatIsNoNumberIsRefusedAndTheRestIsUnchanged) {
  std::vector<ProbePoint> points = measured_points(60);
  points[30].position[1] = std::numeric_limits<double>::quiet_NaN();
  const ScratchFolder folder;
  ScriptedSource source(points);
  const testing::WholeResult result = run_to_end(settings_for(folder / "session"), source);
  EXPECT_EQ(result.refused, std::vector<std::uint32_t>{31});
  EXPECT_EQ(result.points.size(), 59U);
}

TEST(BridgeHost, StopsWhenAskedWithAFullResult) {
  const ScratchFolder folder;
  ScriptedSource source(measured_points(50));
  source.stop_after = 20;
  Host host(settings_for(folder / "session"), blade(), source, {});
  ASSERT_FALSE(host.start());
  EXPECT_FALSE(host.wait_for_end(200ms));
  host.request_stop();
  ASSERT_TRUE(host.wait_for_end(10s));
  const testing::WholeResult result = testing::finish_whole(host);
  EXPECT_EQ(result.end, SessionEnd::stopped);
  EXPECT_EQ(result.verdicts.size(), 20U);
}

}  // namespace
}  // namespace bladefit

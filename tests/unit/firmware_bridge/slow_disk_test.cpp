// A disk that stalls: verdicts go on, the stall is told, nothing is acknowledged before it is on disk.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

#include "firmware_bridge/host/journal/disk_watch.hpp"
#include "firmware_bridge/host/journal/journal.hpp"
#include "tests/unit/firmware_bridge/fixtures.hpp"

namespace bladefit {
namespace {

using namespace std::chrono_literals;

std::atomic<bool> disk_stalls{false};
std::atomic<std::int64_t> durable_bytes{0};  ///< of the file that was synchronised last

}  // namespace
}  // namespace bladefit

/// In place of the system's: waits as long as the disk stalls, and notes what is on disk when it returns.
extern "C" int fdatasync(int descriptor) {
  struct stat file {};
  const bool known = fstat(descriptor, &file) == 0;
  while (bladefit::disk_stalls.load()) std::this_thread::sleep_for(std::chrono::milliseconds{2});
  const int result = fsync(descriptor);
  if (known && result == 0) bladefit::durable_bytes.store(file.st_size);
  return result;
}

namespace bladefit {
namespace {

/// Stalls the disk at its third portion of points, and counts what is acknowledged ahead of the disk.
class SuspiciousSource : public testing::ScriptedSource {
 public:
  using ScriptedSource::ScriptedSource;

  [[nodiscard]] std::size_t poll(std::span<ProbePoint> points, std::chrono::milliseconds timeout) override {
    if (++polls_ == 3) disk_stalls.store(true);
    return ScriptedSource::poll(points, timeout);
  }

  void acknowledge(std::uint32_t sequence) override {
    const std::int64_t records = (durable_bytes.load() - static_cast<std::int64_t>(sizeof(JournalHeader))) /
                                 static_cast<std::int64_t>(sizeof(JournalRecord));
    if (static_cast<std::int64_t>(sequence) > records) ++too_early;
    newest = sequence;
    ScriptedSource::acknowledge(sequence);
  }

  int too_early = 0;
  std::atomic<std::uint32_t> newest{0};

 private:
  int polls_ = 0;
};

template <typename Condition>
bool becomes_true(Condition condition) {
  const auto until = std::chrono::steady_clock::now() + 30s;
  while (!condition() && std::chrono::steady_clock::now() < until) std::this_thread::sleep_for(2ms);
  return condition();
}

TEST(SlowDisk, VerdictsGoOnAndNothingIsAcknowledgedAheadOfIt) {
  constexpr std::uint32_t kCount = 300;
  const testing::ScratchFolder folder;
  SuspiciousSource source(testing::measured_points(kCount));
  std::mutex mutex;
  std::vector<std::string> notices;
  const auto told = [&](const std::string& words) {
    const std::scoped_lock lock(mutex);
    return std::ranges::count_if(notices, [&](const std::string& n) { return n.find(words) != std::string::npos; });
  };
  Host host(testing::settings_for(folder / "session"), testing::blade(), source, [&](const std::string& notice) {
    const std::scoped_lock lock(mutex);
    notices.push_back(notice);
  });
  ASSERT_EQ(host.start().message, "");
  const bool judged = becomes_true([&] { return host.panel_state().last_sequence == kCount; });
  const bool said = becomes_true([&] { return told("has stored nothing for 1 s") == 1; });
  const std::uint32_t newest_while_stalled = source.newest.load();
  disk_stalls.store(false);
  EXPECT_TRUE(judged) << "all points are judged while the disk stalls";
  EXPECT_TRUE(said);
  EXPECT_LT(newest_while_stalled, kCount);
  EXPECT_TRUE(host.wait_for_end(60s));
  const testing::WholeResult result = testing::finish_whole(host);
  EXPECT_EQ(result.error.message, "");
  EXPECT_EQ(source.newest.load(), kCount);
  EXPECT_EQ(source.too_early, 0);
  EXPECT_EQ(told("has stored nothing for"), 1);
  EXPECT_EQ(told("the disk stores points again"), 1);
}

TEST(DiskWatch, TellsOnceAStallAndOnceItsEnd) {
  DiskWatch watch("s");
  const DiskWatch::Clock::time_point start{};
  EXPECT_EQ(watch.look(0, 0, start), "");
  EXPECT_EQ(watch.look(0, 0, start + 5s), "") << "nothing waits";
  EXPECT_EQ(watch.look(3, 0, start + 6s), "");
  EXPECT_EQ(watch.look(4, 1, start + 6900ms), "");
  EXPECT_EQ(watch.look(4, 1, start + 7800ms), "") << "something was stored in between";
  EXPECT_NE(watch.look(9, 1, start + 7900ms).find("s: the disk has stored nothing for 1 s"), std::string::npos);
  EXPECT_EQ(watch.look(9, 1, start + 9s), "");
  EXPECT_EQ(watch.look(9, 9, start + 9500ms), "s: the disk stores points again");
  EXPECT_EQ(watch.look(9, 9, start + 20s), "");
}

}  // namespace
}  // namespace bladefit

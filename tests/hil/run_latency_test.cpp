// How long it takes from a record's appearing in the machine's registers to its verdict in the panel's registers.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>

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

/// A client of the panel that asks for all of its registers without a pause, from a thread of its own.
class BusyClient {
 public:
  explicit BusyClient(int port) : client_(RawModbus::tcp(port)), thread_([this] { ask(); }) {}
  ~BusyClient() { stop(); }
  BusyClient(const BusyClient&) = delete;
  BusyClient& operator=(const BusyClient&) = delete;

  void stop() {
    over_ = true;
    if (thread_.joinable()) thread_.join();
  }
  [[nodiscard]] int answers() const { return answers_; }

 private:
  void ask() {
    while (!over_) answers_ += client_.inputs(0, 92).empty() ? 0 : 1;
  }

  std::atomic<bool> over_{false};
  std::atomic<int> answers_{0};
  RawModbus client_;
  std::thread thread_;
};

/// What came of a session with so many busy clients.
struct Watched {
  std::vector<double> milliseconds;     ///< from readable record to verdict on the panel, rising
  std::vector<int> answers;             ///< to each busy client
  std::chrono::milliseconds lasted{0};  ///< that the clients asked

  [[nodiscard]] double quantile(double part) const {
    return milliseconds[static_cast<std::size_t>(part * static_cast<double>(milliseconds.size() - 1))];
  }
};

/// By sequence - 1, when the panel told a verdict that is not older [ns of CLOCK_MONOTONIC]. The last sequence and the
/// alarm bits change together; asking without a pause bounds the error by one round trip.
std::vector<std::int64_t> watch(const RawPanel& panel, std::uint32_t records) {
  std::vector<std::int64_t> seen;
  const Clock::time_point until = Clock::now() + 30s;
  while (seen.size() < records && Clock::now() < until) {
    const std::uint32_t last = panel.number(38);
    if (last > seen.size()) seen.resize(last, Clock::now().time_since_epoch() / 1ns);
    std::this_thread::sleep_for(100us);
  }
  return seen;
}

Watched watched_session(std::size_t busy_clients) {
  const ScratchFolder scratch;
  SimulatedMachine machine(
      machine_options(Link::modbus_tcp, "0", kAllPoints, {"--rate", "200", "--stamp", scratch / "stamps"}));
  Process run(
      run_options(source_of(Link::modbus_tcp, machine.address()), scratch / "session", scratch / "result.json"));
  const int port = panel_port(run);
  const RawPanel panel(port);
  Watched watched;
  const Clock::time_point begin = Clock::now();
  std::vector<std::unique_ptr<BusyClient>> clients;
  for (std::size_t k = 0; k < busy_clients; ++k) clients.push_back(std::make_unique<BusyClient>(port));
  constexpr std::uint32_t kRecords = 1000;
  const std::vector<std::int64_t> seen = watch(panel, kRecords);
  for (const auto& client : clients) client->stop();
  watched.lasted = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - begin);
  for (const auto& client : clients) watched.answers.push_back(client->answers());
  const std::vector<std::int64_t> stamps = read_stamps(scratch / "stamps");
  if (seen.size() < kRecords || stamps.size() < seen.size())
    throw std::runtime_error("records are missing: " + run.err());
  for (std::size_t k = 0; k < seen.size(); ++k)
    watched.milliseconds.push_back(static_cast<double>(seen[k] - stamps[k]) * 1e-6);
  std::ranges::sort(watched.milliseconds);
  fmt::print(
      "record readable to verdict on the panel, {} busy clients: median {:.2f} ms, 99 % {:.2f} ms, longest {:.2f} ms\n",
      busy_clients, watched.quantile(0.5), watched.quantile(0.99), watched.milliseconds.back());
  return watched;
}

TEST(RunLatency, FromTheMachinesRegistersToThePanelsWhateverOthersAsk) {
  const Watched alone = watched_session(0);
  const Watched busy = watched_session(8);
  EXPECT_GE(alone.milliseconds.front(), 0);
  EXPECT_GE(busy.milliseconds.front(), 0);
  // Clients get a turn every two milliseconds, however often they ask: the processor is left to the stream.
  for (const int answers : busy.answers) {
    EXPECT_GT(answers, 0);
    EXPECT_LE(answers, busy.lasted / 2ms + 1);
  }
  // Both ran on the same machine, as busy with other things. A stream that waits for clients is many times slower.
  constexpr double kRound_ms = 4;  // of the one that watches
  EXPECT_LT(busy.quantile(0.5), 10 * (alone.quantile(0.5) + kRound_ms));
}

}  // namespace
}  // namespace bladefit::hil

// The panel over real sockets, read by libmodbus, with clients that behave badly.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <modbus.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <atomic>
#include <cerrno>
#include <memory>
#include <thread>

#include "firmware_bridge/host/panel/panel_address.hpp"
#include "firmware_bridge/host/panel/panel_server.hpp"
#include "firmware_bridge/host/threads/wakeup.hpp"
#include "tests/support/panel_state.hpp"

namespace bladefit {
namespace {

using testing::known_state;
using namespace std::chrono_literals;

/// A server in a thread of its own, with the known state.
class ServedPanel {
 public:
  explicit ServedPanel(PanelServerSettings settings = {.port = 0}) {
    error_ = server_.open(settings);
    if (error_) return;
    thread_ = std::thread([this] {
      const PanelImage image = encode_panel(known_state(), {});
      while (!stop_.load()) {
        server_.serve(image, [this](const PanelCommands& commands) {
          if (commands.acknowledge) acknowledged_.fetch_add(1);
        });
        server_.wait(wakeup_.descriptor(), 50ms);
      }
    });
  }
  ~ServedPanel() {
    stop_.store(true);
    wakeup_.signal();
    if (thread_.joinable()) thread_.join();
  }
  [[nodiscard]] const Failure& error() const { return error_; }
  [[nodiscard]] std::uint16_t port() const { return server_.port(); }
  [[nodiscard]] int acknowledged() const { return acknowledged_.load(); }

 private:
  PanelServer server_;
  Wakeup wakeup_;
  Failure error_;
  std::atomic<bool> stop_{false};
  std::atomic<int> acknowledged_{0};
  std::thread thread_;
};

struct ContextCloser {
  void operator()(modbus_t* context) const {
    modbus_close(context);
    modbus_free(context);
  }
};
using Context = std::unique_ptr<modbus_t, ContextCloser>;

Context connected(std::uint16_t port, int unit = 1) {
  Context context(modbus_new_tcp("127.0.0.1", port));
  modbus_set_response_timeout(context.get(), 2, 0);
  modbus_set_slave(context.get(), unit);
  return modbus_connect(context.get()) == 0 ? std::move(context) : nullptr;
}

bool reads_the_map(modbus_t* context) {
  const PanelImage expected = encode_panel(known_state(), {});
  constexpr int kBlade = kBladeBase, kRegisters = 120;
  for (int first = 0; first < kBlade + static_cast<int>(kBladeRegisters); first += kRegisters) {
    if (first == static_cast<int>(kPanelMapRegisters)) first = kBlade;
    std::array<std::uint16_t, kRegisters> registers{}, holdings{};
    if (modbus_read_input_registers(context, first, kRegisters, registers.data()) != kRegisters) return false;
    if (modbus_read_registers(context, first, kRegisters, holdings.data()) != kRegisters) return false;
    const auto wanted = std::span(expected.registers).subspan(static_cast<std::size_t>(first), kRegisters);
    if (!std::ranges::equal(registers, wanted) || registers != holdings) return false;
  }
  return true;
}

int raw_connection(std::uint16_t port) {
  const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
  EXPECT_EQ(connect(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  return descriptor;
}

TEST(BridgePanelServer, GivesEveryRegisterToLibmodbus) {
  const ServedPanel panel;
  ASSERT_FALSE(panel.error()) << panel.error().message;
  const Context context = connected(panel.port());
  ASSERT_TRUE(context);
  EXPECT_TRUE(reads_the_map(context.get()));
  std::array<std::uint8_t, 16> inputs{};
  ASSERT_EQ(modbus_read_input_bits(context.get(), 0, 16, inputs.data()), 16);
  EXPECT_EQ(inputs, (std::array<std::uint8_t, 16>{1, 1, 1, 1}));
  std::uint16_t word = 0;
  EXPECT_EQ(modbus_read_input_registers(context.get(), 600, 1, &word), -1);
  EXPECT_EQ(errno, EMBXILADD);
  EXPECT_TRUE(reads_the_map(context.get())) << "an exception must not break the connection";
}

TEST(BridgePanelServer, RefusesCoilsUnlessCommandsAreEnabled) {
  const ServedPanel refusing;
  const Context context = connected(refusing.port());
  EXPECT_EQ(modbus_write_bit(context.get(), 3, 1), -1);
  EXPECT_EQ(errno, EMBXILFUN);
  EXPECT_EQ(modbus_write_register(context.get(), 0, 1), -1);
  EXPECT_EQ(errno, EMBXILFUN);
  EXPECT_EQ(refusing.acknowledged(), 0);

  const ServedPanel obeying({.port = 0, .commands = true});
  const Context commander = connected(obeying.port());
  EXPECT_EQ(modbus_write_bit(commander.get(), 3, 1), 1);
  EXPECT_EQ(obeying.acknowledged(), 1);
  const std::array<std::uint8_t, 4> none{};
  EXPECT_EQ(modbus_write_bits(commander.get(), 0, 4, none.data()), 4);
  EXPECT_EQ(obeying.acknowledged(), 1);
}

TEST(BridgePanelServer, AnswersSeveralClientsAndEveryUnit) {
  const ServedPanel panel;
  std::vector<Context> contexts;
  for (int client = 0; client < 8; ++client) contexts.push_back(connected(panel.port()));
  for (int round = 0; round < 20; ++round) {
    for (const Context& context : contexts) ASSERT_TRUE(reads_the_map(context.get()));
  }
  for (const int unit : {0, 17, 247, 255}) EXPECT_TRUE(reads_the_map(connected(panel.port(), unit).get())) << unit;
}

TEST(BridgePanelServer, ARawFrameIsAnsweredAsTheUnitThatWasAsked) {
  const ServedPanel panel;
  for (int unit = 0; unit < 256; ++unit) {
    const int line = raw_connection(panel.port());
    const auto byte = static_cast<std::uint8_t>(unit);
    const std::array<std::uint8_t, 12> request = {0x12, byte, 0, 0, 0, 6, byte, 3, 0x01, 0x1D, 0, 2};
    ASSERT_EQ(send(line, request.data(), request.size(), 0), 12);
    std::array<std::uint8_t, 13> reply{};
    ASSERT_EQ(recv(line, reply.data(), reply.size(), MSG_WAITALL), 13);
    EXPECT_EQ(reply, (std::array<std::uint8_t, 13>{0x12, byte, 0, 0, 0, 7, byte, 3, 4, 0x12, 0x34, 0x56, 0x78}));
    close(line);
  }
}

TEST(BridgePanelServer, StuckAndFloodingClientsDoNotHinderOthers) {
  const ServedPanel panel;
  const int half = raw_connection(panel.port());
  const std::array<std::uint8_t, 8> half_request = {0, 1, 0, 0, 0, 6, 1, 4};
  ASSERT_EQ(send(half, half_request.data(), half_request.size(), 0), 8);
  const int foreign = raw_connection(panel.port());
  ASSERT_GT(send(foreign, "GET / HTTP/1.0\r\n\r\n", 18, MSG_NOSIGNAL), 0);
  std::atomic<bool> stop{false};
  // Asks without end and never takes an answer.
  const int flood = raw_connection(panel.port());
  std::thread flooding([&stop, flood] {
    const std::array<std::uint8_t, 12> request = {0, 1, 0, 0, 0, 6, 1, 4, 0, 0, 0, 92};
    while (!stop.load()) {
      if (send(flood, request.data(), request.size(), MSG_NOSIGNAL | MSG_DONTWAIT) < 0)
        std::this_thread::sleep_for(1ms);
    }
  });
  const Context context = connected(panel.port());
  ASSERT_TRUE(context);
  std::this_thread::sleep_for(100ms);
  // Each of these fails where its answer takes longer than the half second that libmodbus waits.
  for (int round = 0; round < 200; ++round) ASSERT_TRUE(reads_the_map(context.get()));
  stop.store(true);
  flooding.join();
  for (const int descriptor : {half, foreign, flood}) close(descriptor);
}

TEST(BridgePanelServer, TheClientThatIsSilentForLongestMakesRoomForAnotherOfItsAddress) {
  const ServedPanel panel;
  std::vector<Context> contexts;
  for (std::size_t client = 0; client < PanelServer::kMostOfAnAddress; ++client) {
    contexts.push_back(connected(panel.port()));
    ASSERT_TRUE(reads_the_map(contexts.back().get()));
  }
  ASSERT_TRUE(reads_the_map(contexts.front().get()));
  const Context extra = connected(panel.port());
  ASSERT_TRUE(extra);
  EXPECT_TRUE(reads_the_map(extra.get()));
  EXPECT_FALSE(reads_the_map(contexts[1].get())) << "it has been silent for longest";
  EXPECT_TRUE(reads_the_map(contexts.front().get()));
  EXPECT_TRUE(reads_the_map(contexts.back().get()));
}

TEST(BridgePanelServer, ManyPoliteClientsDoNotLockTheOperatorOut) {
  const ServedPanel panel;
  std::atomic<bool> stop{false};
  std::thread crowd([&] {
    std::vector<Context> contexts(PanelServer::kMostOfAnAddress);
    while (!stop.load()) {
      for (Context& context : contexts) {
        if (!context) context = connected(panel.port());
        if (context && !reads_the_map(context.get())) context.reset();
      }
    }
  });
  std::this_thread::sleep_for(100ms);
  const Context operators = connected(panel.port());
  ASSERT_TRUE(operators);
  int read = 0;
  for (int round = 0; round < 20; ++round) {
    read += reads_the_map(operators.get()) ? 1 : 0;
    std::this_thread::sleep_for(5ms);
  }
  EXPECT_EQ(read, 20);
  stop.store(true);
  crowd.join();
}

TEST(BridgePanelServer, LetsInOnlyWhoIsOnTheList) {
  const ServedPanel closed({.port = 0, .allow = {"192.0.2.1"}});
  const Context refused = connected(closed.port());
  EXPECT_TRUE(!refused || !reads_the_map(refused.get()));
  const ServedPanel open({.port = 0, .allow = {"192.0.2.1", "127.0.0.1"}});
  EXPECT_TRUE(reads_the_map(connected(open.port()).get()));
}

TEST(BridgePanelServer, NamesAPortInUseAndAnAddressThatIsNone) {
  const ServedPanel first;
  const ServedPanel second({.port = first.port()});
  EXPECT_EQ(second.error().kind, Failure::Kind::device);
  EXPECT_NE(second.error().message.find(std::to_string(first.port())), std::string::npos);
  const ServedPanel nowhere({.host = "no.such.host.invalid", .port = 0});
  EXPECT_EQ(nowhere.error().kind, Failure::Kind::bad_input);
}

TEST(BridgePanelAddress, IsHostAndPort) {
  std::string host = "before";
  std::uint16_t port = 9;
  for (const char* bad :
       {"", "127.0.0.1", ":1503", "host:", "host:x", "host:65536", "host:-1", "::1:1503", "host:1 "}) {
    EXPECT_FALSE(parse_address(bad, host, port)) << bad;
  }
  EXPECT_EQ(host, "before");
  EXPECT_TRUE(parse_address("localhost:0", host, port));
  EXPECT_EQ(host, "localhost");
  EXPECT_EQ(port, 0);
  EXPECT_TRUE(parse_address("[::1]:1503", host, port));
  EXPECT_EQ(host, "::1");
}

}  // namespace
}  // namespace bladefit

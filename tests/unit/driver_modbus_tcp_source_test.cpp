#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <thread>

#include "drivers/make_source.hpp"
#include "tests/unit/driver_modbus_machine.hpp"

namespace bladefit {
namespace {

using std::chrono::milliseconds;

/// A machine on 127.0.0.1 in a thread of its own, one client at a time.
class TcpMachine {
 public:
  TcpMachine() {
    listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    ::listen(listener_, 4);
    socklen_t length = sizeof address;
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &length);
    port = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }

  ~TcpMachine() {
    stop_ = true;
    thread_.join();
    ::close(listener_);
  }

  [[nodiscard]] SourceSettings settings() const {
    SourceSettings settings;
    settings.kind = SourceKind::modbus_tcp;
    settings.tcp = {"127.0.0.1", port};
    settings.modbus.reply_timeout = milliseconds(100);
    return settings;
  }

  Registers registers;
  std::uint16_t port = 0;
  std::atomic<Mischief> mischief = Mischief::none;  ///< with the next reply only
  std::atomic<bool> dumb = false;                   ///< no reply at all

 private:
  static bool readable(int descriptor) {
    pollfd entry{descriptor, POLLIN, 0};
    return ::poll(&entry, 1, 5) > 0;
  }

  void serve() {
    while (!stop_) {
      if (!readable(listener_)) continue;
      const int client = ::accept(listener_, nullptr, nullptr);
      while (!stop_ && (!readable(client) || serve_one(client))) {
      }
      ::close(client);
    }
  }

  bool serve_one(int client) {
    Bytes frame(260);
    const ssize_t size = ::recv(client, frame.data(), frame.size(), 0);
    if (size < 12) return false;
    frame.resize(static_cast<std::size_t>(size));
    const Bytes pdu = registers.answer({frame.begin() + 7, frame.end()});
    Bytes reply(frame.begin(), frame.begin() + 7);
    reply[5] = static_cast<std::uint8_t>(pdu.size() + 1);
    reply.insert(reply.end(), pdu.begin(), pdu.end());
    if (dumb) return true;
    switch (mischief.exchange(Mischief::none)) {
      case Mischief::silent:
        return true;
      case Mischief::hang_up:
        return false;
      case Mischief::late:
        std::this_thread::sleep_for(milliseconds(150));
        break;
      case Mischief::foreign_first: {
        Bytes foreign = reply;
        ++foreign[1];
        ::send(client, foreign.data(), foreign.size(), MSG_NOSIGNAL);
        break;
      }
      case Mischief::wrong_length:
        reply[5] = 200;
        break;
      case Mischief::noise_first:
      case Mischief::none:
        break;
    }
    return ::send(client, reply.data(), reply.size(), MSG_NOSIGNAL) > 0;
  }

  int listener_ = -1;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

TEST(ModbusTcp, StartsDeliversAcknowledgesAndStops) {
  TcpMachine machine;
  machine.registers.probe(3);
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0, 0).message, "");
  EXPECT_EQ(machine.registers.holding(2), 1);
  EXPECT_EQ(source->status().run_id, 5U);
  EXPECT_EQ(collect_checked(*source, 3), counted(1, 3));
  machine.registers.probe(15);
  EXPECT_EQ(collect_checked(*source, 12), counted(4, 15));
  source->acknowledge(15);
  std::array<ProbePoint, 4> points;
  EXPECT_EQ(source->poll(points, milliseconds(10)), 0U);
  EXPECT_EQ(machine.registers.holding(1), 15);
  machine.registers.set(1, 16);
  EXPECT_EQ(source->poll(points, milliseconds(30)), 0U);
  EXPECT_TRUE(source->status().finished);
  source->close();
  EXPECT_EQ(machine.registers.holding(2), 2);
}

TEST(ModbusTcp, GoesOnBehindWhatIsStored) {
  TcpMachine machine;
  machine.registers.probe(9);
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(7, 0).message, "");
  EXPECT_EQ(machine.registers.holding(1), 7);
  EXPECT_EQ(machine.registers.holding(2), 0) << "a device that is probing is left alone";
  EXPECT_EQ(collect_checked(*source, 2), counted(8, 9));
}

TEST(ModbusTcp, SurvivesEveryMischief) {
  TcpMachine machine;
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0, 0).message, "");
  std::uint32_t newest = 0;
  for (const Mischief mischief :
       {Mischief::silent, Mischief::late, Mischief::foreign_first, Mischief::hang_up, Mischief::wrong_length}) {
    for (int round = 0; round < 2; ++round) {
      machine.mischief = mischief;
      machine.registers.probe(newest + 2);
      EXPECT_EQ(collect_checked(*source, 2), counted(newest + 1, newest + 2)) << static_cast<int>(mischief);
      newest += 2;
      source->acknowledge(newest);
    }
  }
  EXPECT_EQ(source->status().reconnects, 4U) << source->status().last_fault;
  EXPECT_EQ(source->status().losses, 0U);
}

TEST(ModbusTcp, GivesUpADeadConnectionAndTellsSo) {
  TcpMachine machine;
  SourceSettings settings = machine.settings();
  settings.modbus.reply_timeout = milliseconds(20);
  const auto source = make_source(settings);
  ASSERT_EQ(source->open(0, 0).message, "");
  machine.dumb = true;
  EXPECT_EQ(collect_checked(*source, 1).size(), 0U);
  EXPECT_EQ(source->status().link, LinkState::lost);
  expect_answers_again(machine, *source);
  EXPECT_GT(source->status().reconnects, 0U);
}

TEST(ModbusTcp, PollReturnsInTimeWhateverTheDeviceDoes) {
  TcpMachine machine;
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0, 0).message, "");
  machine.dumb = true;
  std::array<ProbePoint, 4> points;
  for (int call = 0; call < 20; ++call) {
    const auto before = std::chrono::steady_clock::now();
    static_cast<void>(source->poll(points, milliseconds(10)));
    EXPECT_LT(std::chrono::steady_clock::now() - before, milliseconds(60));
  }
}

TEST(ModbusTcp, ReportsLostRecords) {
  TcpMachine machine;
  machine.registers.probe(20);
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0, 0).message, "");
  EXPECT_EQ(collect_checked(*source, 16), counted(5, 20));
  EXPECT_GT(source->status().losses, 0U);
}

/// Nothing of the run that the device is in is stored: it is not told so, and its program is not stopped.
TEST(ModbusTcp, LeavesADeviceInAnotherRunAlone) {
  TcpMachine machine;
  machine.registers.probe(9);
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(7, 4).message, "");
  EXPECT_EQ(source->status().run_id, 5U);
  source->acknowledge(7);
  source->close();
  EXPECT_EQ(machine.registers.holding(1), 0);
  EXPECT_EQ(machine.registers.holding(2), 0);
}

TEST(ModbusTcp, StopsAtAnotherRun) {
  TcpMachine machine;
  machine.registers.probe(2);
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0, 0).message, "");
  EXPECT_EQ(collect_checked(*source, 2), counted(1, 2));
  machine.registers.set(7, 6);
  std::array<ProbePoint, 4> points;
  EXPECT_EQ(source->poll(points, milliseconds(50)), 0U);
  EXPECT_EQ(source->status().run_id, 6U);
  EXPECT_NE(source->status().last_fault.find("another run"), std::string::npos);
  source->acknowledge(2);
  source->close();
  EXPECT_EQ(machine.registers.holding(1), 0) << "none of the other run's records is stored";
  EXPECT_EQ(machine.registers.holding(2), 1);
}

TEST(ModbusTcpErrors, NameTheDeviceAndTheMend) {
  TcpMachine machine;
  const auto opened = [&machine](const SourceSettings& settings) { return make_source(settings)->open(0, 0).message; };
  const std::string name = "modbus-tcp://127.0.0.1:" + std::to_string(machine.port) + ": ";
  machine.registers.set(0, 2);
  EXPECT_EQ(opened(machine.settings()),
            name + "it has register map version 2, not 1; give a device file that describes its map");
  machine.registers.set(0, 1);
  SourceSettings swapped = machine.settings();
  swapped.modbus.map.test_constant.address = 8;
  for (const auto& [address, word] : {std::pair{8, 0x3958}, {9, 0xC8B4}, {10, 0x1CD6}, {11, 0x40C8}}) {
    machine.registers.set(static_cast<std::size_t>(address), static_cast<std::uint16_t>(word));
  }
  EXPECT_NE(opened(swapped).find("set word_order = \"low_first\""), std::string::npos);
  SourceSettings elsewhere = machine.settings();
  elsewhere.modbus.map.newest.address = 999;
  elsewhere.modbus.map.version.present = elsewhere.modbus.map.status.present = elsewhere.modbus.map.capacity.present =
      false;
  elsewhere.modbus.map.record_size_told.present = elsewhere.modbus.map.run_id.present = false;
  elsewhere.modbus.map.test_constant.present = false;
  elsewhere.modbus.map.ring_capacity = 16;
  EXPECT_NE(opened(elsewhere).find("the device refuses function 4 at register 999: Illegal data address"),
            std::string::npos);
  machine.dumb = true;
  SourceSettings mute = machine.settings();
  mute.modbus.reply_timeout = milliseconds(20);
  EXPECT_NE(opened(mute).find("unit 1 does not answer"), std::string::npos);
  SourceSettings unknown = machine.settings();
  unknown.tcp.host = "no.such.host.invalid";
  EXPECT_NE(opened(unknown).find("the host is not known"), std::string::npos);
}

TEST(ModbusTcpErrors, NameARefusedConnection) {
  SourceSettings settings;
  {
    const TcpMachine machine;
    settings = machine.settings();
  }
  EXPECT_NE(make_source(settings)->open(0, 0).message.find("connection refused; switch on"), std::string::npos);
}

}  // namespace
}  // namespace bladefit

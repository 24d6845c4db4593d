#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <modbus.h>
#include <poll.h>
#include <pty.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <bit>
#include <mutex>
#include <thread>
#include <vector>

#include "drivers/crc16.hpp"
#include "drivers/make_source.hpp"

namespace bladefit {
namespace {

using std::chrono::milliseconds;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kCapacity = 16;

std::uint16_t word_at(const Bytes& bytes, std::size_t at) {
  return static_cast<std::uint16_t>((bytes[at] << 8U) | bytes[at + 1]);
}

void put_double(std::span<std::uint16_t> words, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (std::size_t word = 0; word < 4; ++word) words[word] = static_cast<std::uint16_t>(bits >> (48U - 16U * word));
}

/// The registers of a machine with map v1, and answers to requests without their envelope.
class Registers {
 public:
  Registers() {
    inputs_[0] = 1;
    inputs_[1] = 2;
    inputs_[4] = kCapacity;
    inputs_[5] = 20;
    inputs_[7] = 5;
    put_double(std::span(inputs_).subspan(8, 4), 12345.678);
  }

  void set(std::size_t address, std::uint16_t value) {
    const std::lock_guard lock(mutex_);
    inputs_[address] = value;
  }

  [[nodiscard]] std::uint16_t holding(std::size_t address) {
    const std::lock_guard lock(mutex_);
    return holdings_[address];
  }

  /// Puts the records up to `newest` into the ring.
  void probe(std::uint32_t newest) {
    const std::lock_guard lock(mutex_);
    for (std::uint32_t sequence = inputs_[3] + 1U; sequence <= newest; ++sequence) {
      const std::span<std::uint16_t> record = std::span(inputs_).subspan(100 + (sequence - 1) % kCapacity * 20, 20);
      record[1] = static_cast<std::uint16_t>(sequence);
      put_double(record.subspan(2, 4), sequence);
      record[19] = crc16(std::span<const std::uint16_t>(record.first(19)));
    }
    inputs_[3] = static_cast<std::uint16_t>(newest);
  }

  Bytes answer(const Bytes& pdu) {
    const std::lock_guard lock(mutex_);
    const std::uint16_t address = word_at(pdu, 1);
    const std::uint16_t count = word_at(pdu, 3);
    if (pdu[0] == 4) {
      if (address + count > inputs_.size()) return {0x84, 2};
      Bytes reply = {4, static_cast<std::uint8_t>(2 * count)};
      for (std::size_t index = 0; index < count; ++index) {
        reply.push_back(static_cast<std::uint8_t>(inputs_[address + index] >> 8U));
        reply.push_back(static_cast<std::uint8_t>(inputs_[address + index] & 0xFFU));
      }
      return reply;
    }
    if (pdu[0] == 6) holdings_[address] = count;
    for (std::size_t index = 0; pdu[0] == 16 && index < count; ++index)
      holdings_[address + index] = word_at(pdu, 6 + 2 * index);
    return {pdu.begin(), pdu.begin() + 5};
  }

 private:
  std::mutex mutex_;
  std::array<std::uint16_t, 100 + kCapacity * 20> inputs_{};
  std::array<std::uint16_t, 8> holdings_{};
};

/// What a server does with the next replies.
enum class Mischief : std::uint8_t { none, silent, late, foreign_first, hang_up, noise_first, wrong_length };

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

/// A machine on a pseudo terminal in a thread of its own.
class RtuMachine {
 public:
  RtuMachine() {
    std::array<char, 128> name{};
    ::openpty(&master_, &slave_, name.data(), nullptr, nullptr);
    termios raw{};
    ::tcgetattr(slave_, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(slave_, TCSANOW, &raw);
    device = name.data();
    thread_ = std::thread([this] { serve(); });
  }

  ~RtuMachine() {
    stop_ = true;
    thread_.join();
    ::close(slave_);
    if (master_ >= 0) ::close(master_);
  }

  [[nodiscard]] SourceSettings settings() const {
    SourceSettings settings;
    settings.kind = SourceKind::modbus_rtu;
    settings.line.device = device;
    settings.modbus.reply_timeout = milliseconds(100);
    settings.modbus.quiet = milliseconds(100);
    return settings;
  }

  Registers registers;
  std::string device;
  std::atomic<Mischief> mischief = Mischief::none;
  std::atomic<bool> dumb = false;
  std::atomic<bool> echo = false;

 private:
  void send(Bytes frame) const {
    const std::uint16_t crc = crc16({reinterpret_cast<const char*>(frame.data()), frame.size()});
    frame.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
    frame.push_back(static_cast<std::uint8_t>(crc >> 8U));
    ASSERT_EQ(::write(master_, frame.data(), frame.size()), static_cast<ssize_t>(frame.size()));
  }

  void serve() {
    while (!stop_) {
      pollfd entry{master_, POLLIN, 0};
      if (::poll(&entry, 1, 5) <= 0) continue;
      Bytes frame(260);
      const ssize_t size = ::read(master_, frame.data(), frame.size());
      if (size < 8 || dumb) continue;
      frame.resize(static_cast<std::size_t>(size));
      if (echo) {
        ASSERT_EQ(::write(master_, frame.data(), frame.size()), size);
      }
      Bytes reply = {frame[0]};
      const Bytes pdu = registers.answer({frame.begin() + 1, frame.end() - 2});
      reply.insert(reply.end(), pdu.begin(), pdu.end());
      switch (mischief.exchange(Mischief::none)) {
        case Mischief::silent:
        case Mischief::hang_up:
        case Mischief::wrong_length:
          continue;
        case Mischief::late:
          std::this_thread::sleep_for(milliseconds(150));
          break;
        case Mischief::foreign_first: {
          Bytes foreign = reply;
          ++foreign[0];
          send(foreign);
          std::this_thread::sleep_for(milliseconds(5));
          break;
        }
        case Mischief::noise_first:
          ASSERT_EQ(::write(master_, "\x7f", 1), 1);
          break;
        case Mischief::none:
          break;
      }
      send(reply);
    }
  }

  int master_ = -1, slave_ = -1;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

/// Sequences that come within two seconds, until `count` are there.
std::vector<std::uint32_t> collect(ProbeSource& source, std::size_t count) {
  std::vector<std::uint32_t> sequences;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  std::array<ProbePoint, 5> points;
  while (sequences.size() < count && std::chrono::steady_clock::now() < deadline) {
    const std::size_t came = source.poll(points, milliseconds(20));
    for (std::size_t index = 0; index < came; ++index) {
      EXPECT_EQ(points[index].position[0], points[index].sequence);
      sequences.push_back(points[index].sequence);
    }
  }
  return sequences;
}

std::vector<std::uint32_t> counted(std::uint32_t first, std::uint32_t last) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t number = first; number <= last; ++number) numbers.push_back(number);
  return numbers;
}

TEST(ModbusTcp, StartsDeliversAcknowledgesAndStops) {
  TcpMachine machine;
  machine.registers.probe(3);
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0).message, "");
  EXPECT_EQ(machine.registers.holding(2), 1);
  EXPECT_EQ(source->status().run_id, 5U);
  EXPECT_EQ(collect(*source, 3), counted(1, 3));
  machine.registers.probe(15);
  EXPECT_EQ(collect(*source, 12), counted(4, 15));
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
  ASSERT_EQ(source->open(7).message, "");
  EXPECT_EQ(machine.registers.holding(1), 7);
  EXPECT_EQ(machine.registers.holding(2), 0) << "a device that is probing is left alone";
  EXPECT_EQ(collect(*source, 2), counted(8, 9));
}

TEST(ModbusTcp, SurvivesEveryMischief) {
  TcpMachine machine;
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0).message, "");
  std::uint32_t newest = 0;
  for (const Mischief mischief :
       {Mischief::silent, Mischief::late, Mischief::foreign_first, Mischief::hang_up, Mischief::wrong_length}) {
    for (int round = 0; round < 2; ++round) {
      machine.mischief = mischief;
      machine.registers.probe(newest + 2);
      EXPECT_EQ(collect(*source, 2), counted(newest + 1, newest + 2)) << static_cast<int>(mischief);
      newest += 2;
      source->acknowledge(newest);
    }
  }
  EXPECT_EQ(source->status().reconnects, 4U) << source->status().last_fault;
  EXPECT_FALSE(source->status().gap);
}

TEST(ModbusTcp, GivesUpADeadConnectionAndTellsSo) {
  TcpMachine machine;
  SourceSettings settings = machine.settings();
  settings.modbus.reply_timeout = milliseconds(20);
  const auto source = make_source(settings);
  ASSERT_EQ(source->open(0).message, "");
  machine.dumb = true;
  EXPECT_EQ(collect(*source, 1).size(), 0U);
  EXPECT_EQ(source->status().link, LinkState::lost);
  machine.dumb = false;
  machine.registers.probe(1);
  EXPECT_EQ(collect(*source, 1), counted(1, 1));
  EXPECT_EQ(source->status().link, LinkState::up);
  EXPECT_GT(source->status().reconnects, 0U);
}

TEST(ModbusTcp, PollReturnsInTimeWhateverTheDeviceDoes) {
  TcpMachine machine;
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0).message, "");
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
  ASSERT_EQ(source->open(0).message, "");
  EXPECT_EQ(collect(*source, 16), counted(5, 20));
  EXPECT_TRUE(source->status().gap);
}

TEST(ModbusTcp, StopsAtAnotherRun) {
  TcpMachine machine;
  machine.registers.probe(2);
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0).message, "");
  EXPECT_EQ(collect(*source, 2), counted(1, 2));
  machine.registers.set(7, 6);
  std::array<ProbePoint, 4> points;
  EXPECT_EQ(source->poll(points, milliseconds(50)), 0U);
  EXPECT_EQ(source->status().run_id, 6U);
  EXPECT_NE(source->status().last_fault.find("another run"), std::string::npos);
}

TEST(ModbusTcpErrors, NameTheDeviceAndTheMend) {
  TcpMachine machine;
  const auto opened = [&machine](const SourceSettings& settings) { return make_source(settings)->open(0).message; };
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
  EXPECT_NE(make_source(settings)->open(0).message.find("connection refused; switch on"), std::string::npos);
}

TEST(ModbusRtu, DeliversAndSurvivesEveryMischief) {
  RtuMachine machine;
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0).message, "");
  std::uint32_t newest = 0;
  for (const Mischief mischief :
       {Mischief::none, Mischief::silent, Mischief::late, Mischief::foreign_first, Mischief::noise_first}) {
    machine.mischief = mischief;
    machine.registers.probe(newest + 3);
    EXPECT_EQ(collect(*source, 3), counted(newest + 1, newest + 3)) << static_cast<int>(mischief);
    newest += 3;
    source->acknowledge(newest);
  }
  EXPECT_EQ(source->status().reconnects, 0U) << "a silent unit is no dead port";
  source->close();
  EXPECT_EQ(machine.registers.holding(1), 15);
}

TEST(ModbusRtu, TakesItsEchoOut) {
  RtuMachine machine;
  machine.echo = true;
  machine.registers.probe(2);
  SourceSettings settings = machine.settings();
  settings.modbus.echo = true;
  const auto source = make_source(settings);
  ASSERT_EQ(source->open(0).message, "");
  EXPECT_EQ(collect(*source, 2), counted(1, 2));
}

TEST(ModbusRtu, ToleratesASilenceWithoutReopening) {
  RtuMachine machine;
  SourceSettings settings = machine.settings();
  settings.modbus.reply_timeout = milliseconds(30);
  settings.modbus.quiet = milliseconds(10);
  const auto source = make_source(settings);
  ASSERT_EQ(source->open(0).message, "");
  machine.dumb = true;
  std::array<ProbePoint, 4> points;
  static_cast<void>(source->poll(points, milliseconds(300)));
  EXPECT_EQ(source->status().link, LinkState::lost);
  machine.dumb = false;
  machine.registers.probe(1);
  EXPECT_EQ(collect(*source, 1), counted(1, 1));
  EXPECT_EQ(source->status().link, LinkState::up);
  EXPECT_EQ(source->status().reconnects, 0U);
}

TEST(ModbusRtuErrors, NameTheDeviceAndTheMend) {
  RtuMachine machine;
  const auto opened = [](const SourceSettings& settings) { return make_source(settings)->open(0).message; };
  SourceSettings slow = machine.settings();
  slow.line.baud = 9600;
  EXPECT_NE(opened(slow).find("a reply timeout of 100 ms is too short: request and reply take 264 ms at 9600 baud"),
            std::string::npos)
      << opened(slow);
  slow.line.baud = 9601;
  EXPECT_NE(opened(slow).find("9601 baud is no standard rate"), std::string::npos);
  SourceSettings missing = machine.settings();
  missing.line.device = "/dev/nonexistent";
  EXPECT_NE(opened(missing).find("modbus-rtu:/dev/nonexistent: there is no such port"), std::string::npos);
  missing.line.device = "/dev/null";
  EXPECT_NE(opened(missing).find("this is no serial port"), std::string::npos);
  const auto first = make_source(machine.settings());
  ASSERT_EQ(first->open(0).message, "");
  EXPECT_NE(opened(machine.settings()).find("the port is busy"), std::string::npos);
  first->close();
  EXPECT_EQ(opened(machine.settings()), "");
}

}  // namespace
}  // namespace bladefit

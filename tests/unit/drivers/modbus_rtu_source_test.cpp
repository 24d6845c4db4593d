#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <thread>

#include "drivers/make_source.hpp"
#include "tests/unit/drivers/modbus_machine.hpp"
#include "tests/unit/drivers/raw_terminal.hpp"

namespace bladefit {
namespace {

using std::chrono::milliseconds;

/// A machine on a pseudo terminal in a thread of its own.
class RtuMachine {
 public:
  RtuMachine() {
    device = open_raw_terminal(master_, slave_);
    thread_ = std::thread([this] { serve(); });
  }

  ~RtuMachine() {
    stop_ = true;
    thread_.join();
    ::close(slave_);
    if (master_ >= 0) ::close(master_);
  }

  [[nodiscard]] ModbusSettings settings() const {
    ModbusSettings settings;
    settings.transport = ModbusTransport::rtu;
    settings.line.device = device;
    settings.reply_timeout = milliseconds(100);
    settings.quiet = milliseconds(100);
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

TEST(ModbusRtu, DeliversAndSurvivesEveryMischief) {
  RtuMachine machine;
  const auto source = make_source(machine.settings());
  ASSERT_EQ(source->open(0, 0).message, "");
  std::uint32_t newest = 0;
  for (const Mischief mischief :
       {Mischief::none, Mischief::silent, Mischief::late, Mischief::foreign_first, Mischief::noise_first}) {
    machine.mischief = mischief;
    machine.registers.probe(newest + 3);
    EXPECT_EQ(collect_checked(*source, 3), counted(newest + 1, newest + 3)) << static_cast<int>(mischief);
    newest += 3;
    source->acknowledge(newest);
  }
  EXPECT_EQ(source->status().reconnects, 0U) << "a silent unit is not a dead port";
  source->close();
  EXPECT_EQ(machine.registers.holding(1), 15);
}

TEST(ModbusRtu, TakesItsEchoOut) {
  RtuMachine machine;
  machine.echo = true;
  machine.registers.probe(2);
  ModbusSettings settings = machine.settings();
  settings.echo = true;
  const auto source = make_source(settings);
  ASSERT_EQ(source->open(0, 0).message, "");
  EXPECT_EQ(collect_checked(*source, 2), counted(1, 2));
}

TEST(ModbusRtu, ToleratesASilenceWithoutReopening) {
  RtuMachine machine;
  ModbusSettings settings = machine.settings();
  settings.reply_timeout = milliseconds(30);
  settings.quiet = milliseconds(10);
  const auto source = make_source(settings);
  ASSERT_EQ(source->open(0, 0).message, "");
  machine.dumb = true;
  std::array<ProbePoint, 4> points;
  static_cast<void>(source->poll(points, milliseconds(300)));
  EXPECT_EQ(source->status().link, LinkState::lost);
  expect_answers_again(machine, *source);
  EXPECT_EQ(source->status().reconnects, 0U);
}

/// The pause between two frames alone is longer than a poll period: the header and a refused write are always due.
TEST(ModbusRtu, ReadsRecordsOnASlowLine) {
  RtuMachine machine;
  ModbusSettings settings = machine.settings();
  settings.line.baud = 9600;
  settings.reply_timeout = milliseconds(600);
  settings.poll_period = std::chrono::microseconds(100);
  const auto source = make_source(settings);
  ASSERT_EQ(source->open(0, 0).message, "");
  machine.registers.probe(9);
  EXPECT_EQ(collect_checked(*source, 9), counted(1, 9));
  machine.registers.refuse(16, 6, 100000);
  source->acknowledge(9);
  machine.registers.probe(16);
  EXPECT_EQ(collect_checked(*source, 7), counted(10, 16));
}

TEST(ModbusRtuErrors, NameTheDeviceAndTheFix) {
  RtuMachine machine;
  const auto opened = [](const ModbusSettings& settings) { return make_source(settings)->open(0, 0).message; };
  ModbusSettings slow = machine.settings();
  slow.line.baud = 9600;
  EXPECT_NE(opened(slow).find("a reply timeout of 100 ms is too short: request and reply take 264 ms at 9600 baud"),
            std::string::npos)
      << opened(slow);
  slow.line.baud = 9601;
  EXPECT_NE(opened(slow).find("9601 baud is not a standard rate"), std::string::npos);
  ModbusSettings missing = machine.settings();
  missing.line.device = "/dev/nonexistent";
  EXPECT_NE(opened(missing).find("modbus-rtu:/dev/nonexistent: there is no such port"), std::string::npos);
  missing.line.device = "/dev/null";
  EXPECT_NE(opened(missing).find("this is not a serial port"), std::string::npos);
  const auto first = make_source(machine.settings());
  ASSERT_EQ(first->open(0, 0).message, "");
  EXPECT_NE(opened(machine.settings()).find("the port is busy"), std::string::npos);
  first->close();
  EXPECT_EQ(opened(machine.settings()), "");
}

}  // namespace
}  // namespace bladefit

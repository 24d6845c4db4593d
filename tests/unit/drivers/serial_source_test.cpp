#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "drivers/make_source.hpp"
#include "drivers/serial/serial_message.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/drivers/collecting.hpp"
#include "tests/unit/drivers/raw_terminal.hpp"

namespace bladefit {
namespace {

using std::chrono::milliseconds;

/// The machine's end of a pseudo terminal, with a link to the host's end that stays when it is plugged in again.
class Cable {
  testing::ScratchFolder folder_;

 public:
  Cable() { plug_in(); }
  ~Cable() { pull(); }

  void plug_in() { std::filesystem::create_symlink(open_raw_terminal(machine_, host_), device); }

  void pull() {
    if (machine_ < 0) return;
    std::filesystem::remove(device);
    ::close(machine_);
    ::close(host_);
    machine_ = host_ = -1;
  }

  void write(const std::string& text) const {
    ASSERT_EQ(::write(machine_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }

  /// What the host has sent.
  [[nodiscard]] std::string read() const {
    std::string text;
    pollfd entry{machine_, POLLIN, 0};
    std::array<char, 512> bytes{};
    while (::poll(&entry, 1, 20) > 0) {
      const ssize_t count = ::read(machine_, bytes.data(), bytes.size());
      if (count <= 0) break;
      text.append(bytes.data(), static_cast<std::size_t>(count));
    }
    return text;
  }

  const std::string device = folder_ / "port";

 private:
  int machine_ = -1, host_ = -1;
};

std::string point_line(int sequence) { return encode_line("PT," + std::to_string(sequence) + ",1.25,2,3,0,0,1,9"); }

SerialSettings serial_settings(const Cable& cable) {
  SerialSettings settings;
  settings.line.device = cable.device;
  settings.start_interval = milliseconds(50);
  settings.open_timeout = milliseconds(300);
  settings.reconnect_first = milliseconds(10);
  return settings;
}

/// Opens while the machine, which is in run 3, answers the start.
std::string open_answered(ProbeSource& source, const Cable& cable, std::uint32_t after = 0, std::uint32_t run_id = 0) {
  std::thread machine([&cable] {
    std::this_thread::sleep_for(milliseconds(20));
    cable.write(encode_line("RUN,3"));
  });
  std::string message = source.open(after, run_id).message;
  machine.join();
  return message;
}

TEST(SerialSource, TalksWithTheMachine) {
  const Cable cable;
  const auto source = make_source(serial_settings(cable));
  ASSERT_EQ(open_answered(*source, cable), "");
  EXPECT_EQ(cable.read().find("$START,1*"), 0U);
  EXPECT_EQ(source->status().run_id, 3U);
  cable.write(point_line(1) + "noise\x80\n" + point_line(2) + point_line(4));
  EXPECT_EQ(collect(*source, 2), (Sequences{1, 2}));
  source->acknowledge(2);
  EXPECT_EQ(collect(*source, 1, milliseconds(20)), Sequences{});
  const std::string sent = cable.read();
  EXPECT_NE(sent.find("$NAK,3*"), std::string::npos) << sent;
  EXPECT_NE(sent.find("$ACK,2*"), std::string::npos) << sent;
  cable.write(point_line(3) + encode_line("END,4"));
  EXPECT_EQ(collect(*source, 2), (Sequences{3, 4}));
  static_cast<void>(collect(*source, 1, milliseconds(20)));
  EXPECT_TRUE(source->status().finished);
  source->acknowledge(4);
  std::thread machine([&cable] {
    const std::string last = cable.read();
    EXPECT_NE(last.find("$ACK,4*"), std::string::npos) << last;
    EXPECT_NE(last.find("$STOP*BC64"), std::string::npos) << last;
  });
  source->close();
  machine.join();
}

/// Nothing of the run that the device is in is stored: it is not told so, and its program is not stopped.
TEST(SerialSource, LeavesADeviceInAnotherRunAlone) {
  const Cable cable;
  const auto source = make_source(serial_settings(cable));
  ASSERT_EQ(open_answered(*source, cable, 30, 0), "");
  EXPECT_EQ(source->status().run_id, 3U);
  source->acknowledge(30);
  source->close();
  const std::string sent = cable.read();
  EXPECT_EQ(sent.find("$ACK"), std::string::npos) << sent;
  EXPECT_EQ(sent.find("$STOP"), std::string::npos) << sent;
}

TEST(SerialSource, ComesBackAfterTheCableWasPulled) {
  Cable cable;
  const auto source = make_source(serial_settings(cable));
  ASSERT_EQ(open_answered(*source, cable), "");
  cable.write(point_line(1));
  EXPECT_EQ(collect(*source, 1), (Sequences{1}));
  cable.pull();
  static_cast<void>(collect(*source, 1, milliseconds(60)));
  EXPECT_EQ(source->status().link, LinkState::lost);
  cable.plug_in();
  std::thread machine([&cable] {
    std::this_thread::sleep_for(milliseconds(200));
    cable.write(encode_line("RUN,3") + point_line(1) + point_line(2));
  });
  EXPECT_EQ(collect(*source, 1), (Sequences{2}));
  machine.join();
  EXPECT_EQ(source->status().link, LinkState::up);
  EXPECT_EQ(source->status().reconnects, 1U);
}

TEST(SerialSource, TakesItsEchoOut) {
  const Cable cable;
  SerialSettings settings = serial_settings(cable);
  settings.echo = true;
  const auto source = make_source(settings);
  std::thread machine([&cable] {
    std::this_thread::sleep_for(milliseconds(20));
    cable.write(encode_line("START,1") + encode_line("RUN,3") + point_line(1));
  });
  EXPECT_EQ(source->open(0, 0).message, "");
  machine.join();
  EXPECT_EQ(collect(*source, 1), (Sequences{1}));
  EXPECT_EQ(source->status().damaged, 0U) << source->status().last_fault;
}

TEST(SerialSourceErrors, NameTheDeviceAndTheFix) {
  const Cable cable;
  const SerialSettings settings = serial_settings(cable);
  const auto opened = [](const SerialSettings& wanted) { return make_source(wanted)->open(0, 0).message; };
  const std::string mute = opened(settings);
  EXPECT_EQ(mute,
            "serial:" + cable.device + ": the device does not answer $START; switch it on, or correct baud and parity");
  SerialSettings other = settings;
  other.line.device = "/dev/nonexistent";
  EXPECT_NE(opened(other).find("serial:/dev/nonexistent: there is no such port"), std::string::npos);
  other.line.device = "/tmp";
  EXPECT_NE(opened(other).find("this is not a serial port"), std::string::npos) << opened(other);
  other = settings;
  other.line.baud = 12345;
  EXPECT_NE(opened(other).find("12345 baud is not a standard rate"), std::string::npos);
  const auto first = make_source(settings);
  ASSERT_EQ(open_answered(*first, cable), "");
  EXPECT_NE(opened(settings).find("the port is busy: another program uses it"), std::string::npos);
}

DroSettings dro_settings(const Cable& cable) {
  DroSettings settings;
  settings.line.device = cable.device;
  settings.reconnect_first = milliseconds(10);
  return settings;
}

TEST(DroSource, NumbersItsPoints) {
  Cable cable;
  const auto source = make_source(dro_settings(cable));
  ASSERT_EQ(source->open(5, 0).message, "");
  cable.write("0.5 Z 1.0\r\nX 1.0 Y 2.0 Z 3.0\r\n# note\r\nX 1.0 Y 2.0 Z 4.0\n\r");
  EXPECT_EQ(collect(*source, 2), (Sequences{6, 7}));
  EXPECT_EQ(source->status().damaged, 1U);
  EXPECT_EQ(source->status().losses, 0U) << "the first line may have been cut when the port was opened";
  EXPECT_EQ(source->status().remarks.size(), 1U) << "but it is told of";
  cable.write("X 1.0 Y ? Z 4.0\nX 1.0 Y 2.0 Z 5.0\n" + std::string(400, 'X') + "\n");
  EXPECT_EQ(collect(*source, 1), (Sequences{8}));
  const std::uint64_t losses = source->status().losses;
  EXPECT_GT(losses, 0U);
  EXPECT_NE(source->status().last_fault.find("probe the point again"), std::string::npos);
  cable.pull();
  static_cast<void>(collect(*source, 1, milliseconds(50)));
  EXPECT_EQ(source->status().losses, losses + 1);
  EXPECT_NE(source->status().last_loss.find("while the port is down"), std::string::npos) << source->status().last_loss;
  EXPECT_EQ(source->status().link, LinkState::lost);
  cable.plug_in();
  static_cast<void>(collect(*source, 1, milliseconds(200)));
  EXPECT_EQ(source->status().link, LinkState::up);
  cable.write("X 1.0 Y 2.0 Z 6.0\n");
  EXPECT_EQ(collect(*source, 1), (Sequences{9}));
}

TEST(DroSource, GathersLinesOfOneAxisThatEndWithCarriageReturnAlone) {
  const Cable cable;
  const auto source = make_source(dro_settings(cable));
  ASSERT_EQ(source->open(0, 0).message, "");
  cable.write(
      "4.5149 R\rX=+   7.8702 R\rY=-   3.9861 R\rZ=+  17.5149 R\rX=+   8.8702 R\rY=-   4.9861 R\rZ=+   8.5149 R\r");
  const std::vector<ProbePoint> points = collect_points(*source, 2);
  ASSERT_EQ(points.size(), 2U) << source->status().last_fault;
  EXPECT_EQ(points[0].position, (std::array<double, 3>{7.8702, -3.9861, 17.5149}));
  EXPECT_EQ(points[1].position, (std::array<double, 3>{8.8702, -4.9861, 8.5149}));
  EXPECT_EQ(source->status().losses, 0U);
}

TEST(DroSource, AFirstLineWithoutItsBeginningIsALoss) {
  const Cable cable;
  DroSettings settings = dro_settings(cable);
  settings.labels = false;
  const auto source = make_source(settings);
  ASSERT_EQ(source->open(0, 0).message, "");
  cable.write("7.8702 3.9861 7.5149\n34.9271 3.9698 4.7101\n");
  EXPECT_EQ(collect_points(*source, 1).at(0).position[0], 34.9271);
  EXPECT_EQ(source->status().losses, 1U);
  EXPECT_NE(source->status().last_loss.find("the beginning may be missing"), std::string::npos);
}

TEST(DroSource, AFirstLineThatCameOutOfSilenceIsWhole) {
  const Cable cable;
  DroSettings settings = dro_settings(cable);
  settings.labels = false;
  const auto source = make_source(settings);
  ASSERT_EQ(source->open(0, 0).message, "");
  static_cast<void>(collect(*source, 1, milliseconds(150)));
  cable.write("7.8702 3.9861 7.5149\n");
  EXPECT_EQ(collect_points(*source, 1).size(), 1U) << source->status().last_fault;
}

TEST(DroSource, ALineWithoutAnEndIsALoss) {
  const Cable cable;
  const auto source = make_source(dro_settings(cable));
  ASSERT_EQ(source->open(0, 0).message, "");
  cable.write("X 1.0 Y 2.0 Z 3.0\nX 1.0 Y 2.0 Z 4.0");
  EXPECT_EQ(collect(*source, 2, milliseconds(2500)), (Sequences{1}));
  EXPECT_EQ(source->status().losses, 1U);
  EXPECT_NE(source->status().last_loss.find("no end of the line came"), std::string::npos);
  cable.write("\nX 1.0 Y 2.0 Z 5.0\n");
  EXPECT_EQ(collect(*source, 1), (Sequences{2}));
}

TEST(ReplaySource, DeliversTheFileAndFinishes) {
  ReplaySettings settings;
  settings.file = BLADEFIT_TEST_DATA "/dtmb4119/subsets/050.csv";
  const auto source = make_source(settings);
  ASSERT_EQ(source->open(0, 0).message, "");
  const std::uint32_t run = source->status().run_id;
  EXPECT_NE(run, 0U);
  EXPECT_EQ(collect(*source, 50).back(), 50U);
  EXPECT_TRUE(source->status().finished);
  ASSERT_EQ(source->open(48, 0).message, "");
  EXPECT_EQ(collect(*source, 2), (Sequences{49, 50}));
  EXPECT_EQ(source->status().run_id, run);
  EXPECT_NE(source->open(51, 0).message.find("has 50 points, but the session already holds 51"), std::string::npos);
  settings.file = "/nonexistent.csv";
  EXPECT_NE(make_source(settings)->open(0, 0).message.find("/nonexistent.csv: no such file"), std::string::npos);
}

}  // namespace
}  // namespace bladefit

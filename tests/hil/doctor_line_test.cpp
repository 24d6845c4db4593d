// `bladefit doctor` on serial lines: what it makes of the lines of a talking device, and that it sends nothing.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <termios.h>

#include <atomic>
#include <functional>
#include <thread>

#include "tests/hil/doctor.hpp"

namespace bladefit::hil {
namespace {

/// A device on a pseudo terminal that sends a line every 10 ms, whoever listens.
class TalkingDevice {
 public:
  /// `line` makes the n-th line, from the rate that the listener has set.
  explicit TalkingDevice(std::function<std::string(std::size_t n, speed_t rate)> line)
      : master_(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) throw std::runtime_error("no pseudo terminal");
    std::array<char, 128> name{};
    ptsname_r(master_, name.data(), name.size());
    path_ = name.data();
    own_end_ = open(path_.c_str(), O_RDWR | O_NOCTTY);  // so that the line does not hang up between listeners
    termios settings{};
    tcgetattr(own_end_, &settings);
    cfmakeraw(&settings);
    tcsetattr(own_end_, TCSANOW, &settings);
    thread_ = std::thread([this, line = std::move(line)] { talk(line); });
  }
  ~TalkingDevice() {
    stop_ = true;
    thread_.join();
    close(own_end_);
    close(master_);
  }
  TalkingDevice(const TalkingDevice&) = delete;
  TalkingDevice& operator=(const TalkingDevice&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::size_t received() const { return received_; }

 private:
  void talk(const std::function<std::string(std::size_t, speed_t)>& line) {
    for (std::size_t n = 0; !stop_; ++n) {
      termios settings{};
      tcgetattr(own_end_, &settings);
      const std::string text = line(n, cfgetospeed(&settings));
      (void)!write(master_, text.data(), text.size());
      std::array<char, 64> sent{};
      const ssize_t count = read(master_, sent.data(), sent.size());
      if (count > 0) received_ += static_cast<std::size_t>(count);
      std::this_thread::sleep_for(10ms);
    }
  }

  int master_, own_end_ = -1;
  std::string path_;
  std::atomic<bool> stop_ = false;
  std::atomic<std::size_t> received_ = 0;
  std::thread thread_;
};

const std::vector<RawPoint>& blade_points() {
  static const std::vector<RawPoint> points = read_raw_points(kFewPoints);
  return points;
}

const RawPoint& nth_point(std::size_t n) { return blade_points()[n % blade_points().size()]; }

/// A line of serial protocol v1, its lengths multiplied by `factor`.
std::string protocol_line(std::size_t n, double factor = 1) {
  const RawPoint& point = nth_point(n);
  return framed(fmt::format("PT,{},{:.6f},{:.6f},{:.6f},0,0,0,1", n + 1, factor * point.position[0],
                            factor * point.position[1], factor * point.position[2]));
}

std::string with_comma(std::string line) {
  std::replace(line.begin(), line.end(), '.', ',');
  return line;
}

/// A line of a read-out in millimetres, divided by `unit`.
std::string readout_line(std::size_t n, double unit = 1) {
  const RawPoint& point = nth_point(n);
  return fmt::format("X {:+011.5f} Y {:+011.5f} Z {:+011.5f}\r\n", point.position[0] / unit, point.position[1] / unit,
                     point.position[2] / unit);
}

Doctor examine_line(const TalkingDevice& device, const std::string& kind, const std::string& more = "") {
  const ScratchFolder scratch;
  const std::string bits = kind == "dro" ? "data_bits = 8\nparity = \"none\"\n" : "";
  const std::string file = scratch.write(
      "machine.toml",
      fmt::format("kind = \"{}\"\n[line]\ndevice = \"{}\"\nbaud = 19200\n{}{}\n", kind, device.path(), bits, more));
  const Doctor doctor = run_doctor({"--config", file, "--design", kBlade, "--timeout", "6"});
  EXPECT_EQ(device.received(), 0U) << "doctor has sent something";
  return doctor;
}

void expect_change(const Doctor& doctor, const std::string& setting) {
  EXPECT_EQ(doctor.exit_code, 2) << doctor.all;
  EXPECT_NE(doctor.first_line.find("write into the device file: " + setting), std::string::npos) << doctor.all;
}

TEST(DoctorLine, AProtocolThatIsSpokenFits) {
  const TalkingDevice device([](std::size_t n, speed_t) { return protocol_line(n); });
  const Doctor doctor = examine_line(device, "serial");
  EXPECT_EQ(doctor.exit_code, 0) << doctor.all;
  EXPECT_NE(doctor.all.find("lines are readable"), std::string::npos) << doctor.all;
  EXPECT_NE(doctor.all.find("'$PT,"), std::string::npos) << doctor.all;
}

TEST(DoctorLine, FindsTheRateOfTheDevice) {
  const TalkingDevice device([](std::size_t n, speed_t rate) {
    return rate == B9600 ? protocol_line(n) : std::string("\xC3\x91~\x81\x1E\xF0\r\x8F\n");
  });
  expect_change(examine_line(device, "serial"), "[line] baud = 9600\n");
}

TEST(DoctorLine, FindsTheParityInTheEighthBit) {
  const TalkingDevice device([](std::size_t n, speed_t) {
    std::string line = protocol_line(n);
    for (char& character : line) {
      if (std::popcount(static_cast<unsigned char>(character)) % 2 != 0)
        character = static_cast<char>(character | 0x80);
    }
    return line;
  });
  expect_change(examine_line(device, "serial"), "[line] data_bits = 7 and parity = \"even\"\n");
}

TEST(DoctorLine, TellsALengthThatTheProtocolDoesNotHave) {
  const TalkingDevice device([](std::size_t n, speed_t) { return protocol_line(n, 1000); });
  expect_change(examine_line(device, "serial"), "the device's lengths are to be multiplied by 0.001");
}

TEST(DoctorLine, TakesAReadOutForOne) {
  const TalkingDevice device([](std::size_t n, speed_t) { return readout_line(n); });
  expect_change(examine_line(device, "serial"), "kind = \"dro\"\n");
  EXPECT_EQ(examine_line(device, "dro", "[dro]\nlabels = true").exit_code, 0);
  expect_change(examine_line(device, "dro", "[dro]\nlabels = false"), "[dro] labels = true\n");
  expect_change(examine_line(device, "dro", "[dro]\nunits = \"in\""), "[dro] units = \"mm\"\n");
}

TEST(DoctorLine, FindsTheDecimalMark) {
  const TalkingDevice device([](std::size_t n, speed_t) { return with_comma(readout_line(n)); });
  expect_change(examine_line(device, "dro"), "[dro] decimal_mark = \",\"\n");
}

TEST(DoctorLine, FindsInches) {
  const TalkingDevice device([](std::size_t n, speed_t) { return readout_line(n, 25.4); });
  expect_change(examine_line(device, "dro"), "[dro] units = \"in\"\n");
}

TEST(DoctorLine, TakesAProtocolForOneThatIsSpokenInPlaceOfAReadOut) {
  const TalkingDevice device([](std::size_t n, speed_t) { return protocol_line(n); });
  expect_change(examine_line(device, "dro"), "kind = \"serial\"\n");
}

TEST(DoctorLine, NoiseIsNotDecided) {
  const TalkingDevice device([](std::size_t n, speed_t) { return fmt::format("\x01\x7F{}?\r\n", n); });
  const Doctor doctor = examine_line(device, "serial");
  EXPECT_EQ(doctor.exit_code, 4) << doctor.all;
  EXPECT_NE(doctor.first_line.find("no rate, parity or format that was tried"), std::string::npos) << doctor.all;
}

TEST(DoctorLine, ASimulatedMachineIsNotStarted) {
  const ScratchFolder scratch;
  SimulatedMachine machine({"--points", kFewPoints, "--transport", "serial", "--device", scratch / "cmm", "--verbose"});
  const Doctor doctor = run_doctor({"--source", "serial:" + (scratch / "cmm"), "--timeout", "2"});
  EXPECT_EQ(doctor.exit_code, 4) << doctor.all;
  EXPECT_NE(doctor.first_line.find("is silent"), std::string::npos) << doctor.all;
  EXPECT_EQ(machine.process().err().find("started"), std::string::npos) << machine.process().err();
}

}  // namespace
}  // namespace bladefit::hil

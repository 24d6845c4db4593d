// `bladefit doctor` against a simulated machine with a register map: which setting of a wrong device file it names, and
// that it changes nothing in the machine.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include "tests/hil/doctor.hpp"

namespace bladefit::hil {
namespace {

/// A machine that has touched 200 points, and device files for it.
class DoctorModbus : public ::testing::Test {
 protected:
  DoctorModbus()
      : machine_({"--points", kFewPoints, "--transport", "modbus-tcp", "--port", "0", "--rate", "0", "--verbose"}),
        reader_(RawModbus::tcp(machine_.port())) {}

  void probe() {
    reader_.command(1);
    ASSERT_TRUE(eventually([&] { return reader_.newest() == 200; }, 10s));
  }

  /// A device file with these lines in [map] and [map.record].
  [[nodiscard]] std::string device(const std::string& map, const std::string& record = "",
                                   const std::string& modbus = "") const {
    return scratch_.write("machine.toml",
                          fmt::format("kind = \"modbus-tcp\"\n[tcp]\nhost = \"127.0.0.1\"\nport = {}\n[modbus]\n{}\n"
                                      "[map]\n{}\n[map.record]\n{}\n",
                                      machine_.port(), modbus, map, record));
  }

  [[nodiscard]] Doctor examine(const std::string& file) const {
    return run_doctor({"--config", file, "--design", kBlade});
  }

  ScratchFolder scratch_;
  SimulatedMachine machine_;
  RawModbus reader_;
};

TEST_F(DoctorModbus, ShowsWhatItReadAndThatTheSettingsFit) {
  probe();
  const Doctor doctor = examine(device(""));
  EXPECT_EQ(doctor.exit_code, 0) << doctor.all;
  EXPECT_NE(doctor.first_line.find("make sense of the device, and its points lie on the design"), std::string::npos);
  for (const char* words : {"the connection is made", "registers 0 to 11 (function 4): 0001 0011", "map version 1",
                            "newest record 200", "ring of 512 records of 20 registers", "test constant 12345.678",
                            "48 of the 48 newest records are good", "points: x ", "design: x "}) {
    EXPECT_NE(doctor.all.find(words), std::string::npos) << words << "\n" << doctor.all;
  }
}

TEST_F(DoctorModbus, ChangesNothingInTheMachine) {
  probe();
  const std::string before = machine_.process().err();
  const std::vector<std::uint16_t> header = reader_.inputs(0, 12);
  ASSERT_EQ(examine(device("")).exit_code, 0);
  ASSERT_EQ(examine(device("table = \"holding\"")).exit_code, 2);
  EXPECT_EQ(reader_.inputs(0, 12), header);
  std::array<std::uint16_t, 3> holding{};
  ASSERT_EQ(modbus_read_registers(reader_.context(), 0, 3, holding.data()), 3);
  EXPECT_EQ(holding, (std::array<std::uint16_t, 3>{0, 0, 0})) << "acknowledged, or a command";
  EXPECT_EQ(machine_.process().err().find("command", before.size()), std::string::npos);
}

/// Lines of a device file that are wrong for this machine, and what is to be written instead.
struct WrongSetting {
  const char* name;
  std::string map, record, expected;
};

constexpr const char* kOneBased =
    "version = { address = 1 }\nstatus = { address = 2 }\nnewest = { address = 3 }\ncapacity = { address = 5 }\n"
    "record_size = { address = 6 }\nrun_id = { address = 7 }\ntest_constant = { address = 9 }\n"
    "acknowledge = { address = 1 }\ncommand = { address = 3 }\n";
constexpr const char* kOneBasedDeclared =
    "address_base = 1\nversion = { address = 2 }\nstatus = { address = 3 }\n"
    "newest = { address = 4 }\ncapacity = { address = 6 }\nrecord_size = { address = 7 }\nrun_id = { address = 8 }\n"
    "test_constant = { address = 10 }\n";
/// A map without anything by which a wrong order or address can be told from the header.
constexpr const char* kBare = "version = false\nrecord_size = false\ntest_constant = false\nrun_id = false\n";

std::string scaled(double factor) {
  std::string text;
  for (std::size_t axis = 0; axis < 3; ++axis)
    text += fmt::format("{} = {{ offset = {}, scale = {} }}\n", "xyz"[axis], 2 + 4 * axis, factor);
  return text;
}

std::string directed(double scale) {
  std::string text;
  for (std::size_t axis = 0; axis < 3; ++axis)
    text += fmt::format("{} = {{ offset = {}, scale = {} }}\n", "ijk"[axis], 14 + axis, scale);
  return text;
}

class DoctorFindings : public DoctorModbus, public ::testing::WithParamInterface<WrongSetting> {};

TEST_P(DoctorFindings, NamesTheSettingToWrite) {
  probe();
  const Doctor doctor = examine(device(GetParam().map, GetParam().record));
  EXPECT_EQ(doctor.exit_code, 2) << doctor.all;
  EXPECT_NE(doctor.first_line.find("write into the device file: " + GetParam().expected), std::string::npos)
      << doctor.all;
}

INSTANTIATE_TEST_SUITE_P(
    WrongSettings, DoctorFindings,
    ::testing::Values(
        WrongSetting{"WordOrder", "word_order = \"low_first\"", "", "[map] word_order = \"high_first\"\n"},
        WrongSetting{"ByteOrder", "byte_order = \"low_first\"", "", "[map] byte_order = \"high_first\"\n"},
        WrongSetting{"ByteOrderOfLong", "byte_order = \"low_first_in_long\"", "",
                     "[map] byte_order = \"high_first\"\n"},
        WrongSetting{"BothOrders", "word_order = \"low_first\"\nbyte_order = \"low_first\"", "",
                     "[map] word_order = \"high_first\" and byte_order = \"high_first\"\n"},
        WrongSetting{"Table", "table = \"holding\"", "", "[map] table = \"input\"\n"},
        WrongSetting{"OneBased", kOneBased, "address = 101", "[map] address_base = 1\n"},
        WrongSetting{"OneBasedTwice", kOneBasedDeclared, "address = 102",
                     "[map] every address lower by one: newest = { address = 3 }\n"},
        WrongSetting{"RecordsOneOff", "", "address = 101", "[map.record] address = 100\n"},
        WrongSetting{"BareWordOrder", std::string(kBare) + "word_order = \"low_first\"", "crc = false",
                     "[map] word_order = \"high_first\"\n"},
        WrongSetting{"BareRecordsOneOff", kBare, "crc = false\naddress = 99", "[map.record] address = 100\n"},
        WrongSetting{"NoCrc", "", "crc = { offset = 17 }\npath = { offset = 19 }", "[map.record] crc = false"},
        WrongSetting{"Micrometres", "", scaled(1000), "[map.record] x: scale = 1, y: scale = 1, z: scale = 1\n"},
        WrongSetting{"Metres", "", scaled(0.001), "[map.record] x: scale = 1, y: scale = 1, z: scale = 1\n"},
        WrongSetting{"Inches", "", scaled(25.4), "[map.record] x: scale = 1, y: scale = 1, z: scale = 1\n"},
        WrongSetting{"PartsOfInches", "", scaled(1 / 25.4), "[map.record] x: scale = 1, y: scale = 1, z: scale = 1\n"},
        WrongSetting{"OrderAndScale", "word_order = \"low_first\"", scaled(25.4),
                     "[map] word_order = \"high_first\"; [map.record] x: scale = 1, y: scale = 1, z: scale = 1\n"},
        WrongSetting{"Directions", "", directed(-1 / 32767.0), "[map.record] i, j, k: the other sign of scale"}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST_F(DoctorModbus, AnotherMapIsNoFindingButNotDecided) {
  SimulatedMachine other({"--points", kFewPoints, "--transport", "modbus-tcp", "--port", "0", "--map-version", "9"});
  const Doctor doctor = run_doctor({"--source", "modbus-tcp://" + other.address(), "--design", kBlade});
  EXPECT_EQ(doctor.exit_code, 4) << doctor.all;
  EXPECT_NE(doctor.all.find("map version 9 (expected 1)"), std::string::npos) << doctor.all;
}

TEST_F(DoctorModbus, WithoutARecordItSaysSoAndStartsNothing) {
  const Doctor doctor = examine(device(""));
  EXPECT_EQ(doctor.exit_code, 4) << doctor.all;
  EXPECT_NE(doctor.first_line.find("no record yet; probe some points"), std::string::npos) << doctor.all;
  EXPECT_EQ(reader_.newest(), 0U);
  const Doctor wrong = examine(device("word_order = \"low_first\""));
  EXPECT_EQ(wrong.exit_code, 2) << wrong.all;
  EXPECT_NE(wrong.first_line.find("word_order = \"high_first\"; then: the device has no record"), std::string::npos)
      << wrong.all;
}

TEST_F(DoctorModbus, WithoutADesignTheScaleIsUnproven) {
  probe();
  const Doctor doctor = run_doctor({"--config", device("", scaled(1000))});
  EXPECT_EQ(doctor.exit_code, 4) << doctor.all;
  EXPECT_NE(doctor.first_line.find("the scale is unproven without a design"), std::string::npos) << doctor.all;
}

TEST_F(DoctorModbus, TakesASessionFile) {
  probe();
  const std::string device_file = device("word_order = \"low_first\"");
  const std::string session =
      scratch_.write("session.toml", fmt::format("design = \"{}\"\ndevice = \"{}\"\n", kBlade, device_file));
  const Doctor doctor = run_doctor({"--config", session});
  EXPECT_EQ(doctor.exit_code, 2) << doctor.all;
  EXPECT_NE(doctor.first_line.find("[map] word_order = \"high_first\""), std::string::npos) << doctor.all;
}

TEST(Doctor, NamesTheUnitThatAnswersOnALine) {
  ScratchFolder scratch;
  SimulatedMachine machine(
      {"--points", kFewPoints, "--transport", "modbus-rtu", "--device", scratch / "cmm", "--unit", "7"});
  const Doctor doctor = run_doctor({"--source", "modbus-rtu:" + (scratch / "cmm")});
  EXPECT_EQ(doctor.exit_code, 2) << doctor.all;
  EXPECT_NE(doctor.first_line.find("[modbus] unit = 7; then: the device has no record"), std::string::npos)
      << doctor.all;
}

TEST(Doctor, ADeviceThatIsNotThereIsADeviceFailureInTime) {
  const Clock::time_point begin = Clock::now();
  const Doctor closed = run_doctor({"--source", "modbus-tcp://127.0.0.1:1"});
  EXPECT_EQ(closed.exit_code, 3) << closed.all;
  const Doctor missing = run_doctor({"--source", "serial:/dev/nowhere"});
  EXPECT_EQ(missing.exit_code, 3) << missing.all;
  EXPECT_LT(Clock::now() - begin, 10s);
}

TEST(Doctor, ASilentDeviceEndsWithTheTimeGiven) {
  const int silent = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(bind(silent, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(listen(silent, 4), 0);
  socklen_t length = sizeof address;
  getsockname(silent, reinterpret_cast<sockaddr*>(&address), &length);
  const Clock::time_point begin = Clock::now();
  const Doctor doctor =
      run_doctor({"--source", fmt::format("modbus-tcp://127.0.0.1:{}", ntohs(address.sin_port)), "--timeout", "2"});
  close(silent);
  EXPECT_EQ(doctor.exit_code, 3) << doctor.all;
  EXPECT_NE(doctor.first_line.find("no unit answers"), std::string::npos) << doctor.all;
  EXPECT_LT(Clock::now() - begin, 6s);
}

TEST(Doctor, RefusesARecordingAndATimeOutOfRange) {
  EXPECT_EQ(run_doctor({"--source", "replay:" + kFewPoints}).exit_code, 2);
  EXPECT_EQ(run_doctor({"--source", "modbus-tcp://127.0.0.1:1", "--timeout", "0"}).exit_code, 2);
  EXPECT_EQ(run_doctor({}).exit_code, 2);
}

}  // namespace
}  // namespace bladefit::hil

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "config/device_settings.hpp"
#include "config/session_settings.hpp"
#include "drivers/source_registry.hpp"
#include "tests/support/scratch_folder.hpp"

namespace bladefit {
namespace {

const std::string kShipped = std::string(BLADEFIT_TEST_DATA) + "/../../config/";

/// A file that is there as long as the test.
struct File {
  explicit File(const std::string& text) : path(folder.write("a.toml", text)) {}

  bladefit::testing::ScratchFolder folder;
  std::string path;
};

TEST(ShippedFiles, AllLoad) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kShipped + "devices")) {
    SourceSettings settings;
    EXPECT_EQ(load_device(entry.path(), settings).message, "");
    EXPECT_NE(protocol_of(settings), nullptr);
    ++count;
  }
  EXPECT_EQ(count, 4);
  FitSettings fit;
  EXPECT_EQ(load_fit(kShipped + "fit.toml", fit).message, "");
  EXPECT_EQ(fit.tolerance, Length{0.1});
  SessionSettings session;
  EXPECT_EQ(load_session(kShipped + "session.toml", session).message, "");
  EXPECT_TRUE(std::filesystem::exists(*session.design)) << *session.design;
  EXPECT_TRUE(std::filesystem::exists(*session.device)) << *session.device;
  EXPECT_EQ(session.panel.port, 1503);
  EXPECT_EQ(session.panel.commands, false);
}

TEST(ShippedFiles, SayWhatHoldsWithoutThem) {
  SourceSettings settings;
  ASSERT_EQ(load_device(kShipped + "devices/modbus_tcp.toml", settings).message, "");
  const ModbusSettings modbus = std::get<ModbusSettings>(settings);
  const CmmMap map;
  const CmmMap& read = modbus.map;
  const auto same = [](const NumberField& left, const NumberField& right) {
    return left.present == right.present && left.address == right.address && left.type == right.type &&
           left.scale == right.scale;
  };
  EXPECT_TRUE(same(read.newest, map.newest) && same(read.capacity, map.capacity) && same(read.run_id, map.run_id));
  EXPECT_TRUE(same(read.version, map.version) && same(read.status, map.status) &&
              same(read.test_constant, map.test_constant));
  EXPECT_TRUE(same(read.acknowledge, map.acknowledge) && same(read.command, map.command) && same(read.crc, map.crc));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_TRUE(same(read.position[axis], map.position[axis]));
    EXPECT_TRUE(same(read.direction[axis], map.direction[axis]));
  }
  EXPECT_TRUE(same(read.sequence, map.sequence) && same(read.path, map.path) &&
              same(read.record_status, map.record_status));
  EXPECT_EQ(read.finished_mask, map.finished_mask);
  EXPECT_EQ(modbus.poll_period, ModbusSettings{}.poll_period);
  EXPECT_EQ(modbus.record_tries, ModbusSettings{}.record_tries);
  ASSERT_EQ(load_device(kShipped + "devices/serial.toml", settings).message, "");
  const SerialSettings serial = std::get<SerialSettings>(settings);
  EXPECT_EQ(serial.resend_interval, SerialSettings{}.resend_interval);
  EXPECT_EQ(serial.silence, SerialSettings{}.silence);
  EXPECT_EQ(serial.line.baud, 115200);
}

TEST(DeviceFile, DescribesAnotherMap) {
  const File file(
      "kind = \"modbus-rtu\"\n[line]\nbaud = 19200\nparity = \"even\"\n[modbus]\nunit = 9\npoll_period_ms = 0.5\n"
      "[map]\nword_order = \"low_first\"\ntable = \"holding\"\nrun_id = false\ncapacity = false\nring_capacity = 32\n"
      "[map.record]\naddress = 1000\nsize = 12\nx = { offset = 2, type = \"int32\", scale = 0.001 }\n"
      "y = { offset = 4, type = \"int32\", scale = 0.001 }\nz = { offset = 6, type = \"float32\", scale = 25.4 }\n"
      "i = false\nj = false\nk = false\npath = false\nstatus = false\ncrc = { offset = 11 }\n");
  SourceSettings settings;
  ASSERT_EQ(load_device(file.path, settings).message, "");
  const ModbusSettings modbus = std::get<ModbusSettings>(settings);
  EXPECT_EQ(modbus.transport, ModbusTransport::rtu);
  EXPECT_EQ(modbus.line.parity, Parity::even);
  EXPECT_EQ(modbus.poll_period, std::chrono::microseconds(500));
  const CmmMap& map = modbus.map;
  EXPECT_EQ(map.word_order, WordOrder::low_first);
  EXPECT_EQ(map.table, RegisterTable::holding);
  EXPECT_FALSE(map.run_id.present || map.direction[0].present || map.path.present);
  EXPECT_EQ(map.position[2].scale, 25.4);
  EXPECT_EQ(map.position[0].type, NumberType::int32);
  EXPECT_EQ(map.crc.address, 11);
  EXPECT_EQ(map.crc.type, NumberType::uint16);
}

struct BadFile {
  const char* text;
  const char* error;  ///< what follows the file's name
};

using Load = std::function<Failure(const std::string&)>;

void expect_error(const BadFile& bad, const Load& load) {
  const File file(bad.text);
  const std::string message = load(file.path).message;
  EXPECT_EQ(message.find(file.path + bad.error), 0U) << message << "\n  for\n" << bad.text;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

class DeviceErrors : public ::testing::TestWithParam<BadFile> {};

TEST_P(DeviceErrors, NameFileLineKeyAndFix) {
  expect_error(GetParam(), [](const std::string& path) {
    ModbusSettings before;
    before.unit = 77;
    SourceSettings settings = before;
    const Failure failure = load_device(path, settings);
    EXPECT_EQ(std::get<ModbusSettings>(settings).unit, 77) << "left as it was";
    return failure;
  });
}

INSTANTIATE_TEST_SUITE_P(
    All, DeviceErrors,
    ::testing::Values(
        BadFile{"", ":1: key 'kind': is missing"}, BadFile{"kind = ", ":1: "},
        BadFile{"kind = \"canbus\"", ":1: key 'kind': 'canbus' is none of: modbus-tcp"},
        BadFile{"kind = 3", ":1: key 'kind': must be a text in quotes, not a whole number"},
        BadFile{"kind = \"serial\"\n[line]\nbuad = 9600\n", ":3: unknown key 'line.buad'; did you mean 'baud'?"},
        BadFile{"kind = \"serial\"\n[line]\nbaud = \"fast\"\n",
                ":3: key 'line.baud': must be a whole number, not a text"},
        BadFile{"kind = \"serial\"\n[line]\nbaud = 96.5\n",
                ":3: key 'line.baud': must be a whole number, not a number"},
        BadFile{"kind = \"serial\"\n[line]\nbaud = 300\n",
                ":3: key 'line.baud': 300 is out of range; it must be a whole number from 1200 to 4000000"},
        BadFile{"kind = \"serial\"\n[line]\nparity = \"mark\"\n",
                ":3: key 'line.parity': 'mark' is none of: none, even, odd"},
        BadFile{"kind = \"serial\"\n[line]\nlow_latency = 1\n", ":3: key 'line.low_latency': must be true or false"},
        BadFile{"kind = \"serial\"\nline = 3\n", ":2: key 'line': must be a table, not a whole number"},
        BadFile{"kind = \"serial\"\n[modbus]\nunit = 1\n", ":2: unknown key 'modbus'"},
        BadFile{"kind = \"serial\"\n[zzzzzzzzz]\n", ":2: unknown key 'zzzzzzzzz'; known keys: kind, line, serial"},
        BadFile{"kind = \"serial\"\n[serial]\nsilence_ms = nan\n", ":3: key 'serial.silence_ms': nan is out of range"},
        BadFile{"kind = \"serial\"\n[serial]\nreconnect_longest_ms = 10\n",
                ":3: key 'serial.reconnect_longest_ms': must not be below reconnect_first_ms"},
        BadFile{"kind = \"modbus-tcp\"\n[tcp]\nport = 0\n", ":3: key 'tcp.port': 0 is out of range"},
        BadFile{"kind = \"modbus-tcp\"\n[map]\nnewest = { adress = 2 }\n",
                ":3: unknown key 'map.newest.adress'; did you mean 'address'?"},
        BadFile{"kind = \"modbus-tcp\"\n[map]\nnewest = true\n", ":3: key 'map.newest': must be a table"},
        BadFile{"kind = \"modbus-tcp\"\n[map]\nnewest = false\n", ":2: key 'map': newest is missing"},
        BadFile{"kind = \"modbus-tcp\"\n[map.record]\nsize = 18\n", ":2: key 'map': record_status ends at offset 18"},
        BadFile{"kind = \"modbus-tcp\"\n[map.record]\nx = { offset = 2, type = \"float16\" }\n",
                ":3: key 'map.record.x.type': 'float16' is none of: uint16"},
        BadFile{"kind = \"modbus-tcp\"\n[map.record]\nx = { offset = 2, scale = 0 }\n",
                ":3: key 'map.record.x.scale': is 0"},
        BadFile{"kind = \"dro\"\n[dro]\norder = \"xxy\"\n",
                ":3: key 'dro.order': 'xxy' must have each of x, y and z once"},
        BadFile{"kind = \"dro\"\n[dro]\ndecimal_mark = \",\"\n", ":2: key 'dro.separators': has the decimal mark ','"},
        BadFile{"kind = \"replay\"\n[replay]\nfile = \"\"\n", ":3: key 'replay.file': is empty; give a path"},
        BadFile{"kind = \"replay\"\n[replay]\nunits = \"ft\"\n", ":3: key 'replay.units': 'ft' is none of: mm, in"},
        BadFile{"kind = \"serial\"\nkind = \"dro\"\n", ":2: "},
        BadFile{"kind = \"serial\"\n[[[line]]]\n", ":2: a table without a name begins here"},
        BadFile{"kind = \"serial\"\n [=\n", ":2: a table without a name begins here"},
        BadFile{"kind = \"serial\"\n[\x1b", ":2: a table without a name begins here"}, BadFile{"[", ":1: "},
        BadFile{"kind = \"serial\" # \xC3\xB6\nm\xC3\xB6 = 1\n", ":2: a letter that is not a plain one stands outside"},
        BadFile{"kind = \"\xC3\xB6\\\"\xC3\xB6\"\n", ":1: key 'kind': '\xC3\xB6\"\xC3\xB6' is none of"},
        BadFile{"kind = '''\xC3\xB6\n\n'''\xC3\xBF\n", ":3: a letter that is not a plain one"},
        BadFile{"kind = \"serial\"\n[ line ]\nbuad = 1\n", ":3: unknown key 'line.buad'"}));

class SessionErrors : public ::testing::TestWithParam<BadFile> {};

TEST_P(SessionErrors, NameFileLineKeyAndFix) {
  expect_error(GetParam(), [](const std::string& path) {
    SessionSettings settings;
    return load_session(path, settings);
  });
}

INSTANTIATE_TEST_SUITE_P(
    All, SessionErrors,
    ::testing::Values(
        BadFile{"desing = \"a\"", ":1: unknown key 'desing'; did you mean 'design'?"},
        BadFile{"design = \"\"", ":1: key 'design': is empty"},
        BadFile{"source = \"tcp://a:1\"", ":1: key 'source': source 'tcp://a:1': unknown transport"},
        BadFile{"until_idle = 0", ":1: key 'until_idle': 0 is out of range"},
        BadFile{"capacity = 5", ":1: key 'capacity': 5 is out of range"},
        BadFile{"[panel]\nport = 70000", ":2: key 'panel.port': 70000 is out of range"},
        BadFile{"[panel]\nallow = [1]", ":2: key 'panel.allow': must be a list of texts"},
        BadFile{"[panel]\nallow = [\"x\"]", ":2: key 'panel.allow': 'x' is not a numeric address"},
        BadFile{"[fit]\nmode = \"best\"", ":2: key 'fit.mode': 'best' is none of: least_squares, minimax"},
        BadFile{"[fit]\nleading_edge = \"u:0:1\"", ":2: key 'fit.leading_edge': must be a list of texts"},
        BadFile{"[fit]\nleading_edge = [\"w:0:1\"]", ":2: key 'fit.leading_edge': 'w:0:1' is not a leading-edge box"},
        BadFile{"[fit]\ntolerance = -1", ":2: key 'fit.tolerance': -1 is out of range"},
        BadFile{"[fit]\nratio = 0.5", ":2: key 'fit.ratio': 0.5 is out of range"},
        BadFile{"[fit]\nwindow = \"0.9:0.1\"", ":2: key 'fit.window': '0.9:0.1' is not a window"},
        BadFile{"[fit]\nstart = \"\"", ":2: key 'fit.start': is empty; give a path"},
        BadFile{"[fit]\nedges = \"keep\"", ":2: key 'fit.edges': 'keep' is none of: skip, use"}));

TEST(SessionFile, NamesAFileThatCannotBeRead) {
  SessionSettings settings;
  EXPECT_EQ(load_session("/nonexistent.toml", settings).message, "/nonexistent.toml: no such file; check the name");
  EXPECT_EQ(load_session("/tmp", settings).message, "/tmp: is a folder; name a file in it");
  EXPECT_NE(load_session("/dev/zero", settings).message.find("is a device"), std::string::npos);
}

TEST(SessionFile, LeavesOpenWhatItDoesNotSay) {
  const File file(
      "design = \"d.igs\"\nsource = \"replay:p.csv\"\n[fit]\nprobe_radius = 1.5\n[panel]\naddress = \"::1\"\n");
  SessionSettings settings;
  ASSERT_EQ(load_session(file.path, settings).message, "");
  const std::string folder = std::filesystem::path(file.path).parent_path();
  EXPECT_EQ(settings.design, folder + "/d.igs");
  EXPECT_EQ(settings.source, "replay:" + folder + "/p.csv");
  EXPECT_EQ(settings.fit.probe_radius, Length{1.5});
  EXPECT_FALSE(settings.fit.tolerance || settings.device || settings.capacity || settings.panel.port ||
               settings.headless);
}

TEST(SessionFile, TakesEveryPathFromItsFolder) {
  const File file("source = \"serial:port\"\n[fit]\nstart = \"pairs.csv\"\n");
  const std::string folder = std::filesystem::path(file.path).parent_path();
  SessionSettings settings;
  ASSERT_EQ(load_session(file.path, settings).message, "");
  EXPECT_EQ(settings.source, "serial:" + folder + "/port");
  EXPECT_EQ(settings.fit.start, folder + "/pairs.csv");
  FitSettings fit;
  const File alone("[fit]\nstart = \"/marks/pairs.csv\"\n");
  ASSERT_EQ(load_fit(alone.path, fit).message, "");
  EXPECT_EQ(fit.start, "/marks/pairs.csv");
  const File remote("source = \"modbus-tcp://cmm:502\"\n");
  ASSERT_EQ(load_session(remote.path, settings).message, "");
  EXPECT_EQ(settings.source, "modbus-tcp://cmm:502");
}

TEST(DeviceFile, TakesEveryPathFromItsFolder) {
  const File line("kind = \"serial\"\n[line]\ndevice = \"port\"\n");
  SourceSettings settings;
  ASSERT_EQ(load_device(line.path, settings).message, "");
  EXPECT_EQ(std::get<SerialSettings>(settings).line.device, std::filesystem::path(line.path).parent_path() / "port");
  const File replay("kind = \"replay\"\n[replay]\nfile = \"points.csv\"\n");
  ASSERT_EQ(load_device(replay.path, settings).message, "");
  EXPECT_EQ(std::get<ReplaySettings>(settings).file, std::filesystem::path(replay.path).parent_path() / "points.csv");
}

TEST(DeviceFile, LeavesTheUnitsOfARecordingToTheCallerWhereItDoesNotGiveThem) {
  SourceSettings settings;
  ASSERT_EQ(load_device(File("kind = \"replay\"\n").path, settings).message, "");
  EXPECT_EQ(std::get<ReplaySettings>(settings).format.given_unit, std::nullopt);
  ASSERT_EQ(load_device(File("kind = \"replay\"\n[replay]\nunits = \"mm\"\n").path, settings).message, "");
  EXPECT_EQ(std::get<ReplaySettings>(settings).format.given_unit, Unit::mm);
}

TEST(LeadingEdge, IsReadAsOnTheCommandLine) {
  ParameterBox box;
  ASSERT_FALSE(parse_leading_edge("u:0.4:0.6", box));
  EXPECT_EQ(box.patch, 0U);
  EXPECT_EQ(box.u_min, 0.4);
  EXPECT_EQ(box.u_max, 0.6);
  EXPECT_EQ(box.v_max, 1);
  ASSERT_FALSE(parse_leading_edge("2:v:0:0.25", box));
  EXPECT_EQ(box.patch, 2U);
  EXPECT_EQ(box.u_min, 0);
  EXPECT_EQ(box.v_max, 0.25);
  for (const char* text : {"", "u", "u:0.4", "u:0.6:0.4", "u:0.4:0.4", "u:-1:0.4", "u:0:1.1", "u:0:nan", "-1:u:0:1",
                           "1:2:u:0:1", "u:0:1:2", "U:0:1", "x:0:1"}) {
    EXPECT_NE(parse_leading_edge(text, box).message.find("is not a leading-edge box; write"), std::string::npos)
        << text;
  }
  EXPECT_EQ(box.patch, 2U) << "left as it was";
}

TEST(Window, IsReadAsOnTheCommandLine) {
  ParameterWindow window;
  ASSERT_FALSE(parse_window("0.05:0.95", window));
  EXPECT_EQ(window.low, 0.05);
  EXPECT_EQ(window.high, 0.95);
  for (const char* text : {"", "0.05", "0.95:0.05", "a:b", "0:2", "0:0.5:1"})
    EXPECT_TRUE(parse_window(text, window)) << text;
}

}  // namespace
}  // namespace bladefit

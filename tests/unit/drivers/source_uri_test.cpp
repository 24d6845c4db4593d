#include <gtest/gtest.h>

#include <string>

#include "drivers/make_source.hpp"
#include "drivers/source/back_off.hpp"
#include "drivers/source_registry.hpp"
#include "drivers/source_uri.hpp"

namespace bladefit {
namespace {

struct GoodUri {
  const char* uri;
  std::string_view word;
  const char* name;
};

class GoodUris : public ::testing::TestWithParam<GoodUri> {};

TEST_P(GoodUris, AreUnderstoodAndNamed) {
  SourceSettings settings;
  ASSERT_EQ(apply_source_uri(GetParam().uri, settings).message, "");
  EXPECT_EQ(protocol_of(settings)->word, GetParam().word);
  EXPECT_EQ(source_name(settings), GetParam().name);
  EXPECT_NE(make_source(settings), nullptr);
}

INSTANTIATE_TEST_SUITE_P(
    All, GoodUris,
    ::testing::Values(GoodUri{"modbus-tcp://localhost:1502", "modbus-tcp", "modbus-tcp://localhost:1502"},
                      GoodUri{"modbus-tcp://[::1]:502", "modbus-tcp", "modbus-tcp://[::1]:502"},
                      GoodUri{"modbus-rtu:/dev/ttyUSB0", "modbus-rtu", "modbus-rtu:/dev/ttyUSB0"},
                      GoodUri{"serial:/dev/serial/by-id/a:b", "serial", "serial:/dev/serial/by-id/a:b"},
                      GoodUri{"replay:points.csv", "replay", "replay:points.csv"}));

struct BadUri {
  const char* uri;
  const char* error;
};

class BadUris : public ::testing::TestWithParam<BadUri> {};

TEST_P(BadUris, NameThePartAndTheFix) {
  SourceSettings settings;
  const std::string error = apply_source_uri(GetParam().uri, settings).message;
  EXPECT_NE(error.find(GetParam().error), std::string::npos) << error;
  EXPECT_NE(error.find(GetParam().uri), std::string::npos) << error;
  EXPECT_EQ(protocol_of(settings), nullptr);
}

INSTANTIATE_TEST_SUITE_P(
    All, BadUris,
    ::testing::Values(BadUri{"", "unknown transport"}, BadUri{"modbus", "unknown transport"},
                      BadUri{"ftp://a:1", "unknown transport"}, BadUri{"modbus-tcp:localhost:1502", "'//' is missing"},
                      BadUri{"modbus-tcp://localhost", "port is missing"},
                      BadUri{"modbus-tcp://[::1]", "port is missing"}, BadUri{"modbus-tcp://localhost:0", "1..65535"},
                      BadUri{"modbus-tcp://localhost:70000", "1..65535"},
                      BadUri{"modbus-tcp://localhost:15x", "1..65535"}, BadUri{"modbus-tcp://:1502", "host is missing"},
                      BadUri{"modbus-tcp://::1:1502", "brackets"}, BadUri{"modbus-tcp://a/b:1502", "no host has"},
                      BadUri{"modbus-rtu:", "device is missing"}, BadUri{"serial:", "device is missing"},
                      BadUri{"replay:", "file is missing"}));

TEST(SourceUri, KeepsTheFormatAndMapOfADeviceFile) {
  SourceSettings read_out(std::in_place_type<DroSettings>);
  ASSERT_EQ(apply_source_uri("serial:/dev/ttyS1", read_out).message, "");
  ASSERT_TRUE(std::holds_alternative<DroSettings>(read_out));
  EXPECT_EQ(std::get<DroSettings>(read_out).line.device, "/dev/ttyS1");
  ModbusSettings modbus;
  modbus.transport = ModbusTransport::rtu;
  modbus.unit = 7;
  SourceSettings settings(modbus);
  ASSERT_EQ(apply_source_uri("modbus-tcp://a:1", settings).message, "");
  EXPECT_EQ(source_name(settings), "modbus-tcp://a:1");
  EXPECT_EQ(std::get<ModbusSettings>(settings).unit, 7);
  EXPECT_NE(apply_source_uri("serial:/dev/ttyS1", settings).message.find("another transport"), std::string::npos);
}

TEST(SourceProtocols, EachOwnsItsDefaultsAndNoOtherDoes) {
  for (const SourceProtocol& protocol : source_protocols()) {
    const SourceSettings settings = protocol.defaults();
    EXPECT_EQ(protocol_of(settings), &protocol) << protocol.word;
    EXPECT_TRUE(protocol.accepts(settings)) << protocol.word;
    EXPECT_EQ(find_protocol(protocol.word), &protocol);
    for (const SourceProtocol& other : source_protocols()) {
      EXPECT_EQ(other.owns(settings), &other == &protocol) << protocol.word << " and " << other.word;
    }
  }
  EXPECT_EQ(find_protocol("ftp"), nullptr);
}

TEST(SourceProtocols, AreListedForHelp) {
  EXPECT_EQ(source_words(), "modbus-tcp, modbus-rtu, serial, dro or replay");
  EXPECT_EQ(source_uri_forms(), "modbus-tcp://HOST:PORT, modbus-rtu:DEVICE, serial:DEVICE or replay:FILE.csv");
}

TEST(MakeSource, MakesNothingOfNoKind) { EXPECT_EQ(make_source(SourceSettings{}), nullptr); }

TEST(BackOff, DoublesUpToTheLongestPause) {
  using std::chrono::milliseconds;
  BackOff back_off(milliseconds(50), milliseconds(300));
  const BackOff::Clock::time_point now{};
  for (const int pause : {50, 100, 200, 300, 300}) {
    back_off.failed(now);
    EXPECT_EQ(back_off.retry_at() - now, milliseconds(pause));
  }
  back_off.succeeded();
  back_off.failed(now);
  EXPECT_EQ(back_off.retry_at() - now, milliseconds(50));
}

}  // namespace
}  // namespace bladefit

// Device files of machines that differ from register map v1, and of read-outs.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "config/device_settings.hpp"
#include "config/session_settings.hpp"
#include "tests/support/scratch_folder.hpp"

namespace bladefit {
namespace {

const std::string kShippedDevices = std::string(BLADEFIT_TEST_DATA) + "/../../config/devices/";

/// A device file that is there as long as the test.
struct DeviceText {
  explicit DeviceText(const std::string& text) : path(folder.write("device.toml", text)) {}

  bladefit::testing::ScratchFolder folder;
  std::string path;
};

TEST(DeviceFile, CountsAddressesFromOneWhereItSaysSo) {
  const DeviceText file(
      "kind = \"modbus-tcp\"\n[modbus]\nunit = 0\n[map]\naddress_base = 1\nbyte_order = \"low_first\"\n"
      "newest = { address = 3, type = \"uint32\" }\nacknowledge = { address = 65536 }\n"
      "[map.record]\naddress = 101\nx = { offset = 2, type = \"float64\" }\n"
      "[map.status_values]\nready = 0\nfault = [3, 4]\nfinished = 9\n");
  SourceSettings settings;
  ASSERT_EQ(load_device(file.path, settings).message, "");
  const ModbusSettings modbus = std::get<ModbusSettings>(settings);
  EXPECT_EQ(modbus.unit, 0);
  EXPECT_EQ(modbus.map.byte_order, ByteOrder::low_first);
  EXPECT_EQ(modbus.map.newest.address, 2);
  EXPECT_EQ(modbus.map.acknowledge.address, 65535);
  EXPECT_EQ(modbus.map.records, 100);
  EXPECT_EQ(modbus.map.position[0].address, 2) << "an offset is none";
  EXPECT_EQ(modbus.map.status.address, 1) << "what the file does not say is as before";
  using Meanings = std::vector<std::pair<std::uint16_t, std::uint16_t>>;
  EXPECT_EQ(modbus.map.status_values, (Meanings{{0, 0}, {4, 3}, {4, 4}, {16, 9}}));
  EXPECT_EQ(modbus.map.probing_mask, 0) << "no value says so";
  EXPECT_EQ(modbus.map.fault_mask, 4);
}

TEST(DeviceFile, DescribesAReadOut) {
  const DeviceText file(
      "kind = \"dro\"\n[dro]\nunits = \"in\"\nscale = 0.0001\norder = \"zxy\"\nline_holds = \"axis\"\n"
      "fixed_decimals = false\nmarks = \"\"\n");
  SourceSettings settings;
  ASSERT_EQ(load_device(file.path, settings).message, "");
  const DroSettings dro = std::get<DroSettings>(settings);
  EXPECT_EQ(dro.mm_per_unit, 25.4);
  EXPECT_EQ(dro.scale, 0.0001);
  EXPECT_EQ(dro.order, "zxy");
  EXPECT_TRUE(dro.order_given);
  EXPECT_EQ(dro.layout, DroLayout::single_axes);
  EXPECT_FALSE(dro.fixed_decimals);
  EXPECT_EQ(dro.marks, "");
  ASSERT_EQ(load_device(kShippedDevices + "dro.toml", settings).message, "");
  EXPECT_FALSE(std::get<DroSettings>(settings).order_given) << "left to the pauses";
}

TEST(SessionFilePanel, SaysHowNumbersAreSentAndHowLongItStays) {
  const DeviceText file("[panel]\nword_order = \"low_first\"\ninfinity = inf\nlinger = 3600\n");
  SessionSettings settings;
  ASSERT_EQ(load_session(file.path, settings).message, "");
  EXPECT_EQ(settings.panel.low_word_first, true);
  EXPECT_EQ(settings.panel.infinity, std::numeric_limits<double>::infinity());
  EXPECT_EQ(settings.panel.linger, 3600);
  for (const auto& [text, error] :
       {std::pair{"[panel]\ninfinity = nan\n", ":2: key 'panel.infinity': is not a number"},
        {"[panel]\nlinger = -1\n", ":2: key 'panel.linger': -1 is out of range"},
        {"[panel]\nword_order = \"low\"\n", ":2: key 'panel.word_order': 'low' is none of: high_first, low_first"}}) {
    const DeviceText bad(text);
    EXPECT_EQ(load_session(bad.path, settings).message.find(bad.path + error), 0U) << error;
  }
}

struct BadDevice {
  const char* text;
  const char* error;  ///< what follows the file's name
};

class DeviceRefusals : public ::testing::TestWithParam<BadDevice> {};

TEST_P(DeviceRefusals, NameLineKeyAndFix) {
  const DeviceText file(GetParam().text);
  SourceSettings settings;
  const std::string message = load_device(file.path, settings).message;
  EXPECT_EQ(message.find(file.path + GetParam().error), 0U) << message;
}

INSTANTIATE_TEST_SUITE_P(
    All, DeviceRefusals,
    ::testing::Values(
        BadDevice{"kind = \"modbus-tcp\"\n[map]\naddress_base = 1\nnewest = { address = 0 }\n",
                  ":4: key 'map.newest.address': 0 is out of range; it must be a whole number from 1 to 65536"},
        BadDevice{"kind = \"modbus-tcp\"\n[map.status_bits]\nfault = 4\n[map.status_values]\nfault = 4\n",
                  ":4: key 'map.status_values': stands beside status_bits"},
        BadDevice{"kind = \"modbus-tcp\"\n[map.status_values]\nfault = 4\nfinished = [1, 4]\n",
                  ":4: key 'map.status_values.finished': shares the value 4 with another key"},
        BadDevice{"kind = \"modbus-tcp\"\n[map.status_values]\nfault = [1, -4]\n",
                  ":3: key 'map.status_values.fault': must be a list of whole numbers from 0 to 65535"},
        BadDevice{"kind = \"dro\"\n[dro]\nlabels = false\nline_holds = \"axis\"\n",
                  ":4: key 'dro.line_holds': is \"axis\" without labels: a lost line would mix two points"},
        BadDevice{"kind = \"dro\"\n[dro]\nmarks = \"RX\"\n", ":3: key 'dro.marks': has 'X', which labels"},
        BadDevice{"kind = \"dro\"\n[dro]\nscale = 0\n", ":3: key 'dro.scale': 0 is out of range"}));

}  // namespace
}  // namespace bladefit

#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drivers/modbus/cmm_map_v1.hpp"
#include "drivers/serial/line_settings.hpp"

namespace bladefit {

struct TcpSettings {
  std::string host;  ///< name or address
  std::uint16_t port = cmm_map_v1::kDefaultPort;
};

enum class NumberType : std::uint8_t { uint16, int16, uint32, int32, float32, float64 };

/// Which register of a number of several registers comes first.
enum class WordOrder : std::uint8_t { high_first, low_first };

/// The word orders as a device file and messages call them.
inline constexpr std::array<std::pair<std::string_view, WordOrder>, 2> kWordOrders = {
    {{"high_first", WordOrder::high_first}, {"low_first", WordOrder::low_first}}};

/// Which byte of a register comes first: Modbus has the high one first. Some devices swap them in every register,
/// others only in numbers of several registers.
enum class ByteOrder : std::uint8_t { high_first, low_first, low_first_in_long };

/// The byte orders as a device file and messages call them.
inline constexpr std::array<std::pair<std::string_view, ByteOrder>, 3> kByteOrders = {
    {{"high_first", ByteOrder::high_first},
     {"low_first", ByteOrder::low_first},
     {"low_first_in_long", ByteOrder::low_first_in_long}}};

/// How a number lies in its registers.
struct RegisterOrder {
  constexpr RegisterOrder(WordOrder word_order, ByteOrder byte_order = ByteOrder::high_first)
      : words(word_order), bytes(byte_order) {}

  WordOrder words;
  ByteOrder bytes;
};

enum class RegisterTable : std::uint8_t { input, holding };

/// The tables as a device file and messages call them.
inline constexpr std::array<std::pair<std::string_view, RegisterTable>, 2> kRegisterTables = {
    {{"input", RegisterTable::input}, {"holding", RegisterTable::holding}}};

/// A number in registers. Its value is scale * raw.
struct NumberField {
  bool present = true;        ///< false: the device has no such register
  std::uint16_t address = 0;  ///< first register; of fields of a record: offset within the record
  NumberType type = NumberType::uint16;
  double scale = 1;
};

/// Where a CMM has what. Defaults: CMM register map v1. Lengths come out in mm, so a device that counts in
/// micrometres as int32 has the scale 0.001, one that speaks inches 25.4.
struct CmmMap {
  WordOrder word_order = WordOrder::high_first;
  ByteOrder byte_order = ByteOrder::high_first;
  RegisterTable table = RegisterTable::input;  ///< of the header and of the records
  std::uint16_t address_base = 0;  ///< what the device file counts its addresses from; those here count from 0

  NumberField version{true, cmm_map_v1::kVersionRegister, NumberType::uint16, 1};
  std::uint32_t expected_version = cmm_map_v1::kVersion;
  NumberField status{true, cmm_map_v1::kStatusRegister, NumberType::uint16, 1};
  std::uint16_t probing_mask = cmm_map_v1::kStatusProbing;  ///< status bits that mean so; 0 = the device has none
  std::uint16_t fault_mask = cmm_map_v1::kStatusFault;
  std::uint16_t overflow_mask = cmm_map_v1::kStatusOverflow;  ///< points were lost in the device
  std::uint16_t finished_mask = cmm_map_v1::kStatusFinished;  ///< the program is finished
  /// Where the status is a number: which of the bits above (0 = none of them) each of its values stands for. Empty:
  /// bits.
  std::vector<std::pair<std::uint16_t, std::uint16_t>> status_values;
  NumberField newest{true, cmm_map_v1::kNewestRegister, NumberType::uint32, 1};
  NumberField capacity{true, cmm_map_v1::kCapacityRegister, NumberType::uint16, 1};
  std::uint32_t ring_capacity = 0;  ///< [records]; 0 = the device says it in `capacity`
  NumberField reported_record_size{true, cmm_map_v1::kRecordSizeRegister, NumberType::uint16, 1};
  NumberField run_id{true, cmm_map_v1::kRunIdRegister, NumberType::uint32, 1};
  NumberField test_constant{true, cmm_map_v1::kTestConstantRegister, NumberType::float64, 1};
  double expected_test_constant = cmm_map_v1::kTestConstant;

  std::uint16_t records = cmm_map_v1::kRecordsRegister;  ///< first register of the ring
  std::uint16_t record_size = cmm_map_v1::kRecordSize;   ///< [registers]
  NumberField sequence{true, cmm_map_v1::kSequenceOffset, NumberType::uint32, 1};
  std::array<NumberField, 3> position{NumberField{true, cmm_map_v1::kXOffset, NumberType::float64, 1},
                                      NumberField{true, cmm_map_v1::kYOffset, NumberType::float64, 1},
                                      NumberField{true, cmm_map_v1::kZOffset, NumberType::float64, 1}};
  /// From the probe to the material; a device that gives the opposite has a negative scale.
  std::array<NumberField, 3> direction{
      NumberField{true, cmm_map_v1::kDirectionOffset, NumberType::int16, 1 / cmm_map_v1::kDirectionScale},
      NumberField{true, cmm_map_v1::kDirectionOffset + 1, NumberType::int16, 1 / cmm_map_v1::kDirectionScale},
      NumberField{true, cmm_map_v1::kDirectionOffset + 2, NumberType::int16, 1 / cmm_map_v1::kDirectionScale}};
  NumberField path{true, cmm_map_v1::kPathOffset, NumberType::uint16, 1};
  NumberField record_status{true, cmm_map_v1::kRecordStatusOffset, NumberType::uint16, 1};
  std::uint32_t record_good = cmm_map_v1::kRecordGood;                   ///< record_status of a good record
  NumberField crc{true, cmm_map_v1::kCrcOffset, NumberType::uint16, 1};  ///< over the registers before it

  NumberField acknowledge{true, cmm_map_v1::kAcknowledgeRegister, NumberType::uint32, 1};  ///< holding registers
  NumberField command{true, cmm_map_v1::kCommandRegister, NumberType::uint16, 1};
  std::uint16_t command_start = cmm_map_v1::kCommandStart;
  std::uint16_t command_stop = cmm_map_v1::kCommandStop;
  std::uint16_t command_restart = cmm_map_v1::kCommandRestart;

  [[nodiscard]] RegisterOrder order() const { return {word_order, byte_order}; }
};

enum class ModbusTransport : std::uint8_t { tcp, rtu };

struct ModbusSettings {
  ModbusTransport transport = ModbusTransport::tcp;
  TcpSettings tcp;          ///< where the device is, of transport tcp
  SerialLineSettings line;  ///< the same of transport rtu
  int unit = cmm_map_v1::kDefaultUnit;
  CmmMap map;
  int batch = 6;                                      ///< records read at once
  std::chrono::microseconds poll_period{2000};        ///< between two looks at the newest sequence
  std::chrono::milliseconds reply_timeout{300};       ///< deadline of a whole transaction
  std::chrono::milliseconds connect_timeout{1000};    ///< of one attempt
  std::chrono::milliseconds reconnect_first{50};      ///< first pause before connecting again; it doubles ...
  std::chrono::milliseconds reconnect_longest{1000};  ///< ... up to this
  std::chrono::milliseconds quiet{100};               ///< RTU: silence kept after a missing or damaged reply
  int timeouts_to_reconnect = 5;  ///< replies missing in a row after which a TCP connection is given up
  int record_tries = 250;         ///< how often a damaged record is read before it counts as lost
  bool echo = false;              ///< RS-485: every byte that is sent is received first
};

}  // namespace bladefit

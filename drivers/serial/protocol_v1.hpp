#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>

/// Serial protocol v1: constants only. A line is kBegin, tag, fields, kCrcMark, four upper-case hexadecimal digits,
/// kEnd; the digits are the CRC-16/MODBUS of the characters between kBegin and kCrcMark.
namespace bladefit::serial_protocol_v1 {

inline constexpr char kBegin = '$';
inline constexpr char kFieldSeparator = ',';
inline constexpr char kCrcMark = '*';
inline constexpr std::size_t kCrcDigits = 4;
inline constexpr std::string_view kEnd = "\r\n";

/// From the device.
inline constexpr std::string_view kRunTag = "RUN";       ///< $RUN,<run id>
inline constexpr std::string_view kPointTag = "PT";      ///< $PT,<seq>,<x>,<y>,<z>,<i>,<j>,<k>,<path> [mm, unit vector]
inline constexpr std::string_view kFinishedTag = "END";  ///< $END,<seq of the last record>
inline constexpr std::size_t kPointFields = 8;           ///< behind the tag

/// From the host.
inline constexpr std::string_view kStartTag = "START";      ///< $START,<first seq>
inline constexpr std::string_view kAcknowledgeTag = "ACK";  ///< $ACK,<seq>
inline constexpr std::string_view kMissingTag = "NAK";      ///< $NAK,<first missing seq>: the device resends from there
inline constexpr std::string_view kStopTag = "STOP";        ///< $STOP

/// CRC-16/MODBUS: reflected, initial value and polynomial as here, no final exclusive or.
inline constexpr std::uint16_t kCrcInitial = 0xFFFF;
inline constexpr std::uint16_t kCrcPolynomial = 0xA001;  ///< 0x8005 reflected

inline constexpr int kDefaultBaud = 115200;   ///< with 8 data bits, no parity, 1 stop bit
inline constexpr std::size_t kMaxLine = 256;  ///< characters of the longest line, kEnd included

}  // namespace bladefit::serial_protocol_v1

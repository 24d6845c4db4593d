#pragma once
#include <cstdint>

/// CMM register map v1: constants only. Every value of several registers has its high word first.
namespace bladefit::cmm_map_v1 {

/// Input registers (function code 4).
inline constexpr std::uint16_t kVersionRegister = 0;       ///< uint16, kVersion
inline constexpr std::uint16_t kStatusRegister = 1;        ///< uint16, the status bits below
inline constexpr std::uint16_t kNewestRegister = 2;        ///< uint32 sequence of the newest record; 0 = none yet
inline constexpr std::uint16_t kCapacityRegister = 4;      ///< uint16 ring capacity [records]
inline constexpr std::uint16_t kRecordSizeRegister = 5;    ///< uint16 registers per record, kRecordSize
inline constexpr std::uint16_t kRunIdRegister = 6;         ///< uint32; another value when numbering restarted at 1
inline constexpr std::uint16_t kTestConstantRegister = 8;  ///< float64 kTestConstant; all 0 = not provided
inline constexpr std::uint16_t kHeaderSize = 12;           ///< registers 0..11
inline constexpr std::uint16_t kRecordsRegister = 100;     ///< record s at 100 + ((s - 1) mod capacity) * kRecordSize

inline constexpr std::uint16_t kVersion = 1;
inline constexpr double kTestConstant = 12345.678;

/// Status bits.
inline constexpr std::uint16_t kStatusReady = 1U << 0;
inline constexpr std::uint16_t kStatusProbing = 1U << 1;
inline constexpr std::uint16_t kStatusFault = 1U << 2;
inline constexpr std::uint16_t kStatusOverflow = 1U << 3;  ///< points were lost in the device
inline constexpr std::uint16_t kStatusFinished = 1U << 4;  ///< the program is finished

/// Offsets in a record [registers].
inline constexpr std::uint16_t kRecordSize = 20;
inline constexpr std::uint16_t kSequenceOffset = 0;       ///< uint32
inline constexpr std::uint16_t kXOffset = 2;              ///< float64 [mm]
inline constexpr std::uint16_t kYOffset = 6;              ///< float64 [mm]
inline constexpr std::uint16_t kZOffset = 10;             ///< float64 [mm]
inline constexpr std::uint16_t kDirectionOffset = 14;     ///< three int16 / kDirectionScale; 0,0,0 = unknown
inline constexpr std::uint16_t kPathOffset = 17;          ///< uint16
inline constexpr std::uint16_t kRecordStatusOffset = 18;  ///< uint16, kRecordGood
inline constexpr std::uint16_t kCrcOffset = 19;           ///< CRC-16/MODBUS over the bytes of 0..18, high byte first
inline constexpr double kDirectionScale = 32767.0;
inline constexpr std::uint16_t kRecordGood = 0;

/// Holding registers (function codes 3, 6, 16).
inline constexpr std::uint16_t kAcknowledgeRegister = 0;  ///< uint32 last sequence that the reader has safely stored
inline constexpr std::uint16_t kCommandRegister = 2;      ///< uint16, one of the commands below
inline constexpr std::uint16_t kHoldingSize = 3;
inline constexpr std::uint16_t kCommandStart = 1;
inline constexpr std::uint16_t kCommandStop = 2;
inline constexpr std::uint16_t kCommandRestart = 3;  ///< from the acknowledged sequence

/// CRC-16/MODBUS: reflected, initial value and polynomial as here, no final exclusive or.
inline constexpr std::uint16_t kCrcInitial = 0xFFFF;
inline constexpr std::uint16_t kCrcPolynomial = 0xA001;  ///< 0x8005 reflected

inline constexpr std::uint16_t kDefaultPort = 1502;
inline constexpr std::uint8_t kDefaultUnit = 1;

}  // namespace bladefit::cmm_map_v1

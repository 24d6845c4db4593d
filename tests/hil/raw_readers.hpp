#pragma once
#include <fcntl.h>
#include <fmt/format.h>
#include <modbus/modbus.h>
#include <poll.h>
#include <signal.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "drivers/modbus/cmm_map_v1.hpp"
#include "tests/hil/simulated_machine.hpp"
#include "tests/support/process.hpp"
#include "tools/simulate/check_sum.hpp"

/// Readers of the simulated machine that know nothing of the drivers.
namespace bladefit::hil {

/// A line of a points file with columns x,y,z,i,j,k,path.
struct RawPoint {
  std::array<double, 3> position{};
  std::array<double, 3> direction{};
  int path = 0;
};

inline std::vector<RawPoint> read_raw_points(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  std::vector<RawPoint> points;
  while (std::getline(stream, line)) {
    RawPoint point;
    char* place = line.data();
    for (double& value : point.position) value = std::strtod(place, &place), ++place;
    for (double& value : point.direction) value = std::strtod(place, &place), ++place;
    point.path = static_cast<int>(std::strtol(place, nullptr, 10));
    points.push_back(point);
  }
  return points;
}

struct RawRecord {
  std::uint32_t sequence = 0;
  RawPoint point;
  bool intact = false;
};

/// A Modbus client made of plain libmodbus calls.
class RawModbus {
 public:
  static RawModbus tcp(int port) { return RawModbus(modbus_new_tcp("127.0.0.1", port)); }
  static RawModbus rtu(const std::string& device) {
    RawModbus client(modbus_new_rtu(device.c_str(), 115200, 'N', 8, 1), false);
    modbus_set_slave(client.context_.get(), 1);
    client.connect();
    return client;
  }

  /// Registers, or empty when no good answer came in 500 ms.
  [[nodiscard]] std::vector<std::uint16_t> inputs(int address, int count) const {
    std::vector<std::uint16_t> registers(static_cast<std::size_t>(count));
    if (modbus_read_input_registers(context_.get(), address, count, registers.data()) != count) registers.clear();
    return registers;
  }
  [[nodiscard]] std::uint32_t newest() const {
    const std::vector<std::uint16_t> header = inputs(0, 12);
    return header.empty() ? 0 : static_cast<std::uint32_t>(header[2]) << 16U | header[3];
  }
  [[nodiscard]] std::uint16_t status() const {
    const std::vector<std::uint16_t> header = inputs(0, 12);
    return header.empty() ? std::uint16_t{0} : header[1];
  }
  bool acknowledge(std::uint32_t sequence) const {
    const std::array<std::uint16_t, 2> words = {static_cast<std::uint16_t>(sequence >> 16U),
                                                static_cast<std::uint16_t>(sequence)};
    return modbus_write_registers(context_.get(), 0, 2, words.data()) == 2;
  }
  bool command(std::uint16_t value) const { return modbus_write_register(context_.get(), 2, value) == 1; }

  [[nodiscard]] RawRecord record(std::uint32_t sequence, std::uint32_t capacity = 512) const {
    const auto registers = inputs(static_cast<int>(100 + (sequence - 1) % capacity * 20), 20);
    RawRecord record;
    if (registers.empty()) return record;
    std::string bytes;
    for (std::size_t k = 0; k < 19; ++k) {
      bytes.push_back(static_cast<char>(registers[k] >> 8U));
      bytes.push_back(static_cast<char>(registers[k] & 0xFFU));
    }
    record.intact = simulate::check_sum(bytes, 0xFFFF, 0xA001) == registers[19];
    record.sequence = static_cast<std::uint32_t>(registers[0]) << 16U | registers[1];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::uint64_t word = 0;
      for (std::size_t k = 0; k < 4; ++k) word = word << 16U | registers[2 + 4 * axis + k];
      record.point.position[axis] = std::bit_cast<double>(word);
      record.point.direction[axis] = static_cast<std::int16_t>(registers[14 + axis]) / 32767.0;
    }
    record.point.path = registers[17];
    return record;
  }
  [[nodiscard]] modbus_t* context() const { return context_.get(); }
  void connect() const {
    if (modbus_connect(context_.get()) != 0) throw std::runtime_error("the machine does not accept a reader");
  }

 private:
  struct Free {
    void operator()(modbus_t* context) const {
      modbus_close(context);
      modbus_free(context);
    }
  };
  explicit RawModbus(modbus_t* context, bool at_once = true) : context_(context) {
    if (at_once) connect();
  }
  std::unique_ptr<modbus_t, Free> context_;
};

/// `content` with marks, check sum and end of line.
inline std::string framed(const std::string& content) {
  return fmt::format("${}*{:04X}\r\n", content, simulate::check_sum(content, 0xFFFF, 0xA001));
}

/// A host on the serial line made of plain system calls.
class RawSerial {
 public:
  explicit RawSerial(const std::string& device) : descriptor_(open(device.c_str(), O_RDWR | O_NOCTTY)) {
    if (descriptor_ < 0) throw std::runtime_error("cannot open " + device);
    termios settings{};
    tcgetattr(descriptor_, &settings);
    cfmakeraw(&settings);
    tcsetattr(descriptor_, TCSANOW, &settings);
  }
  ~RawSerial() { close(descriptor_); }
  RawSerial(const RawSerial&) = delete;
  RawSerial& operator=(const RawSerial&) = delete;

  void send(const std::string& content) const { send_raw(framed(content)); }
  void send_raw(const std::string& bytes) const { (void)!write(descriptor_, bytes.data(), bytes.size()); }

  /// The next line without its end; nothing when none came in time or the line was hung up.
  [[nodiscard]] std::optional<std::string> line(std::chrono::milliseconds patience = 2s) {
    const Clock::time_point until = Clock::now() + patience;
    while (pending_.find('\n') == std::string::npos) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
      pollfd event{descriptor_, POLLIN, 0};
      if (left <= 0 || poll(&event, 1, static_cast<int>(left)) <= 0) return std::nullopt;
      std::array<char, 512> buffer{};
      const ssize_t length = read(descriptor_, buffer.data(), buffer.size());
      if (length <= 0) return std::nullopt;
      pending_.append(buffer.data(), static_cast<std::size_t>(length));
    }
    std::string line = pending_.substr(0, pending_.find('\n'));
    pending_.erase(0, line.size() + 1);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
  }

  /// The fields of a line between its marks; empty when it is damaged.
  static std::vector<std::string> fields(const std::string& line) {
    const std::size_t mark = line.rfind('*');
    if (line.empty() || mark == std::string::npos || line[0] != '$') return {};
    const std::string content = line.substr(1, mark - 1);
    if (framed(content) != line + "\r\n") return {};
    std::istringstream stream(content);
    std::vector<std::string> fields;
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    return fields;
  }

 private:
  int descriptor_;
  std::string pending_;
};

}  // namespace bladefit::hil

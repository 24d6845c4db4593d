#include "tools/doctor/line_listener.hpp"

#include <array>
#include <bit>
#include <cctype>

#include "drivers/serial/serial_port.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kLongestLine = 256, kLongestPrinted = 60;
constexpr unsigned kParityBit = 0x80;

/// Adds bytes to what was heard; `rest` is the line under way.
void add_bytes(std::string_view bytes, std::string& rest, Heard& heard) {
  heard.bytes += bytes.size();
  for (const char byte : bytes) {
    const char plain = static_cast<char>(static_cast<unsigned char>(byte) & ~kParityBit);
    const bool ends = plain == '\r' || plain == '\n' || rest.size() >= kLongestLine;
    if (!ends) {
      rest += byte;
    } else if (!rest.empty()) {
      heard.lines.push_back({std::exchange(rest, {}), std::chrono::steady_clock::now()});
    }
  }
}

}  // namespace

Heard listen(const SerialLineSettings& line, std::size_t lines, Deadline until) {
  Heard heard;
  SerialPort port;
  if (Failure failure = port.open(line)) {
    heard.failure = std::move(failure);
    return heard;
  }
  std::array<char, 4096> buffer{};
  std::string rest;
  while (heard.lines.size() < lines && std::chrono::steady_clock::now() < until) {
    const std::optional<std::size_t> count = port.read(buffer, until);
    if (!count) {
      heard.failure = device_failure("the port has hung up; check the cable");
      break;
    }
    add_bytes({buffer.data(), *count}, rest, heard);
  }
  return heard;
}

std::vector<Heard::Line> without_parity(const Heard& heard, Parity& parity) {
  std::size_t even = 0, odd = 0;
  std::vector<Heard::Line> lines = heard.lines;
  for (Heard::Line& line : lines) {
    for (char& character : line.text) {
      const auto byte = static_cast<unsigned char>(character);
      (std::popcount(byte) % 2 == 0 ? even : odd) += 1;
      character = static_cast<char>(byte & ~kParityBit);
    }
  }
  if (even > 0 && odd > 0) return {};
  parity = odd > 0 ? Parity::odd : Parity::even;
  return lines;
}

std::string printable(std::string_view line) {
  std::string text(line.substr(0, kLongestPrinted));
  for (char& character : text) {
    if (std::isprint(static_cast<unsigned char>(character)) == 0) character = '.';
  }
  return text;
}

}  // namespace bladefit

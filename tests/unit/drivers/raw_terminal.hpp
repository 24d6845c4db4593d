#pragma once
#include <pty.h>

#include <array>
#include <stdexcept>
#include <string>

namespace bladefit {

/// Opens a pseudo terminal that passes bytes on as they are. Returns the name of the host's end.
inline std::string open_raw_terminal(int& machine, int& host) {
  std::array<char, 128> name{};
  if (::openpty(&machine, &host, name.data(), nullptr, nullptr) != 0) throw std::runtime_error("no pseudo terminal");
  termios raw{};
  ::tcgetattr(host, &raw);
  ::cfmakeraw(&raw);
  ::tcsetattr(host, TCSANOW, &raw);
  return name.data();
}

}  // namespace bladefit

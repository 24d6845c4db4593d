#include "drivers/serial/port_guard.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/serial.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "drivers/serial/port_list.hpp"

namespace bladefit {
namespace {

constexpr int kLongLatencyMs = 2;

/// The latency timer of an FTDI adapter [ms]; 0 = the port has none.
int latency_timer_ms(const std::string& device) {
  std::error_code error;
  const std::filesystem::path real = std::filesystem::canonical(device, error);
  if (error) return 0;
  std::ifstream file("/sys/class/tty/" + real.filename().string() + "/device/latency_timer");
  int milliseconds = 0;
  file >> milliseconds;
  return file ? milliseconds : 0;
}

}  // namespace

std::string port_error_text(int error) {
  switch (error) {
    case ENOENT:
    case ENXIO:
    case ENODEV:
      return fmt::format("there is no such port; plug in the machine's cable or correct the path ({})", known_ports());
    case EBUSY:
    case EWOULDBLOCK:
      return "the port is busy: another program uses it; end that program";
    case EACCES:
    case EPERM:
      return "no permission to use the port; add the user to the group that owns it (dialout)";
    case ENOTTY:
    case EISDIR:
      return "this is not a serial port; correct the path";
    default:
      return fmt::format("{}; check the cable and the path", std::strerror(error));
  }
}

Failure PortGuard::lock(const std::string& device) {
  release();
  device_ = device;
  descriptor_ = ::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) return device_failure(port_error_text(errno));
  int error = 0;
  if (::isatty(descriptor_) == 0) {
    error = ENOTTY;
  } else if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    error = errno;
  }
  if (error == 0) return {};
  ::close(descriptor_);
  descriptor_ = -1;
  return device_failure(port_error_text(error));
}

void PortGuard::shut_out_others() const { ::ioctl(descriptor_, TIOCEXCL); }

std::string PortGuard::ask_low_latency() const {
  serial_struct serial{};
  if (::ioctl(descriptor_, TIOCGSERIAL, &serial) == 0) {
    serial.flags |= static_cast<int>(ASYNC_LOW_LATENCY);
    ::ioctl(descriptor_, TIOCSSERIAL, &serial);
  }
  const int timer_ms = latency_timer_ms(device_);
  if (timer_ms < kLongLatencyMs) return {};
  return fmt::format("{}: the adapter holds bytes back for {} ms; write 1 to its latency_timer in /sys/class/tty",
                     device_, timer_ms);
}

void PortGuard::release() {
  if (descriptor_ < 0) return;
  ::ioctl(descriptor_, TIOCNXCL);
  ::close(descriptor_);
  descriptor_ = -1;
}

}  // namespace bladefit

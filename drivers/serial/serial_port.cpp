#include "drivers/serial/serial_port.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <thread>

#include "drivers/serial/line_speed.hpp"
#include "drivers/source/wait_ready.hpp"

namespace bladefit {
namespace {

tcflag_t parity_flags(Parity parity) {
  switch (parity) {
    case Parity::none:
      return 0;
    case Parity::even:
      return PARENB;
    case Parity::odd:
      break;
  }
  return PARENB | PARODD;
}

/// Raw bytes, no flow control, no modem lines. A failure is a phrase with the fix.
Failure configure(int descriptor, const SerialLineSettings& settings) {
  const std::optional<speed_t> speed = speed_code(settings.baud);
  termios line{};
  if (!speed) {
    return device_failure(
        fmt::format("{} baud is not a standard rate; set baud to one such as 9600 or 115200", settings.baud));
  }
  if (::tcgetattr(descriptor, &line) != 0) return device_failure(port_error_text(errno));
  ::cfmakeraw(&line);
  line.c_cflag &= ~static_cast<tcflag_t>(CSIZE | CSTOPB | PARENB | PARODD | CRTSCTS);
  line.c_cflag |= CREAD | CLOCAL | parity_flags(settings.parity);
  line.c_cflag |= static_cast<tcflag_t>(settings.data_bits == 7 ? CS7 : CS8);
  if (settings.stop_bits == 2) line.c_cflag |= CSTOPB;
  if (settings.parity != Parity::none) line.c_iflag |= INPCK;
  line.c_cc[VMIN] = 0;
  line.c_cc[VTIME] = 0;
  ::cfsetispeed(&line, *speed);
  ::cfsetospeed(&line, *speed);
  if (::tcsetattr(descriptor, TCSANOW, &line) == 0) return {};
  return device_failure(
      fmt::format("the port cannot be set to {} baud, {} data bits, {} stop bits; correct the settings of the line",
                  settings.baud, settings.data_bits, settings.stop_bits));
}

}  // namespace

Failure SerialPort::open(const SerialLineSettings& settings) {
  close();
  if (Failure failure = guard_.lock(settings.device)) return failure;
  if (Failure failure = configure(guard_.descriptor(), settings)) {
    close();
    return failure;
  }
  guard_.shut_out_others();
  ::tcflush(guard_.descriptor(), TCIOFLUSH);
  remark_ = settings.low_latency ? guard_.ask_low_latency() : std::string{};
  return {};
}

std::optional<std::size_t> SerialPort::read(std::span<char> bytes, Clock::time_point until) {
  const Readiness readiness = wait_ready(guard_.descriptor(), false, until);
  if (readiness == Readiness::hang_up) return std::nullopt;
  if (readiness == Readiness::timeout) return std::size_t{0};
  const ssize_t count = ::read(guard_.descriptor(), bytes.data(), bytes.size());
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return std::size_t{0};
  // Nothing in a port that could be read means that the other end is gone; a pulled adapter gives EIO.
  if (count <= 0) return std::nullopt;
  return static_cast<std::size_t>(count);
}

std::optional<std::size_t> SerialPort::write(std::string_view bytes) {
  const ssize_t count = ::write(guard_.descriptor(), bytes.data(), bytes.size());
  if (count >= 0) return static_cast<std::size_t>(count);
  if (errno == EAGAIN || errno == EINTR) return std::size_t{0};
  return std::nullopt;
}

void SerialPort::drain(Clock::time_point until) {
  int waiting = 0;
  while (is_open() && ::ioctl(guard_.descriptor(), TIOCOUTQ, &waiting) == 0 && waiting > 0 && Clock::now() < until) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace bladefit

#pragma once
#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "drivers/modbus/modbus_settings.hpp"
#include "tests/unit/drivers/modbus_machine.hpp"

namespace bladefit {

/// A machine on 127.0.0.1 in a thread of its own, one client at a time.
class TcpMachine {
 public:
  TcpMachine() {
    listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    ::listen(listener_, 4);
    socklen_t length = sizeof address;
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &length);
    port = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }

  ~TcpMachine() {
    stop_ = true;
    thread_.join();
    ::close(listener_);
  }

  [[nodiscard]] ModbusSettings settings() const {
    ModbusSettings settings;
    settings.transport = ModbusTransport::tcp;
    settings.tcp = {"127.0.0.1", port};
    settings.reply_timeout = std::chrono::milliseconds(100);
    return settings;
  }

  Registers registers;
  std::uint16_t port = 0;
  std::atomic<Mischief> mischief = Mischief::none;  ///< with the next reply only
  std::atomic<bool> dumb = false;                   ///< no reply at all
  std::atomic<int> only_unit = -1;                  ///< answers no other unit identifier; -1 = answers every one
  std::atomic<int> reply_unit = -1;                 ///< stands in every reply; -1 = that of the request

 private:
  static bool readable(int descriptor) {
    pollfd entry{descriptor, POLLIN, 0};
    return ::poll(&entry, 1, 5) > 0;
  }

  void serve() {
    while (!stop_) {
      if (!readable(listener_)) continue;
      const int client = ::accept(listener_, nullptr, nullptr);
      while (!stop_ && (!readable(client) || serve_one(client))) {
      }
      ::close(client);
    }
  }

  bool serve_one(int client) {
    Bytes frame(260);
    const ssize_t size = ::recv(client, frame.data(), frame.size(), 0);
    if (size < 12) return false;
    frame.resize(static_cast<std::size_t>(size));
    if (only_unit >= 0 && frame[6] != only_unit) return true;
    const Bytes pdu = registers.answer({frame.begin() + 7, frame.end()});
    Bytes reply(frame.begin(), frame.begin() + 7);
    reply[5] = static_cast<std::uint8_t>(pdu.size() + 1);
    if (reply_unit >= 0) reply[6] = static_cast<std::uint8_t>(reply_unit.load());
    reply.insert(reply.end(), pdu.begin(), pdu.end());
    if (dumb) return true;
    switch (mischief.exchange(Mischief::none)) {
      case Mischief::silent:
        return true;
      case Mischief::hang_up:
        return false;
      case Mischief::late:
        std::this_thread::sleep_for(std::chrono::milliseconds(150));
        break;
      case Mischief::foreign_first: {
        Bytes foreign = reply;
        ++foreign[1];
        ::send(client, foreign.data(), foreign.size(), MSG_NOSIGNAL);
        break;
      }
      case Mischief::wrong_length:
        reply[5] = 200;
        break;
      case Mischief::noise_first:
      case Mischief::none:
        break;
    }
    return ::send(client, reply.data(), reply.size(), MSG_NOSIGNAL) > 0;
  }

  int listener_ = -1;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace bladefit

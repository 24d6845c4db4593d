#pragma once
#include <modbus.h>

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "drivers/modbus/modbus_frame.hpp"
#include "drivers/modbus/modbus_settings.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

enum class LinkEvent : std::uint8_t {
  pending,  ///< not yet; call again
  done,     ///< as asked
  timeout,  ///< the deadline of the transaction has passed; the link stays open
  damaged,  ///< a reply that cannot be used; the link stays open
  refused,  ///< the device answered with an exception
  unknown,  ///< the device answered that it does not know the function
  absent,   ///< the device answered that it has no such register
  busy,     ///< the device answered that it is busy
  broken,   ///< the link is closed
};

/// One transaction at a time over one link. A transaction has one absolute deadline, settings.reply_timeout after it
/// was sent. Nothing here waits longer than it is told to, but for the rest of a reply whose first byte has come.
class ModbusLink {
 public:
  using Clock = std::chrono::steady_clock;

  virtual ~ModbusLink() = default;

  /// Checks what can be checked before connecting. A failure is a phrase with the fix.
  [[nodiscard]] virtual Failure prepare() = 0;

  /// Begins to connect.
  virtual void start_connect() = 0;

  /// Goes on connecting until `until`: pending, done or broken.
  [[nodiscard]] virtual LinkEvent connect(Clock::time_point until) = 0;

  [[nodiscard]] virtual bool is_open() const = 0;

  /// Sends a request and starts its deadline: done or broken.
  [[nodiscard]] virtual LinkEvent send(const ModbusRequest& request) = 0;

  /// Waits until `until` for the reply to the request: any event. With done, what was read is in `registers`.
  [[nodiscard]] virtual LinkEvent receive(std::span<std::uint16_t> registers, Clock::time_point until) = 0;

  virtual void close() = 0;

  /// Sends a request as soon as it may and waits for its reply until `until`. Whether it came.
  [[nodiscard]] bool exchange(const ModbusRequest& request, std::span<std::uint16_t> registers,
                              Clock::time_point until);

  /// Before this moment nothing may be sent.
  [[nodiscard]] Clock::time_point ready_at() const { return ready_at_; }

  /// Another unit that answered the last request without a reply, in place of the one asked.
  [[nodiscard]] std::optional<int> other_unit() const { return other_unit_; }

  /// The newest fault, with the fix.
  [[nodiscard]] const std::string& fault() const { return fault_; }

  /// Something the user should know of an open link; empty = nothing.
  [[nodiscard]] const std::string& remark() const { return remark_; }

 protected:
  struct ContextDeleter {
    void operator()(modbus_t* context) const { modbus_free(context); }
  };

  /// Lets libmodbus receive one frame until deadline_. Returns its size, or the event in `event`.
  [[nodiscard]] std::size_t receive_frame(std::span<std::uint8_t, MODBUS_MAX_ADU_LENGTH> frame, LinkEvent& event);

  /// The deadline of the transaction has passed.
  LinkEvent timed_out(int unit, std::chrono::milliseconds timeout);

  /// Closes the link because of a fault.
  LinkEvent broken(std::string fault);

  std::unique_ptr<modbus_t, ContextDeleter> context_;
  ModbusRequest request_;
  std::optional<int> other_unit_;
  Clock::time_point deadline_{};
  Clock::time_point ready_at_{};
  std::string fault_;
  std::string remark_;
};

/// Modbus TCP or RTU, as settings.transport says.
[[nodiscard]] std::unique_ptr<ModbusLink> make_modbus_link(const ModbusSettings& settings);

}  // namespace bladefit

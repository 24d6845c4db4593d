#pragma once
#include <memory>
#include <string>
#include <vector>

#include "drivers/modbus/header_watch.hpp"
#include "drivers/modbus/link_health.hpp"
#include "drivers/modbus/modbus_link.hpp"
#include "drivers/modbus/request_schedule.hpp"
#include "drivers/modbus/ring_reader.hpp"
#include "drivers/source/acknowledgement.hpp"
#include "drivers/source/probe_source.hpp"

namespace bladefit {

/// A CMM whose points stand in a ring of Modbus registers. A state machine: every poll() goes on with the transaction
/// that is under way or begins the next one, so that it returns in time whatever the device does; it may overrun by the
/// transmission time of a reply that is being received.
class ModbusSource final : public ProbeSource {
 public:
  ModbusSource(const ModbusSettings& settings, std::string name);

  /// Takes at most about the connect timeout and ten reply timeouts. A link that breaks meanwhile is made again.
  [[nodiscard]] Failure open(std::uint32_t after, std::uint32_t run_id) override;
  [[nodiscard]] std::size_t poll(std::span<ProbePoint> points, std::chrono::milliseconds timeout) override {
    return ring_.points().wait_and_take(points, timeout, [this](Clock::time_point until) { step(until); });
  }
  void acknowledge(std::uint32_t sequence) override { acknowledgement_.store(sequence); }
  void close() override;
  [[nodiscard]] const SourceStatus& status() const override { return status_; }

 private:
  using Clock = std::chrono::steady_clock;

  /// What the transaction under way is for, or what is to be done next where none is.
  enum class Purpose : std::uint8_t { none, header, records, acknowledge, command };
  static bool writes(Purpose purpose) { return purpose == Purpose::acknowledge || purpose == Purpose::command; }

  /// How far the talk with the device has come since the link was made.
  enum class Stage : std::uint8_t { down, connecting, identify, announce, command, running };

  void step(Clock::time_point until);
  void reconnect(Clock::time_point until);
  void finish_transaction(Clock::time_point until);
  void begin_transaction(Clock::time_point until);
  [[nodiscard]] bool begin_write();
  [[nodiscard]] bool may_acknowledge() const;
  void begin_read(Clock::time_point now, Clock::time_point until);
  void begin(Purpose purpose, const ModbusRequest& request);
  void transaction_done();
  void header_read();
  void header_accepted(const CmmHeader& header);
  void identify(const CmmHeader& header);
  void records_read();
  void transaction_failed(LinkEvent event);
  void request_refused(Purpose purpose, LinkEvent event);
  [[nodiscard]] bool adapt(Purpose purpose, LinkEvent event);
  void link_lost(const std::string& fault);
  [[nodiscard]] Failure open_error(const std::string& what);
  [[nodiscard]] bool write_now(const NumberField& field, std::uint32_t value, Clock::time_point until);

  /// The transaction under way.
  struct Transaction {
    Purpose purpose = Purpose::none;
    RecordBatch batch;  ///< of purpose records
  };

  ModbusSettings settings_;  ///< its map changes where the device turns out not to know a function
  const std::string name_;
  SourceStatus status_;
  RingReader ring_;
  std::unique_ptr<ModbusLink> link_;
  LinkHealth health_;
  HeaderWatch headers_;
  RequestSchedule schedule_;
  Acknowledgement acknowledgement_;
  Stage stage_ = Stage::down;
  Transaction transaction_;
  std::vector<std::uint16_t> registers_;  ///< that the last reply brought
  std::uint16_t next_command_ = 0;        ///< to be given when the acknowledge is through; 0 = none
  bool opening_ = false;
  std::string refusal_;  ///< why the device cannot be read; empty = it can
};

}  // namespace bladefit

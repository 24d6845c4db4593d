#pragma once
#include <memory>
#include <string>
#include <vector>

#include "drivers/modbus/modbus_link.hpp"
#include "drivers/modbus/ring_reader.hpp"
#include "drivers/source/back_off.hpp"
#include "drivers/source/probe_source.hpp"

namespace bladefit {

/// A CMM whose points stand in a ring of Modbus registers. A state machine: every poll() goes on with the transaction
/// that is under way or begins the next one, so that it returns in time whatever the device does; it may stay longer by
/// the wire time of one reply whose first byte has come.
class ModbusSource final : public ProbeSource {
 public:
  ModbusSource(const ModbusSettings& settings, std::string name);
  ~ModbusSource() override;

  /// Takes at most about the connect timeout and ten reply timeouts. A link that breaks meanwhile is made again.
  [[nodiscard]] Failure open(std::uint32_t after, std::uint32_t run_id) override;
  [[nodiscard]] std::size_t poll(std::span<ProbePoint> points, std::chrono::milliseconds timeout) override;
  void acknowledge(std::uint32_t sequence) override;
  void close() override;
  [[nodiscard]] const SourceStatus& status() const override { return status_; }

 private:
  using Clock = std::chrono::steady_clock;

  /// What the transaction under way is for, or what is to be done next where none is.
  enum class Purpose : std::uint8_t { none, header, records, acknowledge, command };

  /// How far the talk with the device has come since the link was made.
  enum class Stage : std::uint8_t { down, connecting, identify, announce, command, running };

  void step(Clock::time_point until);
  void reconnect(Clock::time_point until);
  void finish_transaction(Clock::time_point until);
  void begin_transaction(Clock::time_point until);
  [[nodiscard]] bool begin_write();
  void begin_read(Clock::time_point now, Clock::time_point until);
  void begin(Purpose purpose, const ModbusRequest& request);
  void transaction_done();
  void header_read();
  void header_accepted(const CmmHeader& header);
  [[nodiscard]] bool foreign(const CmmHeader& header) const;
  void identify(const CmmHeader& header);
  void records_read();
  void transaction_failed(LinkEvent event);
  void request_refused(Purpose purpose, LinkEvent event);
  void link_lost(const std::string& fault);
  [[nodiscard]] Failure open_error(const std::string& what);
  [[nodiscard]] bool write_now(const NumberField& field, std::uint32_t value, Clock::time_point until);

  const ModbusSettings settings_;
  const std::string name_;
  SourceStatus status_;
  RingReader ring_;
  std::unique_ptr<ModbusLink> link_;
  BackOff back_off_;
  Stage stage_ = Stage::down;
  Purpose purpose_ = Purpose::none;
  RecordBatch batch_;
  std::vector<std::uint16_t> registers_;
  std::uint32_t stored_ = 0;        ///< last sequence that the host has stored
  std::uint32_t sent_ = 0;          ///< last sequence that the device knows to be stored
  std::uint32_t sending_ = 0;       ///< of the acknowledge under way
  std::uint16_t next_command_ = 0;  ///< to be given when the acknowledge is through; 0 = none
  bool opening_ = false;
  bool connected_ = false;    ///< a link was made since open()
  int headers_ = 0;           ///< good ones since open(), as far as open() counts them
  std::uint32_t run_id_ = 0;  ///< of the records that were taken; what the device tells where none were
  int foreign_headers_ = 0;   ///< headers in a row of another run
  int header_refusals_ = 0;   ///< headers in a row that check_header() refused
  int timeouts_ = 0;          ///< in a row
  std::string refusal_;       ///< why the device cannot be read; empty = it can
  Clock::time_point next_header_{};
  Clock::time_point next_read_{}, next_write_{};  ///< a refused request of the kind waits until then
  bool read_first_ = false;   ///< a refused write also waits for a read: on a slow line the time has passed at once
  bool header_last_ = false;  ///< the header has had its turn: now records have theirs
};

}  // namespace bladefit

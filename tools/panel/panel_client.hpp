#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "drivers/source/failure.hpp"
#include "firmware_bridge/host/panel/panel_map.hpp"

struct _modbus;

namespace bladefit {

/// Reads a panel over Modbus TCP. One thread owns it.
class PanelClient {
 public:
  PanelClient(std::string host, std::uint16_t port) : host_(std::move(host)), port_(port) {}

  /// Connects where it is not connected, and reads the whole map. After a failure the connection is closed, and the
  /// next call connects again. Takes at most about a second.
  [[nodiscard]] Failure read(PanelState& state);

  [[nodiscard]] std::string address() const;

 private:
  struct Closer {
    void operator()(_modbus* context) const;
  };
  [[nodiscard]] Failure connect();
  /// Fills the registers; an empty span where the panel has not all of them.
  [[nodiscard]] std::span<const std::uint16_t> read_block(std::uint16_t first,
                                                          std::span<std::uint16_t> registers) const;

  std::string host_;
  std::uint16_t port_;
  std::unique_ptr<_modbus, Closer> context_;
};

}  // namespace bladefit

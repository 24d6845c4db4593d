#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "firmware_bridge/host/panel/panel_map.hpp"

struct _modbus;

namespace bladefit {

/// Reads a panel over Modbus TCP. One thread owns it.
class PanelClient {
 public:
  PanelClient(std::string host, std::uint16_t port) : host_(std::move(host)), port_(port) {}

  /// Connects where it is not connected, and reads the whole map. Returns why that failed, in one line; empty = the
  /// state was read. After a failure the connection is closed, and the next call connects again. Takes at most about a
  /// second.
  [[nodiscard]] std::string read(PanelState& state);

  [[nodiscard]] std::string address() const;

 private:
  struct Closer {
    void operator()(_modbus* context) const;
  };
  [[nodiscard]] std::string connect();

  std::string host_;
  std::uint16_t port_;
  std::unique_ptr<_modbus, Closer> context_;
};

}  // namespace bladefit

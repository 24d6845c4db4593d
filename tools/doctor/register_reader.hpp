#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "drivers/modbus/modbus_link.hpp"
#include "drivers/modbus/modbus_settings.hpp"
#include "tools/doctor/examination.hpp"

namespace bladefit {

/// What came of a read.
struct RegisterReply {
  LinkEvent event = LinkEvent::timeout;  ///< done: they are in `registers`
  std::vector<std::uint16_t> registers;
  std::string fault;  ///< why there are none, in words

  [[nodiscard]] bool good() const { return event == LinkEvent::done; }
};

/// Reads registers of a device, each block once: what is tried later sees the same registers. Functions 3 and 4 only,
/// so that nothing in the device changes.
class RegisterReader {
 public:
  /// Nothing is waited for beyond `until`.
  RegisterReader(const ModbusSettings& settings, Deadline until);

  /// Opens the link. `bad_input` or `device`: a phrase with the fix.
  [[nodiscard]] Failure connect();

  /// Registers of the map's table. What was lost or damaged on its way is asked for three times, a link that breaks is
  /// made once more.
  [[nodiscard]] const RegisterReply& read(RegisterTable table, std::uint16_t address, std::uint16_t count);

  /// Another unit that answered in place of the one asked.
  [[nodiscard]] std::optional<int> other_unit() const { return link_->other_unit(); }

 private:
  [[nodiscard]] RegisterReply ask(const ModbusRequest& request);
  [[nodiscard]] LinkEvent exchange(const ModbusRequest& request, RegisterReply& reply);

  std::unique_ptr<ModbusLink> link_;
  Deadline until_;
  std::map<std::tuple<RegisterTable, std::uint16_t, std::uint16_t>, RegisterReply> replies_;
};

}  // namespace bladefit

#include "drivers/make_source.hpp"

#include "drivers/dro/dro_source.hpp"
#include "drivers/modbus/modbus_source.hpp"
#include "drivers/replay/replay_source.hpp"
#include "drivers/serial/serial_source.hpp"

namespace bladefit {

std::unique_ptr<ProbeSource> make_source(const SourceSettings& settings) {
  switch (settings.kind) {
    case SourceKind::none:
      break;
    case SourceKind::modbus_tcp:
    case SourceKind::modbus_rtu:
      return std::make_unique<ModbusSource>(settings);
    case SourceKind::serial:
      return std::make_unique<SerialSource>(settings);
    case SourceKind::dro:
      return std::make_unique<DroSource>(settings);
    case SourceKind::replay:
      return std::make_unique<ReplaySource>(settings.replay);
  }
  return nullptr;
}

}  // namespace bladefit

#include "tools/commands/session_source.hpp"

#include <fmt/format.h>

#include "config/device_settings.hpp"
#include "drivers/source_registry.hpp"
#include "drivers/source_uri.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {

SourceSettings source_of(const SessionSettings& session) {
  SourceSettings source;
  if (session.device) {
    if (const Failure error = load_device(*session.device, source)) throw ToolError(error);
  }
  if (session.source) {
    if (const Failure failure = apply_source_uri(*session.source, source)) throw ToolError(failure);
  }
  const SourceProtocol* const protocol = protocol_of(source);
  if (protocol == nullptr) {
    throw ToolError(
        "no source is given; name one with --source, for example modbus-tcp://192.168.0.10:502, or in the "
        "session file");
  }
  if (const std::string place = protocol->place(source); place.empty() || place.starts_with("//:")) {
    throw ToolError(fmt::format("{}: it does not say where the machine is; write it there, or name it with --source{}",
                                session.device.value_or("source"),
                                protocol->form.empty() ? std::string() : fmt::format(" {}", protocol->form)));
  }
  return source;
}

}  // namespace bladefit

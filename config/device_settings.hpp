#pragma once
#include <string>

#include "config/config_error.hpp"
#include "drivers/source_settings.hpp"

namespace bladefit {

/// Reads a device TOML such as config/devices/modbus_tcp.toml into `settings`. What the file does not say keeps the
/// value of CMM register map v1 or serial protocol v1; the units of a recording keep those of `settings`. Relative
/// paths are those of the file's folder, made ready to be used from the working directory. Errors: unreadable file,
/// TOML syntax, unknown key, wrong type, out of range, a map that contradicts itself; then `settings` is as before.
[[nodiscard]] ConfigError load_device(const std::string& path, SourceSettings& settings);

}  // namespace bladefit

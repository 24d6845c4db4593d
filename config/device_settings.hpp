#pragma once
#include <string>

#include "drivers/source/failure.hpp"
#include "drivers/source_settings.hpp"

namespace bladefit {

/// Reads a device TOML such as config/devices/modbus_tcp.toml into `settings`. What the file does not say keeps the
/// value of CMM register map v1 or serial protocol v1; the units of a recording may stay open. Relative paths are those
/// of the file's folder, made ready to be used from the working directory. bad_input: unreadable file, TOML syntax,
/// unknown key, wrong type, out of range, a map that contradicts itself; then `settings` is as before.
[[nodiscard]] Failure load_device(const std::string& path, SourceSettings& settings);

}  // namespace bladefit

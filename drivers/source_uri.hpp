#pragma once
#include <string>
#include <string_view>

#include "drivers/source/failure.hpp"
#include "drivers/source_settings.hpp"

namespace bladefit {

/// Puts what a source URI says into `settings` and leaves the rest as it is, so that a device file may be read first:
/// source_uri_forms() names them, such as modbus-tcp://HOST:PORT or serial:DEVICE.
/// A `serial:` URI keeps the format `dro` of a device file. bad_input: one line that names the part and the fix; then
/// `settings` is as before.
[[nodiscard]] Failure apply_source_uri(std::string_view uri, SourceSettings& settings);

/// The source as it is named in messages, as in modbus-tcp://HOST:PORT or dro:DEVICE.
[[nodiscard]] std::string source_name(const SourceSettings& settings);

}  // namespace bladefit

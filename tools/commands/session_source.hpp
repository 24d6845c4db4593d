#pragma once
#include "config/session_settings.hpp"
#include "drivers/source_settings.hpp"

namespace bladefit {

/// Where the points of a session come from: its device file, and its source URI, which wins. Throws ToolError that
/// names the file or the option and the fix, also where nothing says what the machine is, or where it is.
[[nodiscard]] SourceSettings source_of(const SessionSettings& session);

}  // namespace bladefit

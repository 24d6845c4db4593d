#pragma once
#include <string>
#include <vector>

#include "firmware_bridge/host/host.hpp"

namespace bladefit {

/// verdicts.csv: one line a point, lengths in mm, distances and feet in the design frame, x, y, z as measured. Numbers
/// are written so that they read back as the same bits.
[[nodiscard]] std::string verdicts_csv(const SessionResult& result);

/// Writes verdicts.csv and result.json into the session folder, each as a whole or not at all, and returns their paths.
/// Throws ToolError (device).
std::vector<std::string> write_session_files(const std::string& session_directory, const SessionResult& result,
                                             const std::string& json);

}  // namespace bladefit

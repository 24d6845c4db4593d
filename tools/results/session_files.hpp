#pragma once
#include <string>
#include <vector>

#include "tools/results/result.hpp"

namespace bladefit {

/// Writes verdicts.csv and result.json into the session folder, each as a whole or not at all, and returns their paths.
/// Throws ToolError (device).
std::vector<std::string> write_session_files(const std::string& directory, const Result& result);

/// Reads result.json and verdicts.csv of a session folder and checks that they are whole, belong together and tell of
/// every point in the journal. Throws ToolError (bad_input) that names the file and the fix, also where the session
/// still runs or was cut off.
[[nodiscard]] Result read_session(const std::string& directory);

}  // namespace bladefit

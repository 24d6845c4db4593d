#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace bladefit {

/// The faces of design files as a table, one line each: number, name, layer, kind, size and degree of the control net,
/// area, middle, what their trim leaves out, and the faces whose edges they share; then the
/// blades, where these repeat about an axis. Throws ToolError as read_design
/// does.
[[nodiscard]] std::string design_list(const std::vector<std::filesystem::path>& paths);

}  // namespace bladefit

#pragma once
#include <string>

namespace bladefit {

/// The panel's register map as a table, made from the fields that the server sends: address counted from 0, number in
/// the manner 3xxxxx, 4xxxxx (1xxxxx discrete inputs, 0xxxxx coils), registers, type, unit, name, meaning.
[[nodiscard]] std::string panel_map_csv();
[[nodiscard]] std::string panel_map_markdown();

}  // namespace bladefit

#pragma once
#include <optional>
#include <string>
#include <vector>

#include "config/table_reader.hpp"
#include "config/zone_settings.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

/// Reads the tables [[zone]] of a file, in their order; what is wrong in them is kept in the reader's document. Nothing
/// where there is none.
void read_zone_tables(TableReader& root, std::optional<std::vector<ZoneSettings>>& zones);

/// Reads the tables [[zone]] of a file, whatever else is in it. Errors: as load_fit(), and a file without one.
[[nodiscard]] Failure load_zones(const std::string& path, std::optional<std::vector<ZoneSettings>>& zones);

}  // namespace bladefit

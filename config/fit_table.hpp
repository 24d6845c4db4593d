#pragma once
#include "config/fit_settings.hpp"
#include "config/table_reader.hpp"

namespace bladefit {

/// Reads the table [fit]; what is wrong in it is kept in the reader's document.
void read_fit_table(TableReader& table, FitSettings& settings);

}  // namespace bladefit

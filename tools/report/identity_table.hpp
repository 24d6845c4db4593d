#pragma once
#include <cstddef>
#include <string>

#include "tools/results/result.hpp"

namespace bladefit {

/// What blade it is, who measured it and when, by what and by which design: labels with texts, two of them a row.
[[nodiscard]] std::string identity_table(const Result& result);

/// Its rows.
[[nodiscard]] std::size_t identity_rows(const Result& result);

/// The files that the result rests on, with sizes and checksums; empty where no file says.
[[nodiscard]] std::string files_table(const Result& result);

}  // namespace bladefit

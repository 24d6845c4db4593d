#pragma once
#include <string>

#include "tools/files/output_file.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// result.json: UTF-8 text with a final newline, lengths in the result's units. Numbers are written so that they read
/// back as the same bits.
[[nodiscard]] std::string result_json(const Result& result);

/// The same, point by point: a session may have hundreds of thousands.
void write_result_json(const Result& result, const Put& put);

}  // namespace bladefit

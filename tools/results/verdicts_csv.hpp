#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "tools/files/output_file.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// verdicts.csv: one line a point, lengths in mm, distances and feet in the design frame, x, y, z as measured. Numbers
/// are written so that they read back as the same bits.
[[nodiscard]] std::string verdicts_csv(const Rows<ResultPoint>& points);

/// The same, line by line.
void write_verdicts_csv(const Rows<ResultPoint>& points, const Put& put);

/// Reads the text of a verdicts.csv, of which `path` is the name in errors. Throws ToolError (bad_input) that names the
/// line, the column and the fix.
[[nodiscard]] Rows<ResultPoint> parse_verdicts(const std::string& path, std::string_view text);

}  // namespace bladefit

#include "tools/report/json_report.hpp"

#include "tools/results/json_writer.hpp"

namespace bladefit {

std::string json_report(const Result& result) { return result.text.empty() ? result_json(result) : result.text; }

}  // namespace bladefit

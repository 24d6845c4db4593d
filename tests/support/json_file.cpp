#include "tests/support/json_file.hpp"

#include "tests/support/scratch_folder.hpp"

namespace bladefit::testing {

nlohmann::json read_json(const std::filesystem::path& path) { return parse_json(read_whole(path)); }
nlohmann::json parse_json(const std::string& text) { return nlohmann::json::parse(text); }

int exit_code_of_verdict(const nlohmann::json& result) {
  const std::string state = result.at("verdict").at("state");
  if (state == "out_of_tolerance") return 1;
  return state == "not_decided" ? 4 : 0;
}

}  // namespace bladefit::testing

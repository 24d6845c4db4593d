#include "tests/support/json_file.hpp"

#include "tests/support/scratch_folder.hpp"

namespace bladefit::testing {

nlohmann::json read_json(const std::filesystem::path& path) { return parse_json(read_whole(path)); }
nlohmann::json parse_json(const std::string& text) { return nlohmann::json::parse(text); }

}  // namespace bladefit::testing

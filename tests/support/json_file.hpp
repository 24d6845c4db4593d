#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace bladefit::testing {

/// The content of a JSON file, or of a text. Here, since the parser takes seconds to compile. Throw what it throws.
nlohmann::json read_json(const std::filesystem::path& path);
nlohmann::json parse_json(const std::string& text);

}  // namespace bladefit::testing

#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace bladefit::testing {

/// The content of a JSON file, or of a text. Here, since the parser takes seconds to compile. Throw what it throws.
nlohmann::json read_json(const std::filesystem::path& path);
nlohmann::json parse_json(const std::string& text);

/// The exit code that belongs to the verdict of a result.json: 0 in tolerance or not judged, 1 out of tolerance, 4 not
/// decided.
int exit_code_of_verdict(const nlohmann::json& result);

}  // namespace bladefit::testing

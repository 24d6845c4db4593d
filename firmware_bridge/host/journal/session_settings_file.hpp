#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/localizer.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

/// The settings of a session as text: a line `name = value` for each that enters config_digest(), and that digest.
[[nodiscard]] std::string settings_text(const LocalizerConfig& config, std::uint32_t path_refine_points);

/// The names and values of such a text, in its order.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> named_settings(const std::string& text);

/// Writes the text to the session's folder, on disk when this returns.
[[nodiscard]] Failure write_settings(const std::string& session_directory, const std::string& text);

/// Which settings differ between those that a session of `digest` was started with and `text`, in words: "ratio was 10
/// and is 2". Empty where the folder has no settings of that digest.
[[nodiscard]] std::string differing_settings(const std::string& session_directory, std::uint64_t digest,
                                             const std::string& text);

}  // namespace bladefit

#pragma once
#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace bladefit {

/// What was found in a file, for a message: its first 60 bytes at most, cut between characters of UTF-8; "..." follows
/// a cut. Control characters become blanks.
[[nodiscard]] std::string excerpt(std::string_view found);

/// One line of what a file's syntax error is: "line: what stands there; what to do". The line is the one at which the
/// parser could not go on. Cost: one pass over the text.
[[nodiscard]] std::string toml_error_text(std::string_view text, const toml::parse_error& error);

}  // namespace bladefit

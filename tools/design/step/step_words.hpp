#pragma once
#include <string>
#include <string_view>

namespace bladefit {

/// What is wrong with the parameters of an entity or typed value that OpenCASCADE would read as something else without
/// a word: more coordinates than three, of which it takes the first (a decimal comma), several numbers in a measure, a
/// prefix or name of a unit that there is none of, of which it takes metres. `rest` is the text behind `word`. Empty
/// where nothing is.
[[nodiscard]] std::string step_word_fault(std::string_view word, std::string_view rest);

}  // namespace bladefit

#include "tools/design/step/step_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "tools/design/step/step_references.hpp"
#include "tools/design/step/step_words.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr std::string_view kFirst = "ISO-10303-21;";
constexpr std::string_view kLast = "END-ISO-10303-21;";
/// White space, and the end-of-file characters that some systems append.
constexpr std::string_view kBlank{" \t\r\n\f\v\x1a\0", 8};
/// Parentheses inside each other: real files have less than ten, and the library's parser needs memory for each.
constexpr int kMaxDepth = 100;
constexpr std::size_t kQuoted = 40;

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_word_start(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '!'; }
bool is_word(char c) { return is_word_start(c) || is_digit(c) || c == '-'; }
bool is_number(char c) { return is_word(c) || c == '.' || c == '+'; }

/// Walks through the text token by token and copies it, reals as OpenCASCADE wants them.
class TokenScanner {
 public:
  TokenScanner(std::string_view text, const std::string& file) : text_(text), file_(file), references_(file) {}

  /// Throws ToolError at the first fault.
  std::string clean() {
    result_.reserve(text_.size());
    while (place_ < text_.size()) step();
    if (depth_ != 0) fail("the last statement does not end");
    references_.check();
    result_ += text_.substr(copied_);
    return std::move(result_);
  }

 private:
  void step() {
    const char c = text_[place_];
    const char next = place_ + 1 < text_.size() ? text_[place_ + 1] : ' ';
    if (c == '\'') return skip_past("'", "string");
    if (c == '"') return skip_past("\"", "binary number");
    if (c == '/' && next == '*') return skip_past("*/", "comment");
    if (c == '.' && is_word_start(next)) return skip_past(".", "enumeration");
    if (c == '#') return take_instance();
    if (is_word_start(c)) return take_word();
    if (is_digit(c) || c == '-' || c == '+' || c == '.') return take_number();
    count_parentheses(c);
    if (c == '=' && depth_ == 0 && last_instance_ != 0) references_.define(last_instance_, line_);
    if (c == ';') last_instance_ = 0;
    if (c == '\n') ++line_;
    ++place_;
  }

  void count_parentheses(char c) {
    if (c == '(' && ++depth_ > kMaxDepth) fail(fmt::format("more than {} parentheses inside each other", kMaxDepth));
    if (c == ')') --depth_;
    if (depth_ < 0 || (c == ';' && depth_ != 0)) fail("parentheses do not match in the statement that ends here");
  }

  void take_word() {
    const std::size_t first = place_;
    take_while(is_word, 0);
    const std::string fault = step_word_fault(text_.substr(first, place_ - first), text_.substr(place_));
    if (!fault.empty()) fail(fault);
  }

  template <class Belongs>
  void take_while(Belongs belongs, std::size_t skip) {
    place_ += skip;
    while (place_ < text_.size() && belongs(text_[place_])) ++place_;
  }

  /// #12 at the beginning of a statement is its number, inside of parentheses a reference.
  void take_instance() {
    const std::size_t first = place_ + 1;
    take_while(is_digit, 1);
    std::uint32_t number = 0;
    const auto [stop, error] = std::from_chars(text_.data() + first, text_.data() + place_, number);
    const bool fits = error == std::errc() && number <= std::uint32_t{std::numeric_limits<std::int32_t>::max()};
    if (place_ == first) return;
    if (!fits) {
      fail(fmt::format("#{} is not a number that an instance can have",
                       text_.substr(first, std::min(place_ - first, kQuoted))));
    }
    if (depth_ == 0) {
      last_instance_ = number;
    } else {
      references_.refer(number, line_);
    }
  }

  void take_number() {
    const std::size_t first = place_;
    take_while(is_number, 1);
    const std::string_view word = text_.substr(first, place_ - first);
    const char* begin = word.data() + (word.front() == '+' ? 1 : 0);
    const char* end = word.data() + word.size();
    double value = 0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value)) {
      fail(fmt::format("\"{}\" is not a finite number", word.substr(0, kQuoted)));
    }
    const std::size_t exponent = word.find_first_of("eE");
    if (exponent == std::string_view::npos) return;
    const bool pointed = word.substr(0, exponent).find('.') != std::string_view::npos;
    if (pointed && word[exponent] == 'E') return;
    result_ += text_.substr(copied_, first - copied_);
    result_ += fmt::format("{}{}E{}", word.substr(0, exponent), pointed ? "" : ".", word.substr(exponent + 1));
    copied_ = place_;
  }

  void skip_past(std::string_view end, const char* what) {
    const std::size_t stop = text_.find(end, place_ + end.size());
    if (stop == std::string_view::npos) fail(fmt::format("a {} does not end", what));
    const std::string_view skipped = text_.substr(place_, stop - place_);
    line_ += static_cast<std::size_t>(std::count(skipped.begin(), skipped.end(), '\n'));
    place_ = stop + end.size();
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw ToolError(fmt::format("{}: line {}: {}; export the design again", file_, line_, what));
  }

  std::string_view text_;
  const std::string& file_;
  StepReferences references_;
  std::string result_;
  std::size_t place_ = 0, copied_ = 0, line_ = 1;
  std::uint32_t last_instance_ = 0;
  int depth_ = 0;
};

}  // namespace

std::string clean_step_text(std::string_view text, const std::string& file) {
  const std::string_view body = without_blanks(text);
  if (body.empty()) throw ToolError(fmt::format("{}: the file is empty; export the design again", file));
  if (body.substr(0, kFirst.size()) != kFirst) {
    throw ToolError(
        fmt::format("{}: line 1: not a STEP file: it does not begin with {}; give a STEP (.stp, .step) or "
                    "IGES (.igs, .iges) file",
                    file, kFirst));
  }
  if (body.size() < kLast.size() || body.substr(body.size() - kLast.size()) != kLast) {
    const auto lines = std::count(body.begin(), body.end(), '\n') + 1;
    throw ToolError(fmt::format("{}: line {}: the file is truncated: it does not end with {}; export the design again",
                                file, lines, kLast));
  }
  if (body.find("DATA;") == std::string_view::npos) {
    throw ToolError(fmt::format("{}: the file has no DATA section; export the design again", file));
  }
  return TokenScanner(text.substr(0, text.find_last_not_of(kBlank) + 1), file).clean();
}

}  // namespace bladefit

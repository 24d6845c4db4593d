#include "tools/design/step_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/design/design_error.hpp"

namespace bladefit {
namespace {

constexpr std::string_view kFirst = "ISO-10303-21;";
constexpr std::string_view kLast = "END-ISO-10303-21;";
/// White space, and the end-of-file characters that some systems append.
constexpr std::string_view kBlank{" \t\r\n\f\v\x1a\0", 8};

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// Walks through text outside of strings and comments, statement by statement.
class StatementScanner {
 public:
  StatementScanner(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  /// Throws where a statement ends with open parentheses, or a string or comment does not end.
  void check() {
    while (place_ < text_.size()) step();
    if (depth_ != 0) fail("the last statement does not end");
  }

 private:
  void step() {
    const char c = text_[place_];
    if (c == '\n') ++line_;
    if (c == '\'') return skip_past("'", "string");
    if (text_.substr(place_, 2) == "/*") return skip_past("*/", "comment");
    if (c == '(') ++depth_;
    if (c == ')') --depth_;
    if (depth_ < 0 || (c == ';' && depth_ != 0)) fail("parentheses do not match in the statement that ends here");
    ++place_;
  }

  void skip_past(std::string_view end, const char* what) {
    const std::size_t stop = text_.find(end, place_ + 1);
    if (stop == std::string_view::npos) fail(fmt::format("a {} does not end", what));
    line_ += static_cast<std::size_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(place_),
                                                 text_.begin() + static_cast<std::ptrdiff_t>(stop), '\n'));
    place_ = stop + end.size();
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw DesignError(fmt::format("{}: line {}: {}; export the design again", file_, line_, what));
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t place_ = 0, line_ = 1;
  int depth_ = 0;
};

}  // namespace

void check_step_text(std::string_view text, const std::string& file) {
  const std::string_view body = trimmed(text);
  if (body.empty()) throw DesignError(fmt::format("{}: the file is empty; export the design again", file));
  if (body.substr(0, kFirst.size()) != kFirst) {
    throw DesignError(
        fmt::format("{}: line 1: not a STEP file: it does not begin with {}; give a STEP (.stp, .step) or "
                    "IGES (.igs, .iges) file",
                    file, kFirst));
  }
  if (body.size() < kLast.size() || body.substr(body.size() - kLast.size()) != kLast) {
    const auto lines = std::count(body.begin(), body.end(), '\n') + 1;
    throw DesignError(fmt::format(
        "{}: line {}: the file is truncated: it does not end with {}; export the design again", file, lines, kLast));
  }
  if (body.find("DATA;") == std::string_view::npos) {
    throw DesignError(fmt::format("{}: the file has no DATA section; export the design again", file));
  }
  StatementScanner(text.substr(0, text.find_last_not_of(kBlank) + 1), file).check();
}

}  // namespace bladefit

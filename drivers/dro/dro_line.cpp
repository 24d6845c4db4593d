#include "drivers/dro/dro_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "drivers/text/text_number.hpp"
#include "drivers/text/units.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kLongestNumber = 64;
constexpr std::string_view kLineBlanks = " \t";
constexpr std::string_view kAxisLetters = "xyz";

bool is_digit(char character) { return character >= '0' && character <= '9'; }
bool is_sign(char character) { return character == '+' || character == '-'; }
char lower(char character) { return static_cast<char>(std::tolower(static_cast<unsigned char>(character))); }

/// Marks behind a number that tell its unit, in lower case, a longer one before its beginning.
constexpr std::array<std::string_view, 5> kUnitMarks = {word_of(Unit::mm), "inch", word_of(Unit::inch), "\"", "''"};

/// The unit that has this size.
std::string_view unit_word(double mm) {
  return kUnitWords[static_cast<std::size_t>(std::ranges::find(kMmPerUnit, mm) - kMmPerUnit.begin())];
}

class LineParser {
 public:
  LineParser(std::string_view text, const DroSettings& settings) : rest_(text), settings_(settings) {}

  Failure read(DroLine& line) { return settings_.labels ? read_labelled(line) : read_ordered(line); }

 private:
  Failure read_labelled(DroLine& line);
  Failure read_ordered(DroLine& line);
  Failure take_number(std::size_t axis, DroNumber& number);
  Failure take_marks(std::size_t axis, DroNumber& number);
  Failure check_end(const DroLine& line) const;
  [[nodiscard]] Failure check_decimal_mark(std::size_t axis, const DroNumber& number) const;
  [[nodiscard]] std::string take_digits(DroNumber& number);

  [[nodiscard]] char peek() const { return rest_.empty() ? '\0' : rest_.front(); }
  [[nodiscard]] bool at_label() const {
    return settings_.labels && kAxisLetters.find(lower(peek())) < kAxisLetters.size();
  }

  std::size_t skip(std::string_view characters) {
    const std::size_t count = std::min(rest_.find_first_not_of(characters), rest_.size());
    rest_.remove_prefix(count);
    return count;
  }

  std::string_view rest_;
  const DroSettings& settings_;
};

Failure LineParser::read_labelled(DroLine& line) {
  while (true) {
    skip(settings_.separators);
    if (rest_.empty()) return check_end(line);
    if (line.count() == 3) return bad_input("there is more than three numbers");
    if (!at_label()) {
      const std::size_t missing = static_cast<std::size_t>(
          std::ranges::find_if(line.axes, [](const auto& axis) { return !axis; }) - line.axes.begin());
      return bad_input(fmt::format("the label {} is missing", axis_letter(missing)));
    }
    const std::size_t axis = kAxisLetters.find(lower(peek()));
    if (line.axes[axis]) return bad_input(fmt::format("{} stands in the line twice", axis_letter(axis)));
    rest_.remove_prefix(1);
    DroNumber number;
    if (Failure failure = take_number(axis, number)) return failure;
    line.axes[axis] = std::move(number);
  }
}

Failure LineParser::read_ordered(DroLine& line) {
  for (const char letter : settings_.order) {
    const std::size_t axis = kAxisLetters.find(letter);
    const bool first = line.count() == 0;
    const std::string_view before = rest_;
    DroNumber number;
    if (Failure failure = take_number(axis, number)) return failure;
    if (first)
      line.shows_its_beginning = !before.empty() && !is_digit(before[0]) && before[0] != settings_.decimal_mark;
    line.axes[axis] = std::move(number);
  }
  skip(settings_.separators);
  return rest_.empty() ? Failure{} : bad_input("there is more than three numbers");
}

Failure LineParser::check_end(const DroLine& line) const {
  const bool one_allowed = settings_.layout != DroLayout::whole_points;
  const bool three_allowed = settings_.layout != DroLayout::single_axes;
  const std::size_t count = line.count();
  if ((count == 1 && one_allowed) || (count == 3 && three_allowed)) return {};
  if (!three_allowed) return bad_input("the line must have one axis");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!line.axes[axis]) return bad_input(fmt::format("the label {} is missing", axis_letter(axis)));
  }
  return {};
}

/// The digits with a decimal point, whatever the mark is.
std::string LineParser::take_digits(DroNumber& number) {
  std::string text;
  const auto take_run = [&](std::size_t& digits) {
    while (is_digit(peek()) && text.size() < kLongestNumber) {
      text += peek();
      rest_.remove_prefix(1);
      ++digits;
    }
  };
  take_run(number.whole_digits);
  number.zero_padded = number.whole_digits > 1 && text[0] == '0';
  if (peek() == settings_.decimal_mark) {
    number.marked = true;
    text += '.';
    rest_.remove_prefix(1);
    take_run(number.decimals);
  }
  return number.whole_digits + number.decimals > 0 ? text : std::string();
}

Failure LineParser::check_decimal_mark(std::size_t axis, const DroNumber& number) const {
  const char other = settings_.decimal_mark == '.' ? ',' : '.';
  const bool separates = !settings_.labels && settings_.separators.find(other) != std::string::npos;
  if (!separates && peek() == other && rest_.size() > 1 && is_digit(rest_[1])) {
    return bad_input(
        fmt::format("a '{}' stands within the number for {} (set decimal_mark = \"{}\" and take it out of separators)",
                    other, axis_letter(axis), other));
  }
  if (settings_.scale && number.marked)
    return bad_input(fmt::format("{} has a decimal mark (leave scale out)", axis_letter(axis)));
  return {};
}

Failure LineParser::take_number(std::size_t axis, DroNumber& number) {
  number.pad = skip(settings_.separators);
  const bool has_sign = is_sign(peek());
  const bool negative = peek() == '-';
  if (has_sign) {
    rest_.remove_prefix(1);
    number.pad += skip(kLineBlanks);
  }
  const std::string digits = take_digits(number);
  number.width = number.pad + (has_sign ? 1U : 0U) + digits.size();
  const std::optional<double> value = parse_finite(digits);
  if (!value) return bad_input(fmt::format("no number stands for {}", axis_letter(axis)));
  if (Failure failure = check_decimal_mark(axis, number)) return failure;
  number.mm = (negative ? -*value : *value) * settings_.scale.value_or(1) * settings_.mm_per_unit;
  if (!std::isfinite(number.mm)) return bad_input(fmt::format("no number stands for {}", axis_letter(axis)));
  return take_marks(axis, number);
}

/// What stands behind a number up to the next one.
Failure LineParser::take_marks(std::size_t axis, DroNumber& number) {
  while (true) {
    const std::string_view before = rest_;
    skip(settings_.separators);
    const char next = peek();
    if (next == '\0' || is_digit(next) || is_sign(next) || next == settings_.decimal_mark || at_label()) {
      rest_ = before;
      return {};
    }
    const auto mark = std::ranges::find_if(kUnitMarks, [this](std::string_view word) {
      return word.size() <= rest_.size() && std::ranges::equal(word, rest_.substr(0, word.size()), {}, {}, lower);
    });
    if (mark != kUnitMarks.end()) {
      const Unit unit = parse_unit(*mark).value();
      if (mm_per_unit(unit) != settings_.mm_per_unit) {
        return bad_input(fmt::format("{} is marked {}, but units are {} (set units = \"{}\", or switch the read-out)",
                                     axis_letter(axis), *mark, unit_word(settings_.mm_per_unit), word_of(unit)));
      }
      number.marks += word_of(unit);
      rest_.remove_prefix(mark->size());
    } else if (settings_.marks.find(next) != std::string::npos) {
      number.marks += next;
      rest_.remove_prefix(1);
    } else if (lower(next) == 'd') {
      return bad_input(fmt::format("{} is marked {}, a diameter or a distance to go (switch the read-out to radius)",
                                   axis_letter(axis), next));
    } else {
      return bad_input(fmt::format("the mark '{}' behind {} is unknown (name it in marks if it changes nothing)",
                                   std::isprint(static_cast<unsigned char>(next)) != 0 ? next : '.',
                                   axis_letter(axis)));
    }
  }
}

}  // namespace

std::size_t DroLine::count() const {
  return static_cast<std::size_t>(std::ranges::count_if(axes, [](const auto& axis) { return axis.has_value(); }));
}

std::size_t DroLine::first_axis() const {
  return static_cast<std::size_t>(std::ranges::find_if(axes, [](const auto& axis) { return axis.has_value(); }) -
                                  axes.begin());
}

char axis_letter(std::size_t axis) {
  return static_cast<char>(std::toupper(static_cast<unsigned char>(kAxisLetters[axis])));
}

Failure parse_dro_line(std::string_view text, const DroSettings& settings, DroLine& line) {
  DroLine read;
  if (Failure failure = LineParser(text, settings).read(read)) return failure;
  line = std::move(read);
  return {};
}

}  // namespace bladefit

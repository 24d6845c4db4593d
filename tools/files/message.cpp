#include "tools/files/message.hpp"

#include <algorithm>
#include <cstdio>

namespace bladefit {
namespace {

constexpr std::size_t kLongest = 280, kLongestWord = 100;
constexpr std::string_view kCut = "...";

/// A byte that goes on with a character of UTF-8.
bool goes_on(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// The first and the last characters of what is longer than `most`, more of the last.
std::string without_middle(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  std::size_t front = most / 3, back = most - front - kCut.size();
  while (front > 0 && goes_on(text[front])) --front;
  while (back > 0 && goes_on(text[text.size() - back])) --back;
  return std::string(text.substr(0, front)) + std::string(kCut) + std::string(text.substr(text.size() - back));
}

}  // namespace

std::string one_line(std::string_view message) {
  std::string line(message);
  std::ranges::replace_if(
      line, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7F'; }, ' ');
  if (line.size() <= kLongest) return line;
  std::string shortened;
  for (std::string_view rest = line; !rest.empty();) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    shortened += without_middle(rest.substr(0, end), kLongestWord);
    if (end < rest.size()) shortened += ' ';
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return without_middle(shortened, kLongest);
}

void tell(std::string_view message) { std::fputs(("bladefit: " + one_line(message) + "\n").c_str(), stderr); }

}  // namespace bladefit

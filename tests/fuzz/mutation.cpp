#include "tests/fuzz/mutation.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace bladefit::fuzz {
namespace {

/// What stands where nobody expects it.
constexpr std::array<std::string_view, 44> kTokens = {
    "0",
    "-1",
    "1e308",
    "1e309",
    "-0",
    "nan",
    "inf",
    "0x10",
    "1,5",
    "1.5.2",
    "99999999999999999999",
    "1E5",
    "1.D5",
    "1e",
    "+-1",
    "--1",
    "#",
    "$",
    "*",
    "\"",
    "'",
    "()",
    "((((",
    "))))",
    "[[[[",
    "a.a.a",
    "\r",
    "\n",
    "\r\n",
    "\t",
    ";",
    ",",
    "\x1A",
    "\xFF\xFE",
    "\xEF\xBB\xBF",
    "\x7F",
    "mm",
    " in",
    "sep=;\n",
    "/*",
    "*/",
    "1H,",
    "4294967296",
    "=",
};

std::size_t below(std::size_t limit, std::mt19937_64& random) { return limit == 0 ? 0 : random() % limit; }

/// A number that stands in the text near to a place, or what stands there where there is none.
std::pair<std::size_t, std::size_t> number_near(const std::string& text, std::size_t place) {
  constexpr std::string_view kOfNumbers = "0123456789.+-eE";
  const std::size_t begin = std::min(text.find_first_of(kOfNumbers, place), text.size());
  return {begin, std::min(text.find_first_not_of(kOfNumbers, begin), text.size()) - begin};
}

void change(std::string& text, std::span<const std::string> corpus, std::mt19937_64& random) {
  const std::size_t place = below(text.size() + 1, random);
  const std::size_t most = text.size() - place;
  const std::size_t length = std::min(most, below(3, random) == 0 ? below(most + 1, random) : below(12, random));
  const std::string token(kTokens[below(kTokens.size(), random)]);
  switch (below(9, random)) {
    case 0:
      if (most > 0) text[place] = static_cast<char>(static_cast<unsigned char>(text[place]) ^ (1U << below(8, random)));
      return;
    case 1:
      if (most > 0) text[place] = static_cast<char>(random());
      return;
    case 2:
      text.erase(place, length);
      return;
    case 3:
      text.insert(place, text.substr(place, length));
      return;
    case 4:
      text.insert(place, token);
      return;
    case 5: {
      const auto [begin, size] = number_near(text, place);
      text.replace(begin, size, token);
      return;
    }
    case 6: {
      const std::string& other = corpus[below(corpus.size(), random)];
      const std::size_t from = below(other.size() + 1, random);
      text.replace(place, length, other, from, below(std::min<std::size_t>(other.size() - from, 4096) + 1, random));
      return;
    }
    case 7:
      text.resize(place);
      return;
    default: {
      const std::size_t times = below(2000, random);
      std::string many;
      for (std::size_t k = 0; k < times; ++k) many += token;
      text.insert(place, many);
    }
  }
}

}  // namespace

std::string mutated(std::string input, std::span<const std::string> corpus, std::mt19937_64& random) {
  const std::size_t changes = 1 + below(8, random);
  for (std::size_t k = 0; k < changes; ++k) change(input, corpus, random);
  if (input.size() > kLongestInput) input.resize(kLongestInput);
  return input;
}

}  // namespace bladefit::fuzz

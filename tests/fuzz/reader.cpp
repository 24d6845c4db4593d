#include "tests/fuzz/reader.hpp"

#include <algorithm>
#include <array>

namespace bladefit::fuzz {

std::span<const Reader> readers() {
  static const std::array<Reader, 12> all = {kPoints,     kReadout, kSerial, kDeviceFile, kSessionFile, kZonesFile,
                                             kStartPairs, kStep,    kIges,   kJournal,    kSalvage,     kImage};
  return all;
}

std::string broken_words(const std::string& refusal) {
  constexpr std::size_t kLongest = 300;
  if (refusal.size() > kLongest) return "the refusal is " + std::to_string(refusal.size()) + " characters long";
  const auto lines = std::ranges::count(refusal, '\n');
  if (lines > 0) return "the refusal has several lines";
  for (const std::string_view word :
       {"std::", "basic_string", "vector::", "stoi:", "stoi(", "stod:", "stod(", "what()", "exception"}) {
    if (refusal.find(word) != std::string::npos) return "the refusal speaks of " + std::string(word);
  }
  return "";
}

}  // namespace bladefit::fuzz

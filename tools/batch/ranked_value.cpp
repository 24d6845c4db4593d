#include "tools/batch/ranked_value.hpp"

#include <bit>
#include <cstdint>
#include <vector>

namespace bladefit {
namespace {

constexpr int kDigitBits = 16;
constexpr std::uint64_t kDigits = std::uint64_t{1} << kDigitBits;

}  // namespace

// Numbers that are not negative rise with their bits.
double ranked_value(std::size_t rank, const EachNumber& each) {
  std::uint64_t found = 0;
  for (int shift = 64 - kDigitBits; shift >= 0; shift -= kDigitBits) {
    std::vector<std::uint32_t> counts(kDigits);
    each([&](double number) {
      const std::uint64_t digits = std::bit_cast<std::uint64_t>(number) >> static_cast<unsigned>(shift);
      if (digits / kDigits == found) ++counts[digits % kDigits];
    });
    std::uint64_t digit = 0;
    for (; digit + 1 < kDigits && rank >= counts[digit]; ++digit) rank -= counts[digit];
    found = found * kDigits + digit;
  }
  return std::bit_cast<double>(found);
}

}  // namespace bladefit

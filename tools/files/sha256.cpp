#include "tools/files/sha256.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace bladefit {
namespace {

using Words = std::array<std::uint32_t, 8>;
constexpr std::size_t kBlock = 64, kLengthBytes = 8, kRounds = 64;

/// First 32 bits of the fractions of the square roots of the first 8 primes, and of the cube roots of the first 64.
constexpr Words kStart = {0x6a09e667U, 0xbb67ae85U, 0x3c6ef372U, 0xa54ff53aU,
                          0x510e527fU, 0x9b05688cU, 0x1f83d9abU, 0x5be0cd19U};
constexpr std::array<std::uint32_t, kRounds> kRoundWords = {
    0x428a2f98U, 0x71374491U, 0xb5c0fbcfU, 0xe9b5dba5U, 0x3956c25bU, 0x59f111f1U, 0x923f82a4U, 0xab1c5ed5U,
    0xd807aa98U, 0x12835b01U, 0x243185beU, 0x550c7dc3U, 0x72be5d74U, 0x80deb1feU, 0x9bdc06a7U, 0xc19bf174U,
    0xe49b69c1U, 0xefbe4786U, 0x0fc19dc6U, 0x240ca1ccU, 0x2de92c6fU, 0x4a7484aaU, 0x5cb0a9dcU, 0x76f988daU,
    0x983e5152U, 0xa831c66dU, 0xb00327c8U, 0xbf597fc7U, 0xc6e00bf3U, 0xd5a79147U, 0x06ca6351U, 0x14292967U,
    0x27b70a85U, 0x2e1b2138U, 0x4d2c6dfcU, 0x53380d13U, 0x650a7354U, 0x766a0abbU, 0x81c2c92eU, 0x92722c85U,
    0xa2bfe8a1U, 0xa81a664bU, 0xc24b8b70U, 0xc76c51a3U, 0xd192e819U, 0xd6990624U, 0xf40e3585U, 0x106aa070U,
    0x19a4c116U, 0x1e376c08U, 0x2748774cU, 0x34b0bcb5U, 0x391c0cb3U, 0x4ed8aa4aU, 0x5b9cca4fU, 0x682e6ff3U,
    0x748f82eeU, 0x78a5636fU, 0x84c87814U, 0x8cc70208U, 0x90befffaU, 0xa4506cebU, 0xbef9a3f7U, 0xc67178f2U};

std::array<std::uint32_t, kRounds> schedule_of(std::string_view block) {
  std::array<std::uint32_t, kRounds> w{};
  for (std::size_t k = 0; k < kBlock; ++k)
    w.at(k / 4) = w.at(k / 4) << 8U | static_cast<std::uint32_t>(static_cast<unsigned char>(block[k]));
  for (std::size_t k = 16; k < kRounds; ++k) {
    const std::uint32_t a = w.at(k - 15), b = w.at(k - 2);
    const std::uint32_t small = std::rotr(a, 7) ^ std::rotr(a, 18) ^ a >> 3U;
    const std::uint32_t large = std::rotr(b, 17) ^ std::rotr(b, 19) ^ b >> 10U;
    w.at(k) = w.at(k - 16) + small + w.at(k - 7) + large;
  }
  return w;
}

/// A block of 64 bytes goes into the words of the hash.
void take_block(Words& hash, std::string_view block) {
  const std::array<std::uint32_t, kRounds> w = schedule_of(block);
  auto [a, b, c, d, e, f, g, h] = hash;
  for (std::size_t k = 0; k < kRounds; ++k) {
    const std::uint32_t choice = (e & f) ^ (~e & g), majority = (a & b) ^ (a & c) ^ (b & c);
    const std::uint32_t one =
        h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) + choice + kRoundWords.at(k) + w.at(k);
    const std::uint32_t two = (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + majority;
    h = g;
    g = f;
    f = e;
    e = d + one;
    d = c;
    c = b;
    b = a;
    a = one + two;
  }
  const Words after = {a, b, c, d, e, f, g, h};
  for (std::size_t k = 0; k < hash.size(); ++k) hash.at(k) += after.at(k);
}

/// The end of the message with a bit of 1, bits of 0 and the length in bits: one block or two.
std::string padded_end(std::string_view rest, std::uint64_t length) {
  std::string end(rest);
  end += '\x80';
  while (end.size() % kBlock != kBlock - kLengthBytes) end += '\0';
  for (std::size_t k = kLengthBytes; k-- > 0;) end += static_cast<char>((length * 8) >> (8 * k) & 0xFFU);
  return end;
}

}  // namespace

std::string sha256_of(std::string_view bytes) {
  Words hash = kStart;
  const std::uint64_t length = bytes.size();
  for (; bytes.size() >= kBlock; bytes.remove_prefix(kBlock)) take_block(hash, bytes.substr(0, kBlock));
  const std::string end = padded_end(bytes, length);
  for (std::size_t at = 0; at < end.size(); at += kBlock) take_block(hash, std::string_view(end).substr(at, kBlock));
  std::string text;
  for (const std::uint32_t word : hash) text += fmt::format("{:08x}", word);
  return text;
}

}  // namespace bladefit

#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bladefit {

/// Where the web panel is served, and to whom.
struct WebSettings {
  std::string host = "127.0.0.1";
  std::uint16_t port = 8080;       ///< 0 = any free one
  std::string token;               ///< who knows it may press; empty: nobody
  std::vector<std::string> allow;  ///< numeric addresses that may ask; empty: every one that reaches `host`
};

/// The least length of a token.
inline constexpr std::size_t kShortestToken = 16;

}  // namespace bladefit

#include "tools/files/sha256.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>

#include "tools/files/tool_error.hpp"

namespace bladefit {

std::string sha256_of(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1)
    throw ToolError("the checksum of a file cannot be made: libcrypto refuses SHA-256");
  std::string text;
  for (unsigned k = 0; k < size; ++k) text += fmt::format("{:02x}", digest.at(k));
  return text;
}

}  // namespace bladefit

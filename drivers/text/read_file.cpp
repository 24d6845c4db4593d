#include "drivers/text/read_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace bladefit {

Failure read_file(const std::string& path, std::size_t largest, std::string& text) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!stream) return bad_input(std::strerror(errno));
  text.clear();
  std::array<char, 65536> block{};
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), stream.get())) {
    if (text.size() + count > largest) return bad_input(fmt::format("larger than {} bytes", largest));
    text.append(block.data(), count);
  }
  return std::ferror(stream.get()) != 0 ? bad_input(std::strerror(errno)) : Failure{};
}

}  // namespace bladefit

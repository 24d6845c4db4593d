#include "firmware_bridge/host/journal/config_digest.hpp"

#include <cstddef>
#include <span>
#include <type_traits>

#include "core/localizer/config_fields.hpp"

namespace bladefit {
namespace {

/// FNV-1a over the bytes of single numbers, so that padding between them plays no part.
class Digest {
 public:
  template <typename Number>
  void add(Number number) {
    if constexpr (std::is_enum_v<Number>) {
      add(static_cast<std::underlying_type_t<Number>>(number));
    } else {
      static_assert(std::is_arithmetic_v<Number>);
      for (const std::byte byte : std::as_bytes(std::span(&number, 1))) {
        value_ = (value_ ^ static_cast<std::uint64_t>(byte)) * kPrime;
      }
    }
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  static constexpr std::uint64_t kPrime = 0x100000001b3;
  std::uint64_t value_ = 0xcbf29ce484222325;
};

}  // namespace

std::uint64_t config_digest(const LocalizerConfig& config, std::uint32_t path_refine_points) {
  Digest digest;
  digest.add(path_refine_points);
  for_each_field(config, [&digest](const char*, const auto& field) { digest.add(field); });
  return digest.value();
}

}  // namespace bladefit

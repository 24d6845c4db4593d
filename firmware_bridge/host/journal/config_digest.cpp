#include "firmware_bridge/host/journal/config_digest.hpp"

#include <cstddef>
#include <span>
#include <type_traits>

namespace bladefit {
namespace {

/// FNV-1a over the bytes of single numbers, so that padding between them plays no part.
class Digest {
 public:
  template <typename Number>
  void add(Number number) {
    static_assert(std::is_arithmetic_v<Number>);
    for (const std::byte byte : std::as_bytes(std::span(&number, 1))) {
      value_ = (value_ ^ static_cast<std::uint64_t>(byte)) * kPrime;
    }
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  static constexpr std::uint64_t kPrime = 0x100000001b3;
  std::uint64_t value_ = 0xcbf29ce484222325;
};

void add_tolerance(const ToleranceMap& map, Digest& digest) {
  digest.add(map.box_count);
  for (std::uint32_t index = 0; index < map.box_count && index < ToleranceMap::kMaxBoxes; ++index) {
    const ParameterBox& box = map.boxes[index];
    digest.add(box.patch);
    for (const double limit : {box.u_min, box.u_max, box.v_min, box.v_max}) digest.add(limit);
  }
  digest.add(map.leading_edge_mm);
  digest.add(map.rest_mm);
  digest.add(map.transition);
}

}  // namespace

std::uint64_t config_digest(const LocalizerConfig& config, std::uint32_t path_refine_points) {
  Digest digest;
  digest.add(path_refine_points);
  digest.add(config.capacity);
  digest.add(config.refresh_per_push);
  digest.add(config.probe_radius_mm);
  digest.add(static_cast<std::uint8_t>(config.use_approach));
  digest.add(static_cast<std::uint8_t>(config.edges));
  digest.add(config.noise_floor_mm);
  digest.add(config.determined_mm);
  digest.add(config.window_low);
  digest.add(config.window_high);
  digest.add(static_cast<std::uint8_t>(config.mode));
  digest.add(config.ratio);
  digest.add(static_cast<std::uint8_t>(config.regions));
  digest.add(config.locked);
  digest.add(static_cast<std::uint8_t>(config.loss));
  digest.add(config.loss_scale_mm);
  for (const double entry : config.start.rotation.reshaped()) digest.add(entry);
  for (const double entry : config.start.translation) digest.add(entry);
  add_tolerance(config.tolerance, digest);
  return digest.value();
}

}  // namespace bladefit

#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/surface/surface.hpp"

namespace bladefit {

/// The blades of a design: patches that touch each other belong to one. Blades are numbered from 1 in the order of
/// their first patches.
class Blades {
 public:
  /// Cost: some hundred evaluations a patch.
  explicit Blades(const Surface& surface);

  [[nodiscard]] std::uint32_t count() const { return count_; }
  [[nodiscard]] std::uint32_t blade_of(std::uint32_t patch) const { return blade_of_[patch]; }
  /// "blade 2 (patches 3 to 5)".
  [[nodiscard]] std::string name_of(std::uint32_t blade) const;

 private:
  std::vector<std::uint32_t> blade_of_;
  std::uint32_t count_ = 0;
};

}  // namespace bladefit

#pragma once
#include <array>
#include <cmath>
#include <cstdint>

#include "core/localizer/check_config.hpp"
#include "core/localizer/tuning.hpp"

namespace bladefit {

/// Where the starts of a search have come to rest, each known by its value, and what came of it when its feet were
/// searched. A start that comes to rest at the same value ends as that one did: the search of every foot, which is most
/// of a start's cost where many feet are in doubt, would find the same ones again.
class KnownRests {
 public:
  void clear() { count_ = since_ = 0; }
  /// A start begins.
  void begin_start() { since_ = count_; }
  /// It rests at this value, and its feet are searched next. Forgotten where there is no more room.
  void note(double value) {
    if (count_ < rests_.size()) rests_[count_++] = {value, value};
  }
  /// It has come to this value from there.
  void came_to(double outcome) {
    for (std::uint32_t k = since_; k < count_; ++k) rests_[k].outcome = outcome;
  }
  /// What came of a rest at this value; null where there was none.
  [[nodiscard]] const double* outcome_of(double value) const {
    for (std::uint32_t k = 0; k < count_; ++k) {
      if (std::abs(rests_[k].value - value) <= tuning::kSameOptimum * value) return &rests_[k].outcome;
    }
    return nullptr;
  }

 private:
  static constexpr std::uint32_t kMost = tuning::kStartProofs * (kMostFurtherStarts + 1);
  struct Rest {
    double value, outcome;
  };
  std::array<Rest, kMost> rests_{};
  std::uint32_t count_ = 0, since_ = 0;  ///< since: of the start under way
};

}  // namespace bladefit

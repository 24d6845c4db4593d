#pragma once
#include <unordered_map>

#include "tools/design/image/reach_forms.hpp"
#include "tools/design/image/reach_guess.hpp"

namespace bladefit {

/// What ImageSpan says of one span [mm]; 0 where nothing is proven.
struct SpanReach {
  double reach[2] = {0, 0};
  double apart = 0;
  std::array<std::uint8_t, 4> inset{};

  [[nodiscard]] bool proves() const { return reach[0] > 0.0 || reach[1] > 0.0; }
};

/// What the proofs of all spans share. Views; read only.
struct ReachDesign {
  explicit ReachDesign(const Surface& design) : surface(design), smooth(design), guess(design) {}
  const Surface& surface;
  SmoothSides smooth;
  ReachGuess guess;
};

/// Leaves as parts, with all that were cut of them: those of one worker.
class PartCache {
 public:
  explicit PartCache(const Surface& surface) : surface_(surface) {}
  [[nodiscard]] SurfacePart& of_leaf(std::uint32_t leaf);
  /// Forgets all parts where these have become many.
  void trim();

 private:
  const Surface& surface_;
  std::unordered_map<std::uint32_t, std::unique_ptr<SurfacePart>> parts_;
};

/// Proves the reach of one span: a share of the reach that samples show is held against every other part of the
/// surface, pair by pair, by FarBox or NearForm; where neither suffices the larger of the two is cut, down to a size
/// from which the reach is lowered instead. The same for every order of the spans.
/// Cost: a millisecond; bounded by a number of pairs, beyond which nothing is proven.
[[nodiscard]] SpanReach prove_reach(const ReachDesign& design, PartCache& parts, std::uint32_t span);

}  // namespace bladefit

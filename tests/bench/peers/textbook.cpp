// What a few days with a textbook give: Newton's method on Cox-de Boor basis functions, and a k-d tree of samples in
// front of it.

#include "tests/bench/peers/sample_tree.hpp"

namespace bladefit::bench {

std::vector<Peer> textbook_peers(const UnitSurface& surface, int outward) {
  const auto tree = std::make_shared<SampleTree>(surface, outward);
  Peer newton;
  newton.name = "textbook Newton";
  newton.nearest_local = [tree](const Vec3& r, const Parameters& guess) { return tree->surface().foot(r, guess); };
  Peer samples;
  samples.name = "k-d tree of 50,000 samples + Newton";
  samples.nearest_global = [tree](const Vec3& r) { return tree->foot(r); };
  return {newton, samples};
}

}  // namespace bladefit::bench

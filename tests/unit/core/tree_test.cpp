// The bounding tree: what its single-precision boxes tell is never more than the truth.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "core/geometry/nearest/bounding_tree.hpp"
#include "tests/support/localizer_fixtures.hpp"

namespace bladefit::testing {
namespace {

/// Distance to a box, in double precision.
double exact_distance(const ImageNode& node, int place, const Vec3& arm) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = static_cast<double>(node.low[axis][place]), high = static_cast<double>(node.high[axis][place]);
    const double beyond = std::fmax(std::fmax(low - arm[axis], arm[axis] - high), 0.0);
    sum += beyond * beyond;
  }
  return std::sqrt(sum);
}

class BoundingTree : public ::testing::TestWithParam<std::string> {};

/// A box that is nearer than the limit stays below the threshold, for points near and a thousand sizes away; and one
/// that is clearly farther does not.
TEST_P(BoundingTree, NothingNearerThanTheLimitIsLeftOut) {
  const DesignImage& image = reference_design(GetParam()).image();
  const double size = reference_design(GetParam()).surface().half_diagonal();
  rc::check([&] {
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    const double reach = size * std::pow(10.0, uniform(random, -3, 3));
    const Vec3 arm(uniform(random, -reach, reach), uniform(random, -reach, reach), uniform(random, -reach, reach));
    const BoxDistances boxes(arm);
    const ImageNode& node = image.nodes()[random() % image.nodes().size()];
    const BoxDistances::Four squares = boxes.squares(node);
    for (int place = 0; place < 4; ++place) {
      if (node.child[place] == kNoChild) {
        RC_ASSERT(std::isinf(squares[place]));
        continue;
      }
      const double distance = exact_distance(node, place, arm);
      RC_ASSERT(squares[place] < boxes.threshold(distance * (1.0 + 1e-9) + 1e-12 * size));
      const double clearly_less = distance * (1.0 - 1e-5) - 1e-6 * (reach + size);
      if (clearly_less > 0.0) RC_ASSERT(!(squares[place] < boxes.threshold(clearly_less)));
    }
  });
}

INSTANTIATE_TEST_SUITE_P(AllCases, BoundingTree, ::testing::ValuesIn(reference_case_names()),
                         [](const auto& param) { return param.param; });

}  // namespace
}  // namespace bladefit::testing

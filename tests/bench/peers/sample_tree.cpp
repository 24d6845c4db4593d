#include "tests/bench/peers/sample_tree.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <limits>
#include <nanoflann.hpp>
#include <utility>
#include <vector>

namespace bladefit::bench {
namespace {

constexpr std::size_t kSamplesU = 500, kSamplesV = 100;

/// What nanoflann asks of a set of points.
struct Samples {
  std::vector<Parameters> places;
  std::vector<Vec3> points, normals;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t k, std::size_t axis) const {
    return points[k][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
};

Samples samples_of(const TextbookSurface& surface, int outward) {
  Samples samples;
  for (std::size_t i = 0; i < kSamplesU; ++i) {
    for (std::size_t j = 0; j < kSamplesV; ++j) {
      const Parameters at{static_cast<double>(i) / (kSamplesU - 1), static_cast<double>(j) / (kSamplesV - 1)};
      const TextbookPoint p = surface.evaluate(at);
      samples.places.push_back(at);
      samples.points.emplace_back(p.s);
      samples.normals.emplace_back(outward * p.s_u.cross(p.s_v).normalized());
    }
  }
  return samples;
}

/// Keeps the nearest sample that faces the probe.
class NearestFacing {
 public:
  NearestFacing(const Samples& samples, const Vec3& approach) : samples_(samples), approach_(approach) {}
  [[nodiscard]] static bool full() { return true; }
  [[nodiscard]] double worstDist() const { return distance_; }
  bool addPoint(double distance, std::size_t k) {
    if (distance < distance_ && (approach_.isZero() || samples_.normals[k].dot(approach_) < 0.0)) {
      distance_ = distance;
      nearest_ = k;
    }
    return true;
  }
  [[nodiscard]] std::size_t nearest() const { return nearest_; }

 private:
  const Samples& samples_;
  const Vec3& approach_;
  double distance_ = std::numeric_limits<double>::max();
  std::size_t nearest_ = 0;
};

}  // namespace

struct SampleTree::Index {
  explicit Index(Samples all) : samples(std::move(all)), tree(3, samples) { tree.buildIndex(); }
  Samples samples;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Samples>, Samples, 3, std::size_t> tree;
};

SampleTree::SampleTree(const UnitSurface& surface, int outward)
    : surface_(surface), index_(std::make_unique<Index>(samples_of(surface_, outward))) {}

SampleTree::~SampleTree() = default;

Parameters SampleTree::foot(const Vec3& r, const Vec3& approach) const {
  NearestFacing result(index_->samples, approach);
  index_->tree.findNeighbors(result, r.data(), nanoflann::SearchParams());
  return surface_.foot(r, index_->samples.places[result.nearest()]);
}

bool feet_renewed(const SampleTree& tree, const FitProblem& problem, const Pose& pose, std::vector<Parameters>& feet) {
  constexpr double kOther = 1e-6;  // feet farther apart than this are not the same [mm]
  bool renewed = feet.empty();
  feet.resize(problem.points.size());
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const Vec3 r = apply(pose, problem.points[i]);
    const Vec3 approach = problem.approaches.empty() ? Vec3(Vec3::Zero()) : Vec3(pose.rotation * problem.approaches[i]);
    const Parameters found = tree.foot(r, approach);
    if (!renewed) {
      const Parameters tracked = tree.surface().foot(r, feet[i]);
      const double apart = (tree.surface().evaluate(tracked).s - tree.surface().evaluate(found).s).norm();
      renewed = apart > kOther;
    }
    feet[i] = found;
  }
  return renewed;
}

}  // namespace bladefit::bench

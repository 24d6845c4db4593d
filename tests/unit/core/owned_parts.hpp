#pragma once
#include <vector>

#include "core/localizer/localizer_parts.hpp"

namespace bladefit::testing {

/// A store in memory of its own.
class OwnedStore : public PointStore {
 public:
  explicit OwnedStore(std::uint32_t capacity) : points_(capacity), order_(capacity) {
    attach(points_.data(), order_.data(), capacity);
  }
  OwnedStore(const OwnedStore&) = delete;
  OwnedStore& operator=(const OwnedStore&) = delete;

 private:
  std::vector<StoredPoint> points_;
  std::vector<std::uint32_t> order_;
};

inline StoredPoint numbered(std::uint32_t sequence) {
  StoredPoint point;
  point.sequence = sequence;
  return point;
}

inline Foot foot_at(double u, double distance, FootKind kind = FootKind::interior) {
  Foot foot;
  foot.u = u;
  foot.v = 0.5;
  foot.normal = Vec3::UnitZ();
  foot.distance = distance;
  foot.kind = kind;
  foot.border = kind == FootKind::interior ? FootBorder::none : FootBorder::outer;
  return foot;
}

/// The parts of a localizer in memory of their own, without the calls that make them one.
class OwnedParts {
 public:
  OwnedParts(const DesignImage& design, const LocalizerConfig& config)
      : points_(config.capacity),
        order_(config.capacity),
        ring_(config.capacity),
        rows_(BoundRows::doubles_for(config.capacity)),
        places_(config.capacity),
        parts_(design, config) {
    parts_.store.attach(points_.data(), order_.data(), config.capacity);
    parts_.verdicts.attach(ring_.data(), config.capacity);
    parts_.refinement.attach(rows_.data(), places_.data(), config.capacity);
    parts_.sums.clear(config.start);
    parts_.estimate.reset(parts_.sums.model());
  }
  OwnedParts(const OwnedParts&) = delete;
  OwnedParts& operator=(const OwnedParts&) = delete;
  LocalizerParts* operator->() { return &parts_; }
  LocalizerParts& operator*() { return parts_; }

  /// Stores points with their feet at the present pose. They are in no sums yet.
  void store(const std::vector<ProbePoint>& points) {
    for (const ProbePoint& point : points) {
      const StoredPoint made = parts_.finder.new_point(point, {});
      const Measurement m = parts_.finder.find(made, parts_.estimate.pose(), Search::always);
      parts_.store.record(parts_.store[parts_.store.append(made)], m, parts_.estimate.revision());
    }
  }

  /// The sums over all stored points at the present pose, as a sweep of a refinement takes them.
  void sweep() {
    parts_.sums.begin_sweep(parts_.estimate.pose());
    for (std::uint32_t i = 0; i < parts_.store.size(); ++i) {
      StoredPoint& point = parts_.store[i];
      const Measurement m = parts_.finder.find(point, parts_.estimate.pose(), Search::if_doubtful);
      parts_.store.record(point, m, parts_.estimate.revision());
      if (parts_.selection.left_out(point, m.foot)) {
        parts_.sums.pass_over();
      } else {
        parts_.sums.sweep_over(point, m, parts_.finder.row(m, Vec6::Zero()));
      }
    }
    parts_.sums.commit();
  }

  /// The pose becomes the least-squares optimum of the stored points, and the sums are those there.
  void fit() {
    for (int k = 0; k < 8; ++k) {
      sweep();
      parts_.estimate.redetermine();
      const Minimum minimum =
          parts_.estimate.minimum_of(parts_.sums.model(), parts_.loss, true, PoseEstimate::Undetermined::as_they_are);
      parts_.estimate.know(minimum);
      parts_.estimate.move_to(minimum.pose);
    }
    sweep();
  }

 private:
  std::vector<StoredPoint> points_;
  std::vector<std::uint32_t> order_, ring_;
  std::vector<double> rows_;
  std::vector<KeptPlaces> places_;
  LocalizerParts parts_;
};

inline bool same_bits(const Pose& a, const Pose& b) {
  return a.rotation == b.rotation && a.translation == b.translation;
}

}  // namespace bladefit::testing

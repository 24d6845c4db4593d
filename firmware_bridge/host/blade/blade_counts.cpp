#include "firmware_bridge/host/blade/blade_counts.hpp"

#include <Eigen/Geometry>
#include <optional>

namespace bladefit {
namespace {

EdgeCell kind_of(const Verdict& verdict) {
  switch (verdict.state) {
    case PointState::in:
      return EdgeCell::in;
    case PointState::undecided:
      return EdgeCell::undecided;
    case PointState::out:
      if (verdict.action == Action::none) return EdgeCell::beyond;
      return verdict.action == Action::cut ? EdgeCell::cut : EdgeCell::weld;
    case PointState::pending:
    case PointState::rejected:
      break;
  }
  return EdgeCell::pending;
}

/// Where the points of a side are counted.
std::optional<std::size_t> row_of(BladeSide side) {
  if (side == BladeSide::suction) return 0;
  if (side == BladeSide::pressure) return 1;
  return std::nullopt;
}

}  // namespace

Vec6 motion_row(const BladeLayout& layout, const Vec3& point, const Vec3& normal) {
  Vec6 row;
  row.head<3>() = (point - layout.middle()).cross(normal) / layout.scale_mm();
  row.tail<3>() = normal;
  return row;
}

void BladeCounts::count(const Verdict& verdict, int sign) {
  if (verdict.state == PointState::rejected || !has_foot(verdict)) return;
  const Foot& foot = verdict.foot;
  const auto step = static_cast<std::uint32_t>(sign);
  const double radius = layout_->axis().radius_of(foot.point);
  const Vec6 row = motion_row(*layout_, foot.point, foot.normal);
  information_ += sign * row * row.transpose();
  if (verdict.region == Region::leading_edge) {
    edge_[layout_->cell_of(radius)][static_cast<std::size_t>(kind_of(verdict))] += step;
  } else if (const auto side = row_of(layout_->side_of(foot.point, foot.normal, verdict.region))) {
    sides_[*side][layout_->band_of(radius)] += step;
  }
  if (verdict.state != PointState::out) return;
  if (sign > 0) {
    out_.insert_or_assign(verdict.sequence, verdict);
  } else {
    out_.erase(verdict.sequence);
  }
}

void BladeCounts::clear() {
  edge_ = {};
  sides_ = {};
  information_.setZero();
  out_.clear();
}

/// The worst that there is; of cut and weld what more points say.
EdgeCell BladeCounts::edge_cell(std::size_t cell) const {
  const auto& kinds = edge_[cell];
  const auto points = [&kinds](EdgeCell kind) { return kinds[static_cast<std::size_t>(kind)]; };
  const std::uint32_t cut = points(EdgeCell::cut), weld = points(EdgeCell::weld);
  if (cut + weld > 0) return weld > cut ? EdgeCell::weld : EdgeCell::cut;
  for (const EdgeCell kind : {EdgeCell::beyond, EdgeCell::undecided, EdgeCell::pending, EdgeCell::in}) {
    if (points(kind) > 0) return kind;
  }
  return EdgeCell::not_probed;
}

std::uint32_t BladeCounts::points(BladeSide side, std::size_t band) const {
  const auto row = row_of(side);
  return row ? sides_[*row][band] : 0;
}

}  // namespace bladefit

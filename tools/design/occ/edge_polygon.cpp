#include "tools/design/occ/edge_polygon.hpp"

#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace bladefit {
namespace {

/// A part of a curve is halved no more often.
constexpr int kMostHalvings = 9;
/// Parts of a curve that is no line, at least.
constexpr int kLeastParts = 4;
constexpr int kMostNewtonSteps = 30;
/// Where it is asked whether a curve runs along a side.
constexpr int kSidePlaces = 16;
/// A curve in space that is so many tolerances from that in the parameters is another one.
constexpr double kOtherCurve = 1000;
/// Where a part is compared with its curve.
constexpr std::array<double, 5> kLookedAt = {0.12, 0.31, 0.5, 0.69, 0.88};

Eigen::Vector3d vector_of(const gp_XYZ& p) { return {p.X(), p.Y(), p.Z()}; }

class EdgeFollower {
 public:
  EdgeFollower(const EdgeCurves& edge, const FaceBasis& basis, double tolerance)
      : curve_(*edge.flat),
        space_(edge.space.get()),
        basis_(basis),
        tolerance_(tolerance),
        same_(basis.surface == basis.spline) {}

  EdgePolygon run(double first, double last) {
    const bool by_parameters =
        space_ == nullptr || along_side(first, last) || apart(first, last) > kOtherCurve * tolerance_;
    if (by_parameters) space_ = nullptr;
    const std::vector<double> parts = parts_of(first, last);
    result_.places.push_back(place_at(parts.front()));
    for (std::size_t k = 1; k < parts.size(); ++k) {
      follow({parts[k - 1], result_.places.back()}, {parts[k], place_at(parts[k])}, 0);
    }
    result_.first_way = way_at(first);
    result_.last_way = way_at(last);
    result_.from = point_at(first);
    result_.to = point_at(last);
    return result_;
  }

 private:
  struct CurvePlace {
    double t;
    Eigen::Vector2d place;
  };

  /// Its knots, and as many between as a smooth curve needs to be looked at.
  [[nodiscard]] std::vector<double> parts_of(double first, double last) const {
    std::vector<double> parts{first, last};
    const Geom2d_Curve* curve = &curve_;
    while (const auto* part = dynamic_cast<const Geom2d_TrimmedCurve*>(curve)) curve = part->BasisCurve().get();
    if (const auto* spline = dynamic_cast<const Geom2d_BSplineCurve*>(curve)) {
      for (int k = spline->FirstUKnotIndex(); k <= spline->LastUKnotIndex(); ++k) parts.push_back(spline->Knot(k));
    }
    if (dynamic_cast<const Geom2d_Line*>(curve) == nullptr) {
      for (int k = 1; k < kLeastParts; ++k) parts.push_back(first + (last - first) * k / kLeastParts);
    }
    std::ranges::sort(parts);
    const double least = 1e-9 * (last - first);
    std::vector<double> rising{first};
    for (const double t : parts) {
      if (t > rising.back() + least && t < last - least) rising.push_back(t);
    }
    rising.push_back(last);
    return rising;
  }

  /// In the parameters it runs along a side of the box.
  [[nodiscard]] bool along_side(double first, double last) const {
    std::array<bool, 4> on{true, true, true, true};
    for (int k = 0; k <= kSidePlaces; ++k) {
      const Eigen::Vector2d place = even_place(first + (last - first) * k / kSidePlaces);
      for (const int axis : {0, 1}) {
        for (const int high : {0, 1}) {
          bool& still = on[static_cast<std::size_t>(2 * axis + high)];
          still = still && std::abs(place[axis] - high) <= kOnSide;
        }
      }
    }
    return std::ranges::find(on, true) != on.end();
  }

  /// How far the curve in space is from that in the parameters.
  [[nodiscard]] double apart(double first, double last) const {
    double largest = 0;
    for (const double share : kLookedAt) {
      const double t = first + share * (last - first);
      const gp_Pnt2d place = curve_.Value(t);
      largest = std::max(largest, space_->Value(t).Distance(basis_.surface->Value(place.X(), place.Y())));
    }
    return largest;
  }

  [[nodiscard]] Eigen::Vector3d point_at(double t) const {
    if (space_ != nullptr) return vector_of(space_->Value(t).XYZ());
    const gp_Pnt2d place = curve_.Value(t);
    return vector_of(basis_.surface->Value(place.X(), place.Y()).XYZ());
  }

  [[nodiscard]] Eigen::Vector3d way_at(double t) const {
    gp_Pnt2d place;
    gp_Vec2d along;
    curve_.D1(t, place, along);
    gp_Pnt point;
    gp_Vec along_u, along_v;
    basis_.surface->D1(place.X(), place.Y(), point, along_u, along_v);
    const Eigen::Vector3d way = along.X() * vector_of(along_u.XYZ()) + along.Y() * vector_of(along_v.XYZ());
    const double size = way.norm();
    return size > 1e-12 * (along_u.Magnitude() + along_v.Magnitude()) * along.Magnitude() ? Eigen::Vector3d(way / size)
                                                                                          : Eigen::Vector3d::Zero();
  }

  [[nodiscard]] Eigen::Vector3d point_of(const Eigen::Vector2d& place) const {
    const FaceBox& box = basis_.spline_box;
    return vector_of(
        basis_.spline
            ->Value(box.u_min + place.x() * (box.u_max - box.u_min), box.v_min + place.y() * (box.v_max - box.v_min))
            .XYZ());
  }

  /// In the box of the surface.
  [[nodiscard]] Eigen::Vector2d even_place(double t) const {
    const gp_Pnt2d given = curve_.Value(t);
    const FaceBox& box = basis_.box;
    return {(given.X() - box.u_min) / (box.u_max - box.u_min), (given.Y() - box.v_min) / (box.v_max - box.v_min)};
  }

  /// In the box of the spline, whose parameters may run otherwise than those of the surface: then by Newton's method,
  /// as for a curve in space.
  [[nodiscard]] Eigen::Vector2d place_at(double t) const {
    const Eigen::Vector2d even = even_place(t);
    return same_ && space_ == nullptr ? even : nearest(even.cwiseMax(0.0).cwiseMin(1.0), point_at(t));
  }

  [[nodiscard]] Eigen::Vector2d nearest(Eigen::Vector2d place, const Eigen::Vector3d& wanted) const {
    const FaceBox& box = basis_.spline_box;
    const Eigen::Vector2d range(box.u_max - box.u_min, box.v_max - box.v_min);
    for (int k = 0; k < kMostNewtonSteps; ++k) {
      gp_Pnt point;
      gp_Vec along_u, along_v;
      basis_.spline->D1(box.u_min + place.x() * range.x(), box.v_min + place.y() * range.y(), point, along_u, along_v);
      Eigen::Matrix<double, 3, 2> tangents;
      tangents << range.x() * vector_of(along_u.XYZ()), range.y() * vector_of(along_v.XYZ());
      const Eigen::Vector3d off = wanted - vector_of(point.XYZ());
      Eigen::Matrix2d square = tangents.transpose() * tangents;
      square.diagonal().array() += 1e-14 * square.trace();
      const Eigen::Vector2d step = square.ldlt().solve(tangents.transpose() * off);
      const Eigen::Vector2d next = (place + step).cwiseMax(0.0).cwiseMin(1.0);
      const bool last = (next - place).norm() < 1e-14;
      place = next;
      if (last) break;
    }
    return place;
  }

  /// How far the straight way between two places is from the curve between them.
  [[nodiscard]] double off(const CurvePlace& from, const CurvePlace& to) const {
    const Eigen::Vector2d way = to.place - from.place;
    const double square = way.squaredNorm();
    double largest = 0;
    for (const double share : kLookedAt) {
      const double t = from.t + share * (to.t - from.t);
      const Eigen::Vector2d place = place_at(t);
      const double along = square > 0 ? std::clamp((place - from.place).dot(way) / square, 0.0, 1.0) : 0.0;
      largest = std::max(largest, (point_of(from.place + along * way) - point_of(place)).norm());
    }
    return largest;
  }

  void follow(const CurvePlace& from, const CurvePlace& to, int halvings) {
    const double distance = off(from, to);
    if (distance <= tolerance_ || halvings == kMostHalvings) {
      result_.off = std::max(result_.off, distance);
      result_.places.push_back(to.place);
      return;
    }
    const double t = 0.5 * (from.t + to.t);
    const CurvePlace middle{t, place_at(t)};
    follow(from, middle, halvings + 1);
    follow(middle, to, halvings + 1);
  }

  const Geom2d_Curve& curve_;
  const Geom_Curve* space_;
  const FaceBasis& basis_;
  double tolerance_;
  bool same_;
  EdgePolygon result_;
};

}  // namespace

EdgePolygon edge_polygon(const EdgeCurves& edge, const FaceBasis& basis, double tolerance) {
  EdgePolygon polygon = EdgeFollower(edge, basis, tolerance).run(edge.first, edge.last);
  if (!edge.reversed) return polygon;
  std::ranges::reverse(polygon.places);
  std::swap(polygon.from, polygon.to);
  std::swap(polygon.first_way, polygon.last_way);
  polygon.first_way = -polygon.first_way;
  polygon.last_way = -polygon.last_way;
  return polygon;
}

}  // namespace bladefit

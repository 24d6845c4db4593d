#include "tools/batch/tip_radius.hpp"

#include <algorithm>
#include <queue>
#include <vector>

namespace bladefit {
namespace {

/// Share of the radius to which it is proven, and spans that are looked at for it at most.
constexpr double kProven = 1e-6;
constexpr std::size_t kMostPieces = 200000;

/// A Bezier piece: its homogeneous control points (w x, w y, w z, w), those of a row behind each other.
struct Piece {
  std::vector<Eigen::Vector4d> net;
  std::size_t columns = 0;
  double bound = 0;  ///< no point of it is farther from the axis

  [[nodiscard]] std::size_t rows() const { return net.size() / columns; }
  bool operator<(const Piece& other) const { return bound < other.bound; }
};

double radius_of(const Eigen::Vector4d& control, const ShaftAxis& axis) {
  return axis.radius_of(Vec3(control.head<3>() / control.w()));
}

/// The control points of the corners are points of the surface.
double corner_radius(const Piece& piece, const ShaftAxis& axis) {
  double radius = 0;
  const std::size_t last = piece.net.size() - 1;
  for (const std::size_t k : {std::size_t{0}, piece.columns - 1, last + 1 - piece.columns, last})
    radius = std::max(radius, radius_of(piece.net[k], axis));
  return radius;
}

void set_bound(Piece& piece, const ShaftAxis& axis) {
  piece.bound = 0;
  for (const Eigen::Vector4d& control : piece.net) piece.bound = std::max(piece.bound, radius_of(control, axis));
}

/// Halves the control points at first, first + stride, ... : `count` of them stay the first half in place.
void halve(std::vector<Eigen::Vector4d>& low, std::vector<Eigen::Vector4d>& high, std::size_t first, std::size_t stride,
           std::size_t count) {
  std::vector<Eigen::Vector4d> line(count);
  for (std::size_t k = 0; k < count; ++k) line[k] = low[first + k * stride];
  for (std::size_t level = 0; level < count; ++level) {
    low[first + level * stride] = line.front();
    high[first + (count - 1 - level) * stride] = line[count - 1 - level];
    for (std::size_t k = 0; k + 1 < count - level; ++k) line[k] = 0.5 * (line[k] + line[k + 1]);
  }
}

/// Both halves of a piece, cut across its longer side.
std::pair<Piece, Piece> halves_of(const Piece& piece) {
  Piece low = piece, high = piece;
  const auto at = [&piece](std::size_t k) { return Vec3(piece.net[k].head<3>() / piece.net[k].w()); };
  const std::size_t last = piece.net.size() - 1;
  const double down = (at(last + 1 - piece.columns) - at(0)).norm() + (at(last) - at(piece.columns - 1)).norm();
  const double across = (at(piece.columns - 1) - at(0)).norm() + (at(last) - at(last + 1 - piece.columns)).norm();
  if (down >= across) {
    for (std::size_t j = 0; j < piece.columns; ++j) halve(low.net, high.net, j, piece.columns, piece.rows());
  } else {
    for (std::size_t i = 0; i < piece.rows(); ++i) halve(low.net, high.net, i * piece.columns, 1, piece.columns);
  }
  return {low, high};
}

Piece piece_of(const Surface& surface, std::uint32_t span) {
  BezierNet net;
  surface.net(span, net);
  Piece piece;
  piece.columns = net.degree_v + 1;
  for (std::size_t k = 0; k < (net.degree_u + 1) * piece.columns; ++k) piece.net.emplace_back(net.points[k].matrix());
  return piece;
}

}  // namespace

double tip_radius_of(const Surface& surface, const ShaftAxis& axis) {
  double known = 0;
  std::priority_queue<Piece> pieces;
  const auto take = [&](Piece piece) {
    set_bound(piece, axis);
    known = std::max(known, corner_radius(piece, axis));
    pieces.push(std::move(piece));
  };
  for (std::uint32_t span = 0; span < surface.image().spans().size(); ++span) take(piece_of(surface, span));
  for (std::size_t count = 0; count < kMostPieces && !pieces.empty(); ++count) {
    if (pieces.top().bound <= known * (1.0 + kProven)) break;
    const auto [low, high] = halves_of(pieces.top());
    pieces.pop();
    take(low);
    take(high);
  }
  return pieces.empty() ? known : std::max(known, pieces.top().bound);
}

}  // namespace bladefit

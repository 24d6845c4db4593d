#include "tools/design/image/smooth_sides.hpp"

#include <algorithm>
#include <array>

#include "core/geometry/surface/bezier.hpp"

namespace bladefit {
namespace {

/// A derivative that jumps by no more than this share of it bends the surface by no more than as many rad: a ball that
/// touches on one side of it is met on the other to a depth of 1e-14 of its radius.
constexpr double kSmooth = 1e-7;

/// What a span's side is by its control points: those on it, and the derivative across it, per patch parameter.
struct SideNet {
  std::uint32_t count = 0;
  std::array<Homogeneous, kMaxOrder> on, across;
};

SideNet side_net(const Surface& surface, std::uint32_t span, bool along_u, bool high) {
  const ImagePatch& p = surface.patch_of(span);
  const SpanDomain d = surface.domain(span);
  SideNet side;
  side.count = 1 + (along_u ? p.degree_v : p.degree_u);
  const std::uint32_t degree = along_u ? p.degree_u : p.degree_v;
  const double factor = degree / (along_u ? d.u_max - d.u_min : d.v_max - d.v_min);
  BezierNet net;
  surface.net(span, net);
  const auto point = [&](std::uint32_t k, std::uint32_t in) {
    const std::uint32_t step = high ? degree - in : in;
    return along_u ? net.at(step, k) : net.at(k, step);
  };
  for (std::uint32_t k = 0; k < side.count; ++k) {
    side.on[k] = point(k, 0);
    side.across[k] = (high ? factor : -factor) * (side.on[k] - point(k, 1));
  }
  return side;
}

/// The derivatives of A / w across the side differ by (D w - d A) / w^2, with D, d those of A and w: a polynomial whose
/// coefficients are means of what is looked at here, pair by pair.
bool same_derivative(const SideNet& a, const SideNet& b) {
  double size = 0, jump = 0;
  for (std::uint32_t i = 0; i < a.count; ++i) {
    for (std::uint32_t j = 0; j <= i; ++j) {
      const auto mixed = [](const Homogeneous& across, const Homogeneous& on) {
        return Homogeneous(across * on[3] - across[3] * on);
      };
      const Homogeneous left = mixed(a.across[i], a.on[j]) + mixed(a.across[j], a.on[i]);
      const Homogeneous right = mixed(b.across[i], a.on[j]) + mixed(b.across[j], a.on[i]);
      size = std::max(size, left.head<3>().matrix().norm());
      jump = std::max(jump, (left - right).head<3>().matrix().norm());
    }
    const double weight = std::max(a.on[i][3], b.on[i][3]);
    if ((a.on[i] - b.on[i]).matrix().norm() > 1e-12 * (a.on[i].matrix().norm() + weight)) return false;
  }
  return jump <= kSmooth * size;
}

}  // namespace

SmoothSides::SmoothSides(const Surface& surface) : rough_(surface.image().spans().size(), 15U) {
  for (std::uint32_t k = 0; k < rough_.size(); ++k) {
    const ImageSpan& span = surface.span(k);
    const ImagePatch& patch = surface.patch_of(k);
    const auto join = [&](bool along_u, std::uint32_t next) {
      const std::uint32_t high = along_u ? kEndsAtHighU : kEndsAtHighV, low = along_u ? kEndsAtLowU : kEndsAtLowV;
      const bool crease = (span.ends & high) != 0;
      if (crease || !same_derivative(side_net(surface, k, along_u, true), side_net(surface, next, along_u, false)))
        return;
      rough_[k] &= ~high;
      rough_[next] &= ~low;
    };
    if (span.iu + 1 < patch.spans_u) join(true, k + patch.spans_v);
    if (span.iv + 1 < patch.spans_v) join(false, k + 1);
  }
}

}  // namespace bladefit

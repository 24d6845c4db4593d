#include "tools/design/nurbs/thin_spans.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/geometry/surface/taylor.hpp"
#include "tools/design/nurbs/bezier_extraction.hpp"

namespace bladefit {
namespace {

/// Widths of spans that are merged, of the parameter range: the widest that moves the surface little enough.
constexpr std::array<double, 4> kThin = {1e-6, 1e-7, 1e-8, 1e-9};
/// Places of a span that are looked at, in each direction.
constexpr int kLooks = 5;

/// A row or column of control points, by their number along a direction.
class Lines {
 public:
  Lines(NurbsSurface& surface, bool along_u) : surface_(surface), along_u_(along_u) {}

  [[nodiscard]] SurfaceDirection& direction() const { return along_u_ ? surface_.u : surface_.v; }

  /// Control points `from` and `to` and those between become one: the first, the last or the middle of the two.
  void make_one(int from, int to, double share) {
    const int across = along_u_ ? surface_.v.control_points : surface_.u.control_points;
    for (int k = 0; k < across; ++k) {
      const std::size_t low = index(from, k), high = index(to, k);
      // Homogeneous, as the surface is.
      const double w_low = (1.0 - share) * surface_.weights[low], w_high = share * surface_.weights[high];
      const double weight = w_low + w_high;
      surface_.control_points[low] =
          share == 0.0 ? surface_.control_points[low]
                       : Eigen::Vector3d(
                             (w_low * surface_.control_points[low] + w_high * surface_.control_points[high]) / weight);
      surface_.weights[low] = weight;
    }
    drop(from + 1, to);
  }

 private:
  [[nodiscard]] std::size_t index(int along, int across) const {
    const int row = along_u_ ? along : across, column = along_u_ ? across : along;
    return static_cast<std::size_t>(row * surface_.v.control_points + column);
  }

  /// Control points `from` to `to`.
  void drop(int from, int to) {
    std::vector<Eigen::Vector3d> points;
    std::vector<double> weights;
    const int nv = surface_.v.control_points;
    for (std::size_t k = 0; k < surface_.weights.size(); ++k) {
      const int i = static_cast<int>(k) / nv, j = static_cast<int>(k) % nv, along = along_u_ ? i : j;
      if (along >= from && along <= to) continue;
      points.push_back(surface_.control_points[k]);
      weights.push_back(surface_.weights[k]);
    }
    surface_.control_points = std::move(points);
    surface_.weights = std::move(weights);
    direction().control_points -= to - from + 1;
  }

  NurbsSurface& surface_;
  bool along_u_;
};

/// Makes the knots [first, last) one, at `knot`; of more than `most` the rest go, with the control points between the
/// last on the left of them and the first on their right, which are the surface there.
void gather(Lines& lines, std::size_t first, std::size_t last, double knot) {
  SurfaceDirection& d = lines.direction();
  const bool at_start = first == 0, at_end = last == d.knots.size();
  const int many = static_cast<int>(last - first), most = at_start || at_end ? d.degree + 1 : d.degree;
  std::fill(d.knots.begin() + static_cast<std::ptrdiff_t>(first), d.knots.begin() + static_cast<std::ptrdiff_t>(last),
            knot);
  if (many <= most) return;
  const int right = static_cast<int>(first) + many - (at_end ? 2 : 1) - d.degree, left = right - (many - most);
  lines.make_one(left, right, at_start ? 0.0 : at_end ? 1.0 : 0.5);
  const auto from = d.knots.begin() + static_cast<std::ptrdiff_t>(first);
  d.knots.erase(from, from + (many - most));
}

/// Knots of the used range, each once.
int spans_of(const SurfaceDirection& d) {
  int count = 0;
  for (std::size_t k = 1; k < d.knots.size(); ++k)
    count += d.knots[k] > d.knots[k - 1] && d.knots[k] > d.start && d.knots[k - 1] < d.end ? 1 : 0;
  return count;
}

/// Returns how many spans are gone.
int merge_direction(NurbsSurface& surface, bool along_u, double thin) {
  Lines lines(surface, along_u);
  SurfaceDirection& d = lines.direction();
  const int before = spans_of(d);
  const double width = thin * (d.end - d.start);
  for (std::size_t first = 0; first < d.knots.size();) {
    // Knots that follow each other closely, and no farther than that from the first: what they make one is thin too.
    std::size_t last = first + 1;
    while (last < d.knots.size() && d.knots[last] - d.knots[first] <= width) ++last;
    const double low = d.knots[first], high = d.knots[last - 1];
    const std::size_t size = d.knots.size();
    if (high > low) {
      const double knot = low <= d.start && high >= d.start ? d.start : low <= d.end && high >= d.end ? d.end : low;
      gather(lines, first, last, knot);
    }
    first = last - (size - d.knots.size());
  }
  return before - spans_of(d);
}

/// Evaluates what extract_bezier made of a surface.
class Evaluated {
 public:
  explicit Evaluated(const NurbsSurface& surface) : patch_(extract_bezier(surface)) {}

  [[nodiscard]] const BezierPatch& patch() const { return patch_; }
  [[nodiscard]] Eigen::Vector3d at(double u, double v) const {
    const std::size_t iu = place(patch_.breaks_u, u), iv = place(patch_.breaks_v, v);
    const BezierSpan span = patch_.span(iu * patch_.spans_v() + iv);
    const auto local = [](const std::vector<double>& b, std::size_t k, double t) {
      return (t - b[k]) / (b[k + 1] - b[k]) - 0.5;
    };
    HomogeneousDerivatives h;
    evaluate_taylor(span.taylor, span.degree_u, span.degree_v, local(patch_.breaks_u, iu, u),
                    local(patch_.breaks_v, iv, v), h);
    return Eigen::Vector3d(h.a.head<3>() / h.a[3]);
  }

 private:
  static std::size_t place(const std::vector<double>& breaks, double t) {
    const auto next = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, t);
    return static_cast<std::size_t>(next - breaks.begin()) - 1;
  }

  BezierPatch patch_;
};

std::vector<double> looks(const std::vector<double>& breaks) {
  std::vector<double> out;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    for (int i = 0; i < kLooks; ++i) out.push_back(breaks[k] + (breaks[k + 1] - breaks[k]) * i / kLooks);
  }
  out.push_back(breaks.back());
  return out;
}

/// Looked at where spans are left, and inside of those that are gone.
double moved(const Evaluated& before, const NurbsSurface& after) {
  const Evaluated now(after);
  double most = 0;
  for (const BezierPatch* patch : {&now.patch(), &before.patch()}) {
    const std::vector<double> us = looks(patch->breaks_u), vs = looks(patch->breaks_v);
    for (const double u : us) {
      for (const double v : vs) most = std::max(most, (before.at(u, v) - now.at(u, v)).norm());
    }
  }
  return most;
}

}  // namespace

MergedSpans merge_thin_spans(NurbsSurface& surface, double tolerance_mm) {
  NurbsSurface trial = surface;
  MergedSpans merged;
  std::optional<Evaluated> before;
  for (const double thin : kThin) {
    merged.spans_u = merge_direction(trial, true, thin);
    merged.spans_v = merge_direction(trial, false, thin);
    if (merged.count() == 0) return {};
    if (!before) before.emplace(surface);
    merged.moved_mm = moved(*before, trial);
    if (merged.moved_mm <= tolerance_mm) {
      surface = std::move(trial);
      return merged;
    }
    trial = surface;
  }
  return {};
}

}  // namespace bladefit

#include "tools/design/image/span_bounding.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <limits>
#include <span>
#include <thread>

#include "tools/design/image/leaf_subdivision.hpp"

namespace bladefit {
namespace {

/// Boxes are wider than their control points by this share of their coordinates, so that whoever checks the image may
/// round otherwise.
constexpr double kBoxMargin = 1e-13;

Box control_box(const BezierNet& net) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::uint32_t k = 0; k < (net.degree_u + 1) * (net.degree_v + 1); ++k) {
      const double coordinate = net.points[k][axis] / net.points[k][3];
      low = std::min(low, coordinate);
      high = std::max(high, coordinate);
    }
    const double margin = kBoxMargin * std::max(std::abs(low), std::abs(high));
    box.min[axis] = low - margin;
    box.max[axis] = high + margin;
  }
  return box;
}

SpanBounding bounding_of(const BezierPatch& bezier, std::size_t index, int outward, double near, ImageSize size) {
  const BezierSpan span = bezier.span(index);
  SpanBounding out;
  out.cone = normal_cone({span.net, bezier.span_size()}, bezier.degree_u, bezier.degree_v, outward);
  out.leaves = size == ImageSize::compact ? keep_as_leaf(span, near) : cut_into_leaves(span, near);
  for (const ImageLeaf& leaf : out.leaves) {
    BezierNet restricted;
    restrict_net(span.net, span.degree_u, span.degree_v, {leaf.s_min, leaf.s_max, leaf.t_min, leaf.t_max}, restricted);
    out.boxes.push_back(control_box(restricted));
  }
  return out;
}

}  // namespace

std::vector<SpanBounding> bound_spans(const BezierPatch& bezier, int outward, double near, ImageSize size) {
  std::vector<SpanBounding> spans(bezier.spans_u() * bezier.spans_v());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t k = next++; k < spans.size(); k = next++) spans[k] = bounding_of(bezier, k, outward, near, size);
  };
  std::vector<std::future<void>> others;
  for (unsigned k = 1; k < std::thread::hardware_concurrency(); ++k)
    others.push_back(std::async(std::launch::async, work));
  work();
  for (std::future<void>& other : others) other.get();
  return spans;
}

}  // namespace bladefit

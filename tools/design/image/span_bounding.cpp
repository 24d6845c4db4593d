#include "tools/design/image/span_bounding.hpp"

#include <atomic>
#include <future>
#include <thread>

namespace bladefit {
namespace {

SpanBounding bounding_of(const BezierPatch& bezier, std::size_t index, int outward, double near, ImageSize size) {
  const BezierSpan span = bezier.span(index);
  return {normal_cone({span.net, bezier.span_size()}, bezier.degree_u, bezier.degree_v, outward),
          size == ImageSize::compact ? keep_as_leaf(span, near) : cut_into_leaves(span, near)};
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

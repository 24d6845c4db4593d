#include "core/localizer/point_selection.hpp"

#include <limits>

namespace bladefit {

void PointSelection::by_exits(PointStore& store) {
  rule_ = Rule::by_exits;
  readmitted_ = false;
  for (std::uint32_t i = 0; i < store.size(); ++i) store[i].exits = 0;
}

bool PointSelection::readmit(PointStore& store) {
  if (rule_ != Rule::by_exits || readmitted_) return false;
  for (std::uint32_t i = 0; i < store.size(); ++i) {
    StoredPoint& point = store[i];
    if (point.exits < tuning::kMostExits || out_by_foot(point, point.foot)) continue;
    point.exits = 0;
    readmitted_ = true;
  }
  return readmitted_;
}

void PointSelection::hold(PointStore& store) {
  for (std::uint32_t i = 0; i < store.size(); ++i) store[i].held_out = left_out(store[i], store[i].foot);
  rule_ = Rule::held;
}

PointSelection::Span PointSelection::distances(const PointStore& store, std::uint32_t stride) const {
  Span span{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (std::uint32_t i = 0; i < store.size(); i += stride) {
    if (left_out(store[i], store[i].foot)) continue;
    span.least = std::min(span.least, store[i].foot.distance);
    span.most = std::max(span.most, store[i].foot.distance);
  }
  return span;
}

void PointSelection::note_exit(StoredPoint& point, const Foot& next) const {
  const bool exits = !left_out(point, point.foot) && left_out(point, next);
  if (exits && point.exits < UINT8_MAX) ++point.exits;
}

}  // namespace bladefit

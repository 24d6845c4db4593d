#include <limits>

#include "core/localizer.hpp"

namespace bladefit {
namespace {

bool on_design(const Surface& surface, const SurfacePlace& place) {
  const bool inside = place.u >= 0.0 && place.u <= 1.0 && place.v >= 0.0 && place.v <= 1.0;
  return inside && place.span < surface.image().spans().size();
}

}  // namespace

Status Localizer::stage(const ProbePoint& point) {
  if (const Status status = check(point); status != Status::ok) return status;
  if (stored_ == config_.capacity) return Status::out_of_range;
  stage(made_from(point, last_place_), Search::always);
  return Status::ok;
}

Status Localizer::stage_from(const ProbePoint& point, const SurfacePlace& start) {
  if (const Status status = check(point); status != Status::ok) return status;
  if (stored_ == config_.capacity || !on_design(surface_, start)) return Status::out_of_range;
  StoredPoint passing = made_from(point, start);
  passing.rivals.lead = std::numeric_limits<double>::infinity();  // no motion makes the foot doubtful
  stage(passing, Search::if_doubtful);
  return Status::ok;
}

void Localizer::stage(const StoredPoint& passing, Search search) {
  refinement_.active = converged_ = regions_held_ = exits_count_ = infeasible_ = false;
  stop_trackers();
  redetermine_ = true;
  settle_all();
  if (cursor_ > 0) begin_sweep();  // points that were to become active at its end are in no sums of it
  const Measurement measurement = measure(passing, pose_, search);
  count_in(passing, measurement);
  order_[stored_] = stored_;
  StoredPoint& own = points_[stored_++];
  own = passing;
  note(own, measurement);
  include(settled_, own, measurement);
  current_ = settled_;
  judge(own);
  own.told_state = own.state;
  own.told_action = own.action;
}

}  // namespace bladefit

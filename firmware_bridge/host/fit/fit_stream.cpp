#include "firmware_bridge/host/fit/fit_stream.hpp"

namespace bladefit {
namespace {

constexpr std::uint32_t kSettlePoints = 4096;
constexpr int kMostSettleCalls = 20000;

}  // namespace

bool FitStream::push(const ProbePoint& point, Verdict& verdict) {
  const Status status = localizer_.push(point, verdict);
  if (status == Status::duplicate) return false;
  if (!succeeded(status)) {
    verdict = {};
    verdict.sequence = point.sequence;
    verdict.state = PointState::rejected;
    return true;
  }
  path_ended_ = path_ != 0 && point.path != 0 && point.path != path_;
  path_ = point.path;
  settled_ = false;
  return true;
}

void FitStream::end_path() {
  if (!path_ended_) return;
  path_ended_ = false;
  // A refinement starts its sweep over the stored points again: cut short path after path it would never get to the
  // later ones. With more points than the budget the sweeps of push() do the work.
  if (localizer_.fit().points > path_refine_points_) return;
  // Whatever is left to do is done by later pushes and by settle().
  [[maybe_unused]] const Status status = localizer_.refine(path_refine_points_);
}

void FitStream::settle() {
  if (settled_) return;
  settled_ = true;
  localizer_.conclude();
  for (int call = 0; call < kMostSettleCalls; ++call) {
    if (localizer_.refine(kSettlePoints) != Status::more_work) return;
  }
}

void FitStream::reset() {
  localizer_.reset();
  path_ = 0;
  path_ended_ = false;
  settled_ = true;
}

}  // namespace bladefit

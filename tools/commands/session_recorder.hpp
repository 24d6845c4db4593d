#pragma once
#include "tools/commands/run_plan.hpp"

namespace bladefit {

/// Writes what reports of a session need into its folder, record and design, once there is a recording: so they have it
/// also where the run is killed, and a session that never began leaves nothing. What cannot be written is told, and
/// keeps the session from nothing.
class SessionRecorder {
 public:
  /// The session begins now. `plan` must outlive it.
  explicit SessionRecorder(const RunPlan& plan);

  /// Writes where a recording is there and nothing was written yet.
  void turn();

  /// As it is written, from the first recording on.
  [[nodiscard]] const ReportRecord& record() const { return record_; }

 private:
  const RunPlan& plan_;
  ReportRecord record_;
  bool written_ = false;
};

}  // namespace bladefit

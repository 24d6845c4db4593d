#include "firmware_bridge/host/panel/publication.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_bridge/host/blade/view_of_blade.hpp"
#include "firmware_bridge/host/panel/panel_texts.hpp"

namespace bladefit {
namespace {

constexpr std::chrono::milliseconds kLongestWait{100};
constexpr std::chrono::seconds kLongestLinger{1};
constexpr std::chrono::milliseconds kBladeEvery{200};  ///< what is told of places costs more than a point

float to_float(double value) { return static_cast<float>(value); }

PanelPlace place_of(const Verdict& verdict, const ShaftAxis& axis) {
  const Foot& foot = verdict.foot;
  return {.sequence = verdict.sequence,
          .distance = to_float(foot.distance),
          .patch = static_cast<std::uint16_t>(foot.patch),
          .u = to_float(foot.u),
          .v = to_float(foot.v),
          .radius = to_float(axis.radius_of(foot.point)),
          .action = verdict.action};
}

/// How far off in tolerances; 0 where there is no point, or no tolerance.
double over_tolerance(const Verdict* verdict) {
  return verdict != nullptr ? std::abs(verdict->foot.distance) / verdict->tolerance_mm : 0;
}

}  // namespace

Publication::Publication(const ToleranceMap& tolerance, const BladeLayout& layout, const std::string& source,
                         PanelServer& server, PointFeed* feed, HostShared& shared)
    : tolerance_(tolerance),
      layout_(layout),
      server_(server),
      feed_(feed),
      shared_(shared),
      tally_(tolerance_, layout_) {
  state_.texts[kSourceText] = source;
}

void Publication::run() {
  const auto on_commands = [this](const PanelCommands& commands) { follow(commands); };
  while (true) {
    const bool over = shared_.fit_done.load();
    const bool last_turn = over && shared_.panel_closed.load();
    shared_.to_publication.wakeup.clear();
    follow_others();
    if (take_news() || last_turn || pressed_ || Clock::now() - times_.state >= kLongestWait) show();
    server_.serve(image_, on_commands);
    if (last_turn) return linger();
    server_.wait(shared_.to_publication.wakeup.descriptor(), kLongestWait);
  }
}

/// Clients that ask now and then are to see the end.
void Publication::linger() {
  const Clock::time_point end = Clock::now();
  while (!server_.has_told_all(end) && Clock::now() < end + kLongestLinger) {
    server_.wait(shared_.to_publication.wakeup.descriptor(), kLongestWait);
    server_.serve(image_, [](const PanelCommands&) {});
    shared_.to_publication.wakeup.clear();
  }
}

void Publication::show() {
  pressed_ = false;
  times_.state = Clock::now();
  const std::lock_guard lock(common_.mutex);
  update_state();
  state_.ended = common_.concluded.has_value();
  common_.shown = state_;
  common_.shown.has_extension = common_.shown.has_blade = true;
  image_ = encode_panel(state_, server_.format());
}

PanelState Publication::shown() {
  const std::lock_guard lock(common_.mutex);
  return common_.shown;
}

void Publication::press(const PanelCommands& commands) {
  {
    const std::lock_guard lock(common_.mutex);
    PanelCommands& all = common_.pressed ? *common_.pressed : common_.pressed.emplace();
    // The later one of two that contradict each other stands.
    if (commands.start || commands.stop) all.start = all.stop = false;
    all.start |= commands.start;
    all.stop |= commands.stop;
    all.reset |= commands.reset;
    all.acknowledge |= commands.acknowledge;
  }
  shared_.to_publication.wakeup.signal();
}

/// Does what other threads pressed.
void Publication::follow_others() {
  std::optional<PanelCommands> commands;
  {
    const std::lock_guard lock(common_.mutex);
    commands.swap(common_.pressed);
  }
  if (commands) follow(*commands);
}

void Publication::conclude(const Conclusion& conclusion, std::shared_ptr<const Tally> judged_again) {
  const std::lock_guard lock(common_.mutex);
  common_.concluded = conclusion;
  common_.judged_again = std::move(judged_again);
}

/// True where there were any.
bool Publication::take_news() {
  bool any = false;
  FitOutput output;
  while (shared_.to_publication.ring.pop(output)) {
    take(output);
    any = true;
  }
  // Figures are taken after the verdicts: they are never older than those.
  const bool newer_fit = shared_.fit_figures.take(figures_);
  const bool newer_link = shared_.link_figures.take(link_);
  return any || newer_fit || newer_link;
}

void Publication::take(const FitOutput& output) {
  const Verdict& verdict = output.verdict;
  switch (output.kind) {
    case FitOutput::Kind::forgotten:
      tally_.clear();
      if (feed_ != nullptr) feed_->clear();
      last_ = {};
      return;
    case FitOutput::Kind::given_up:
      return tally_.give_up(verdict.sequence);
    case FitOutput::Kind::followed:
    case FitOutput::Kind::judged:
    case FitOutput::Kind::judged_last:
      break;
  }
  tally_.accept(verdict);
  if (feed_ != nullptr) output.kind == FitOutput::Kind::followed ? feed_->followed(verdict) : feed_->judged(verdict);
  if (verdict.sequence >= last_.sequence) last_ = verdict;
  if (output.kind == FitOutput::Kind::judged_last) tally_.give_up(verdict.sequence);
}

void Publication::update_state() {
  update_counts();
  update_fit();
  update_last();
  update_places();
  update_link();
  update_blade();
  state_.session = session_state();
  state_.alarms = alarms();
  update_verdict();
  const auto running = std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - times_.start).count();
  state_.heartbeat = static_cast<std::uint16_t>(running);
}

void Publication::update_counts() {
  const TallyCounts& counts = tally().counts();
  state_.points = counts.points;
  state_.leading_edge_points = counts.leading_edge;
  state_.leading_edge_out = counts.leading_edge_out;
  state_.rest_out = counts.rest_out;
  state_.rejected = counts.rejected;
  const bool at_rest = figures_.report.status == FitStatus::converged;
  const Verdict none, *const edge = tally().worst(Region::leading_edge, at_rest),
                             *const rest = tally().worst(Region::rest, at_rest);
  state_.worst_leading_edge = to_float((edge != nullptr ? *edge : none).foot.distance);
  state_.worst_leading_edge_sequence = (edge != nullptr ? *edge : none).sequence;
  state_.worst_rest = to_float((rest != nullptr ? *rest : none).foot.distance);
  state_.worst_rest_sequence = (rest != nullptr ? *rest : none).sequence;
  const Verdict* const worst = over_tolerance(rest) > over_tolerance(edge) || edge == nullptr ? rest : edge;
  state_.texts[kWorstText] = worst_words(worst, worst != nullptr ? layout_.axis().radius_of(worst->foot.point) : 0);
}

void Publication::update_fit() {
  const FitReport& report = figures_.report;
  state_.fit_status = static_cast<std::uint16_t>(report.status);
  state_.rms = to_float(report.rms_mm);
  state_.leading_edge_rms = to_float(report.leading_edge.rms_mm);
  const EulerAngles angles = euler_angles(report.pose.rotation);
  const Vec3& shift = report.pose.translation;
  state_.pose = {to_float(shift.x()),  to_float(shift.y()),    to_float(shift.z()),
                 to_float(angles.psi), to_float(angles.theta), to_float(angles.phi)};
  state_.determined = static_cast<std::uint16_t>(report.determined);
  state_.smallest_feasible = to_float(report.smallest_tolerance_mm);
  state_.improving = report.improving;
  state_.support = report.certificate.sequence;
  state_.leading_edge_tolerance = to_float(tightest_of(tolerance_, Region::leading_edge));
  state_.rest_tolerance = to_float(tightest_of(tolerance_, Region::rest));
  state_.push_latency_us = to_float(figures_.push_p99_us);
}

void Publication::update_verdict() {
  const FitReport& report = figures_.report;
  const TallyCounts& counts = tally().counts();
  const BladeVerdict counted =
      judge_blade({.converged = report.status == FitStatus::converged,
                   .infeasible = report.status == FitStatus::infeasible,
                   .determined = report.determined,
                   .free = report.free,
                   .unproven = report.unproven,
                   .judged = sets_tolerance(tolerance_),
                   .out = counts.leading_edge_out + counts.rest_out,
                   .pending = counts.pending,
                   .undecided = counts.undecided,
                   .lost = figures_.losses.records() + (figures_.losses.unnumbered() ? 1U : 0U),
                   .refused = counts.refused,
                   .zones_missed = tally().zones().missed(),
                   .finished = figures_.losses.finished(),
                   .doubts = {}});
  const Conclusion conclusion = common_.concluded.value_or(Conclusion{counted});
  const BladeVerdict& verdict = conclusion.verdict;
  state_.verdict = verdict.state;
  state_.reasons = reason_bits(verdict.reasons);
  if (link_.link == LinkState::lost) state_.reasons |= kReasonLinkLost;
  if (!judges_everywhere(tolerance_)) state_.reasons |= kReasonNoTolerance;
  if (conclusion.otherwise_count > 0) state_.reasons |= kReasonOtherwise;
  state_.otherwise_count = conclusion.otherwise_count;
  state_.otherwise = conclusion.otherwise;
  state_.fit_determined = report.determined == report.free;
  state_.planned = link_.planned;
  state_.texts[kVerdictText] = verdict_words(state_);
  state_.texts[kAdviceText] = advice_words(state_);
}

void Publication::update_last() {
  state_.last_sequence = last_.sequence;
  state_.last_distance = to_float(last_.foot.distance);
  state_.last_state = last_.state;
  state_.last_action = last_.action;
  state_.last_region = last_.region;
}

void Publication::update_places() {
  state_.newest.fill({});
  const std::vector<Verdict> out = tally().newest_leading_edge_out();
  for (std::size_t place = 0; place < std::min(out.size(), kPanelPlaces); ++place) {
    state_.newest[place] = place_of(out[place], layout_.axis());
  }
}

void Publication::update_link() {
  const bool lost = link_.link == LinkState::lost;
  const auto down = std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - link_.since).count();
  state_.link_down_s = lost ? static_cast<std::uint32_t>(down) : 0;
  state_.lost = figures_.losses.records();
  state_.texts[kFaultText] = lost ? link_.fault.data() : "";
  state_.texts[kLossText] = link_.loss.data();
}

/// The result is told at once.
void Publication::update_blade() {
  const bool due = times_.state - times_.blade >= kBladeEvery;
  if (!due && !common_.concluded) return;
  times_.blade = times_.state;
  state_.blade = view_of_blade(layout_, tally().blade(), figures_.report);
}

SessionState Publication::session_state() {
  if (shared_.outcome.failed() || link_.device_fault) return SessionState::fault;
  if (link_.paused) return SessionState::idle;
  if (link_.link == LinkState::connecting) return SessionState::connecting;
  if (figures_.report.status == FitStatus::underdetermined) return SessionState::collecting;
  return figures_.report.status == FitStatus::converged ? SessionState::settled : SessionState::tracking;
}

std::uint16_t Publication::alarms() const {
  const FitReport& report = figures_.report;
  const bool seen = tally_.times_out() == acknowledged_.times_out;
  unsigned bits = 0;
  if (state_.leading_edge_out > 0 && !seen) bits |= kAlarmLeadingEdgeOut;
  if (state_.rest_out > 0 && !seen) bits |= kAlarmRestOut;
  if (link_.link == LinkState::lost) bits |= kAlarmLinkLost;
  if (link_.losses != acknowledged_.losses) bits |= kAlarmDataGap;
  if (report.memory_full) bits |= kAlarmMemoryFull;
  if (report.status == FitStatus::infeasible) bits |= kAlarmInfeasible;
  return static_cast<std::uint16_t>(bits);
}

void Publication::follow(const PanelCommands& commands) {
  pressed_ = pressed_ || commands.start || commands.stop || commands.reset || commands.acknowledge;
  if (commands.start) shared_.requests.pause.store(false);
  if (commands.stop) shared_.requests.pause.store(true);
  if (commands.reset) shared_.requests.reset.store(true);
  if (!commands.acknowledge) return;
  acknowledged_.times_out = tally_.times_out();
  acknowledged_.losses = link_.losses;
}

}  // namespace bladefit

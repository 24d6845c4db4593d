#include "tools/commands/run_conclusion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "tools/batch/batch_fit.hpp"
#include "tools/files/exit_codes.hpp"
#include "tools/files/message.hpp"
#include "tools/files/output_file.hpp"
#include "tools/results/json_writer.hpp"
#include "tools/results/operator_summary.hpp"
#include "tools/results/session_files.hpp"

namespace bladefit {
namespace {

int exit_code_of(const Failure& failure) { return ToolError(failure).exit_code(); }

/// The points of the ended session.
struct SessionPoints : JudgedPoints {
  void add(const ProbePoint& point, const Verdict& verdict) override { rows.push_back({point, verdict}); }
  void clear() override { rows.clear(); }
  Rows<JudgedPoint> rows;
};

std::string ending(const SessionResult& session, std::size_t points) {
  switch (session.end) {
    case SessionEnd::finished:
      return "the machine's program is finished";
    case SessionEnd::idle:
      return "no new point came";
    case SessionEnd::stopped:
      return "stopped";
    case SessionEnd::running:
    case SessionEnd::failed:
      break;
  }
  return fmt::format("by a fault; what follows is of the {} points stored before it", points);
}

/// Tells the end of the session. Returns false where the output fails; one that nobody reads any more, a pipe or a
/// terminal that is gone, was given up by its reader, and is none of our failures.
bool tell_summary(const RunWords& words, const std::string& text, const RunPlan& plan) {
  std::clearerr(words.file);
  errno = 0;
  const bool told = std::fputs(text.c_str(), words.file) >= 0 && std::fflush(words.file) == 0;
  if (told) return true;
  const int reason = errno;
  tell(fmt::format("the summary cannot be written ({}); the result is in {}", std::strerror(reason),
                   plan.host.session_directory));
  const bool given_up = reason == EPIPE || (words.terminal && reason == EIO);
  if (given_up) std::clearerr(words.file);
  return given_up;
}

WrittenFiles write_files(const RunPlan& plan, const Result& result) {
  WrittenFiles files = write_session_files(plan.host.session_directory, result);
  if (plan.json.empty()) return files;
  const auto json = [&result](const Put& put) { write_result_json(result, put); };
  add_written(
      plan.json, [&] { write_output(plan.json, json); }, files);
  return files;
}

/// What the panel goes on showing.
Conclusion conclusion_of(const Result& result) {
  Conclusion conclusion{{result.verdict.state, result.verdict.codes()}};
  conclusion.otherwise_count = static_cast<std::uint32_t>(result.judged_otherwise.size());
  const std::size_t listed = std::min(result.judged_otherwise.size(), conclusion.otherwise.size());
  std::copy_n(result.judged_otherwise.begin(), listed, conclusion.otherwise.begin());
  return conclusion;
}

}  // namespace

int conclude_run(const RunPlan& plan, Host& host, const RunWords& words, SessionRecorder& recorder) {
  SessionPoints points;
  const SessionResult session = host.finish(points);
  if (session.error) tell(session.error.message);
  // A session that was refused is not this run's to report on.
  const bool refused = session.error.kind == Failure::Kind::bad_input;
  if (session.error && (refused || points.rows.empty())) return exit_code_of(session.error);
  const StreamEvidence stream{session.lost, session.losses.unnumbered(), session.refused, session.losses.finished()};
  if (points.rows.empty()) {
    throw ToolError(
        fmt::format("the session in {} has no point that can be used: nothing can be said of the blade; "
                    "check that the machine's program is running",
                    plan.host.session_directory));
  }
  Result result = result_of(plan.image, plan.fit, points.rows, session.report, stream, plan.host.session_directory);
  recorder.turn();
  result.record = recorder.record();
  result.record->ended = utc_now();
  host.conclude(conclusion_of(result));
  const WrittenFiles files = write_files(plan, result);
  std::string text = told_of(operator_summary(result), plan.volume);
  if (!plan.volume.quiet) text.insert(0, fmt::format("Session ended: {}\n", ending(session, points.rows.size())));
  for (const std::string& path : files.paths)
    text += path == "-" || plan.volume.quiet ? "" : fmt::format("Written: {}\n", path);
  const bool told = tell_summary(words, text, plan);
  for (const Failure& failure : files.failures) tell(failure.message);
  if (session.error) return exit_code_of(session.error);
  if (!files.failures.empty()) return exit_code_of(files.failures.front());
  return told ? exit_code_of(result) : kDeviceFailure;
}

}  // namespace bladefit

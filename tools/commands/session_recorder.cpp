#include "tools/commands/session_recorder.hpp"

#include <filesystem>

#include "firmware_bridge/host/journal/session_file_names.hpp"
#include "tools/files/message.hpp"
#include "tools/results/session_files.hpp"

namespace bladefit {
namespace {

/// Runs a step; why it fails is told.
template <typename Step>
void told_where_it_fails(const Step& step) {
  try {
    step();
  } catch (const ToolError& error) {
    tell(error.what());
  }
}

}  // namespace

SessionRecorder::SessionRecorder(const RunPlan& plan) : plan_(plan) {
  told_where_it_fails([this] { record_ = report_record_of(plan_.report, plan_.files); });
}

void SessionRecorder::turn() {
  const std::string& directory = plan_.host.session_directory;
  std::error_code error;
  if (written_ || !std::filesystem::exists(std::filesystem::path(directory) / kJournalFile, error)) return;
  written_ = true;
  told_where_it_fails([&] {
    if (const auto before = read_session_record(directory)) record_ = resumed(*before, record_);
  });
  told_where_it_fails([&] { write_session_record(directory, record_); });
  told_where_it_fails([&] { write_session_design(directory, plan_.design.image); });
}

}  // namespace bladefit

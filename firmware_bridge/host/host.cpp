#include "firmware_bridge/host/host.hpp"

#include <fmt/core.h>

#include <cstring>
#include <filesystem>
#include <new>
#include <optional>
#include <thread>

#include "firmware_bridge/host/acquisition.hpp"
#include "firmware_bridge/host/blade/blade_layout.hpp"
#include "firmware_bridge/host/fit/fit_stream.hpp"
#include "firmware_bridge/host/fit/fit_worker.hpp"
#include "firmware_bridge/host/journal/config_digest.hpp"
#include "firmware_bridge/host/journal/journal.hpp"
#include "firmware_bridge/host/journal/journal_reader.hpp"
#include "firmware_bridge/host/journal/journal_writer.hpp"
#include "firmware_bridge/host/journal/session_file_names.hpp"
#include "firmware_bridge/host/journal/session_folder.hpp"
#include "firmware_bridge/host/journal/session_settings_file.hpp"
#include "firmware_bridge/host/panel/publication.hpp"

namespace bladefit {
namespace {

constexpr std::align_val_t kLocalizerAlignment{64};
constexpr std::chrono::milliseconds kEndPoll{5};

/// The one block that the fit works in, touched once so that no page fault comes later.
class LocalizerMemory {
 public:
  explicit LocalizerMemory(std::size_t size)
      : bytes_(static_cast<std::byte*>(::operator new(size, kLocalizerAlignment))), size_(size) {
    std::memset(bytes_, 0, size);
  }
  ~LocalizerMemory() { ::operator delete(bytes_, kLocalizerAlignment); }
  LocalizerMemory(const LocalizerMemory&) = delete;
  LocalizerMemory& operator=(const LocalizerMemory&) = delete;
  [[nodiscard]] std::span<std::byte> bytes() const { return {bytes_, size_}; }

 private:
  std::byte* bytes_;
  std::size_t size_;
};

Failure check_identity(const std::string& folder, const JournalSummary& recorded, const SessionIdentity& wanted,
                       const std::string& settings) {
  if (!recorded.exists) return {};
  const std::string path = journal_path(folder);
  if (recorded.identity.design_crc != wanted.design_crc) {
    return bad_input(
        fmt::format("{}: the session in this folder was probed against another design; name that "
                    "design, or another folder with --session",
                    path));
  }
  if (recorded.identity.config_digest == wanted.config_digest) return {};
  const std::string which = differing_settings(folder, recorded.identity.config_digest, settings);
  return bad_input(
      fmt::format("{}: the session was begun with other fit settings{}{}; repeat those, or name another folder with "
                  "--session",
                  path, which.empty() ? "" : ": ", which));
}

/// Counts the points on their way.
class CountedPoints : public JudgedPoints {
 public:
  CountedPoints(const ToleranceMap& tolerance, const BladeLayout& layout, JudgedPoints& to)
      : to_(to), tally_(std::make_shared<Tally>(tolerance, layout)) {}

  void add(const ProbePoint& point, const Verdict& verdict) override {
    tally_->accept(verdict);
    tally_->give_up(verdict.sequence);
    to_.add(point, verdict);
  }
  void clear() override {
    tally_->clear();
    to_.clear();
  }
  [[nodiscard]] std::shared_ptr<const Tally> tally() const { return tally_; }

 private:
  JudgedPoints& to_;
  std::shared_ptr<Tally> tally_;
};

}  // namespace

std::string journal_path(const std::string& session_directory) {
  return (std::filesystem::path(session_directory) / kJournalFile).string();
}

/// What exists while the threads run. The members that threads use come before the threads.
struct Host::Running {
  SessionFolder folder;  ///< outlives the journal in it
  Journal journal;
  JournalReader recorded;     ///< of what the journal held before
  std::string settings_text;  ///< of this session
  PanelServer server;
  BladeLayout layout;
  std::unique_ptr<PointFeed> feed;
  std::unique_ptr<LocalizerMemory> memory;
  Localizer* localizer = nullptr;
  std::optional<Acquisition> acquisition;
  std::optional<FitWorker> fit;
  std::optional<Publication> publication;
  std::shared_ptr<const Tally> judged_again;  ///< of a session whose memory was full
  std::thread panel;
  std::vector<std::thread> threads;  ///< the others

  [[nodiscard]] Failure open_journal(const HostSettings& settings, const SessionIdentity& identity);
  [[nodiscard]] Failure make_localizer(const LocalizerConfig& config, const DesignImage& design);
};

Failure Host::Running::open_journal(const HostSettings& settings, const SessionIdentity& identity) {
  if (const Failure error = folder.make(settings.session_directory)) return error;
  const std::string path = journal_path(settings.session_directory);
  if (const Failure error = journal.open(path)) return error;
  if (const Failure error = recorded.open(journal.descriptor(), path)) return error;
  settings_text = bladefit::settings_text(settings.localizer, settings.path_refine_points);
  const JournalSummary& summary = recorded.summary();
  if (Failure error = check_identity(settings.session_directory, summary, identity, settings_text)) return error;
  return summary.exists ? journal.resume(summary.records) : Failure{};
}

Failure Host::Running::make_localizer(const LocalizerConfig& config, const DesignImage& design) {
  memory = std::make_unique<LocalizerMemory>(Localizer::memory_required(config));
  const Status status = Localizer::create(memory->bytes(), design, config, localizer);
  if (succeeded(status)) return {};
  return bad_input(
      fmt::format("the fit cannot start with these settings ({}); check capacity, tolerances, "
                  "leading-edge boxes and probe radius",
                  status_text(status)));
}

Host::Host(HostSettings settings, const DesignImage& design, ProbeSource& source,
           std::function<void(const std::string&)> on_notice)
    : settings_(std::move(settings)), design_(design), source_(source), shared_(std::move(on_notice)) {}

Host::~Host() {
  if (!running_) return;
  request_stop();
  for (std::thread& thread : running_->threads) {
    if (thread.joinable()) thread.join();
  }
  close_panel();
}

Failure Host::start() {
  running_ = std::make_unique<Running>();
  Running& running = *running_;
  const SessionIdentity identity{design_.identity(), config_digest(settings_.localizer, settings_.path_refine_points)};
  if (const Failure error = running.make_localizer(settings_.localizer, design_)) return error;
  if (const Failure error = running.open_journal(settings_, identity)) return error;
  if (const Failure error = running.server.open(settings_.panel)) return error;
  if (const JournalSummary& recorded = running.recorded.summary(); recorded.exists) {
    shared_.notices.write(
        fmt::format("session resumed: {} events in the journal, {} bytes of an unfinished record cut off",
                    recorded.records, recorded.torn_bytes));
  }
  const AcquisitionSettings acquisition{
      identity,         settings_.session_directory, running.settings_text, settings_.end_when_finished, settings_.idle,
      settings_.planned};
  running.acquisition.emplace(acquisition, running.recorded, source_, running.journal, shared_);
  running.fit.emplace(*running.localizer, settings_.localizer.capacity, settings_.path_refine_points, shared_);
  running.layout = BladeLayout(design_, settings_.localizer, settings_.axis, settings_.tip_radius_mm);
  if (settings_.feed) running.feed = std::make_unique<PointFeed>();
  running.publication.emplace(settings_.localizer.tolerance, running.layout, settings_.source_name, running.server,
                              running.feed.get(), shared_);
  running.panel = std::thread([&running] { running.publication->run(); });
  running.threads.emplace_back([&running] { running.fit->run(); });
  running.threads.emplace_back([&running, this] { write_journal(running.journal, shared_); });
  running.threads.emplace_back([&running] { running.acquisition->run(); });
  return {};
}

std::uint16_t Host::panel_port() const { return running_->server.port(); }

bool Host::wait_for_end(std::chrono::milliseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (!shared_.fit_done.load()) {
    if (std::chrono::steady_clock::now() >= deadline) return false;
    std::this_thread::sleep_for(kEndPoll);
  }
  return true;
}

void Host::request_stop() { shared_.requests.stop.store(true); }

PanelState Host::panel_state() const { return running_->publication->shown(); }

const PointFeed* Host::feed() const { return running_->feed.get(); }

void Host::press(const PanelCommands& commands) { running_->publication->press(commands); }

void Host::conclude(const Conclusion& conclusion) {
  running_->publication->conclude(conclusion, running_->judged_again);
  shared_.to_publication.wakeup.signal();
}

void Host::close_panel() {
  shared_.panel_closed.store(true);
  shared_.to_publication.wakeup.signal();
  if (running_->panel.joinable()) running_->panel.join();
}

SessionResult Host::finish(JudgedPoints& points) {
  for (std::thread& thread : running_->threads) thread.join();
  SessionResult result{.end = shared_.outcome.end(),
                       .error = shared_.outcome.failure(),
                       .report = {},
                       .refused = {},
                       .losses = {},
                       .lost = {}};
  // The open file, whatever has become of its name.
  JournalReader stored;
  Failure unreadable = stored.open(running_->journal.descriptor(), journal_path(settings_.session_directory));
  Localizer& localizer = *running_->localizer;
  if (result.error || unreadable) {
    // Where the disk failed, points were fitted that the result does not hold.
    FitStream again(localizer, settings_.path_refine_points);
    const Failure broken = again.replay([&stored](const auto& follow) { return stored.for_each(follow); });
    if (!unreadable) unreadable = broken;
  }
  result.report = localizer.fit();
  CountedPoints counted(settings_.localizer.tolerance, running_->layout, points);
  JudgedPoints& to = result.report.memory_full ? counted : points;
  const Failure broken = stored.for_each([&](const StreamEvent& event) { add_event(event, localizer, result, to); });
  if (!unreadable) unreadable = broken;
  if (unreadable && !result.error) result.error = unreadable;
  if (result.error) result.end = SessionEnd::failed;
  if (shared_.outcome.program_ended()) result.losses.finish();
  if (result.report.memory_full) running_->judged_again = counted.tally();
  return result;
}

}  // namespace bladefit

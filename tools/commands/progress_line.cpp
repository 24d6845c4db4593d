#include "tools/commands/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace bladefit {
namespace {

constexpr std::chrono::milliseconds kSilent{1000}, kEvery{200};
constexpr std::size_t kBar = 20;

bool can_take_a_line_back() {
  const char* const kind = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && kind != nullptr && *kind != '\0' && std::string_view(kind) != "dumb";
}

/// "8 s", "2 min 05 s".
std::string time_text(double seconds) {
  const auto whole = static_cast<long>(std::ceil(seconds));
  return whole < 60 ? fmt::format("{} s", whole) : fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

}  // namespace

std::string progress_text(const std::string& step, std::size_t done, std::size_t of,
                          std::chrono::duration<double> taken) {
  if (of == 0) return fmt::format("{}: {}", step, time_text(taken.count()));
  const double share = static_cast<double>(std::min(done, of)) / static_cast<double>(of);
  const auto full = static_cast<std::size_t>(share * kBar);
  std::string text = fmt::format("{} [{}{}] {:.0f} %", step, std::string(full, '#'), std::string(kBar - full, '.'),
                                 std::floor(100 * share));
  if (done > 0) text += fmt::format(", {} left", time_text(taken.count() * (1 - share) / share));
  return text;
}

ProgressLine::ProgressLine(bool wanted) {
  if (wanted && can_take_a_line_back()) keeper_ = std::thread([this] { keep_time(); });
}

ProgressLine::~ProgressLine() {
  if (!keeper_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  over_.notify_one();
  keeper_.join();
}

void ProgressLine::begin(std::string step) {
  const std::lock_guard lock(mutex_);
  step_ = std::move(step);
  done_ = of_ = 0;
  step_began_ = Clock::now();
}

void ProgressLine::count(std::size_t done, std::size_t of) {
  const std::lock_guard lock(mutex_);
  done_ = done;
  of_ = of;
}

void ProgressLine::keep_time() {
  std::unique_lock lock(mutex_);
  if (over_.wait_for(lock, kSilent, [this] { return ends_; })) return;
  do {
    if (step_.empty()) continue;
    std::fputs(("\r\033[K" + progress_text(step_, done_, of_, Clock::now() - step_began_)).c_str(), stderr);
    std::fflush(stderr);
  } while (!over_.wait_for(lock, kEvery, [this] { return ends_; }));
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
}

}  // namespace bladefit

#include "firmware_bridge/host/journal/disk_watch.hpp"

#include <fmt/core.h>

namespace bladefit {
namespace {

constexpr std::chrono::seconds kSlow{1};

}  // namespace

std::string DiskWatch::look(std::uint64_t taken, std::uint64_t stored, Clock::time_point now) {
  const bool waits = stored < taken;
  if (!waits || !waiting_ || stored != stored_) since_ = now;
  const bool moved = stored != stored_;
  stored_ = stored;
  waiting_ = waits;
  if (told_ && moved) {
    told_ = false;
    return fmt::format("{}: the disk stores points again", folder_);
  }
  if (told_ || !waits || now - since_ < kSlow) return {};
  told_ = true;
  return fmt::format(
      "{}: the disk has stored nothing for {} s; points that wait are judged but not acknowledged: free the disk of "
      "other work, or use a session folder on another disk next time",
      folder_, kSlow.count());
}

}  // namespace bladefit

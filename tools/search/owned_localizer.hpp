#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <new>

#include "core/localizer.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {

/// A localizer for `points` points in memory of its own. Throws ToolError where it cannot start.
class OwnedLocalizer {
 public:
  OwnedLocalizer(const DesignImage& design, LocalizerConfig config, std::size_t points) {
    config.capacity = static_cast<std::uint32_t>(std::max<std::size_t>(points, 6));
    const std::size_t size = Localizer::memory_required(config);
    memory_.reset(static_cast<std::byte*>(::operator new(size, std::align_val_t(64))));
    const Status status = Localizer::create({memory_.get(), size}, design, config, localizer_);
    if (status != Status::ok) throw ToolError(fmt::format("the fit cannot start: {}", status_text(status)));
  }
  Localizer& operator*() const { return *localizer_; }
  Localizer* operator->() const { return localizer_; }

 private:
  struct Release {
    void operator()(std::byte* p) const { ::operator delete(p, std::align_val_t(64)); }
  };
  std::unique_ptr<std::byte, Release> memory_;
  Localizer* localizer_ = nullptr;
};

}  // namespace bladefit

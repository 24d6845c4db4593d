#pragma once
#include <memory>

#include "drivers/source/probe_source.hpp"
#include "drivers/source_settings.hpp"

namespace bladefit {

/// The source that `settings.kind` names, not yet open. Null where the kind is `none`.
[[nodiscard]] std::unique_ptr<ProbeSource> make_source(const SourceSettings& settings);

}  // namespace bladefit

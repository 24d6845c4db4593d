#pragma once
#include <memory>

#include "drivers/source/probe_source.hpp"
#include "drivers/source_settings.hpp"

namespace bladefit {

/// The source that these are the settings of, not yet open. Null where nobody has said which protocol it is.
[[nodiscard]] std::unique_ptr<ProbeSource> make_source(const SourceSettings& settings);

}  // namespace bladefit

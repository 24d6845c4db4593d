#pragma once
#include "drivers/source_settings.hpp"
#include "tools/doctor/design_match.hpp"
#include "tools/doctor/examination.hpp"

namespace bladefit {

/// Looks at a device with its settings and says whether they make sense of it, and of the design where there is one
/// (may be null), or which others do. Nothing is written to the device. Takes until `until`, give or take one reply.
/// Throws ToolError (bad_input) where there is no device: a recording.
[[nodiscard]] Examination examine_device(const SourceSettings& settings, const PlacedDesign* design, Deadline until);

}  // namespace bladefit

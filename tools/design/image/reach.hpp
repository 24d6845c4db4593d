#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace bladefit {

/// Writes into a valid image how far each span reaches (ImageSpan::reach, ImageSpan::apart), which leaves out searches
/// and changes no bit of a fit; for images that are kept. Works on all cores; the outcome does not depend on their
/// number. `tell(done, spans)` is called by the caller's thread from time to time. Cost: a millisecond a span and core.
void mark_reach(std::vector<std::byte>& image,
                const std::function<void(std::uint32_t done, std::size_t spans)>& tell = {});

}  // namespace bladefit

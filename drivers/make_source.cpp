#include "drivers/make_source.hpp"

#include "drivers/source_registry.hpp"
#include "drivers/source_uri.hpp"

namespace bladefit {

std::unique_ptr<ProbeSource> make_source(const SourceSettings& settings) {
  const SourceProtocol* const protocol = protocol_of(settings);
  return protocol == nullptr ? nullptr : protocol->make(settings, source_name(settings));
}

}  // namespace bladefit

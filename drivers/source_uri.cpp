#include "drivers/source_uri.hpp"

#include <fmt/format.h>

#include <utility>

#include "drivers/source_registry.hpp"

namespace bladefit {
namespace {

Failure wrong(std::string_view uri, std::string_view what) {
  return bad_input(fmt::format("source '{}': {}", uri, what));
}

}  // namespace

Failure apply_source_uri(std::string_view uri, SourceSettings& settings) {
  const std::size_t colon = uri.find(':');
  const SourceProtocol* const protocol =
      colon == std::string_view::npos ? nullptr : find_protocol(uri.substr(0, colon));
  if (protocol == nullptr || protocol->form.empty()) {
    return wrong(uri, fmt::format("unknown transport; write {}", source_uri_forms()));
  }
  const bool described = protocol_of(settings) != nullptr;
  if (described && !protocol->accepts(settings)) {
    return wrong(uri, "the device file describes another transport; leave out one of the two");
  }
  SourceSettings changed = described ? settings : protocol->defaults();
  if (const Failure failure = protocol->apply(uri.substr(colon + 1), changed)) return wrong(uri, failure.message);
  settings = std::move(changed);
  return {};
}

std::string source_name(const SourceSettings& settings) {
  const SourceProtocol* const protocol = protocol_of(settings);
  return protocol == nullptr ? "no source" : fmt::format("{}:{}", protocol->word, protocol->place(settings));
}

}  // namespace bladefit

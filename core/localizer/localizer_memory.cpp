#include "core/localizer/localizer_memory.hpp"

#include <new>

namespace bladefit {
namespace {

/// Takes the next `count` objects out of the block at `place`, each constructed.
template <class Object>
Object* placed(std::byte*& place, std::size_t count) {
  auto* first = reinterpret_cast<Object*>(place);
  for (std::size_t k = 0; k < count; ++k) new (first + k) Object();
  place += rounded_up(sizeof(Object) * count);
  return first;
}

}  // namespace

std::array<MemoryPart, 9> parts_in_memory(const LocalizerConfig& config) {
  const bool bounded = config.mode != FitMode::least_squares;
  const std::uint64_t points = config.capacity;
  const std::uint64_t rows = bounded ? BoundRows::doubles_for(points) : 0;
  const std::uint64_t places = bounded ? points : 0;
  constexpr std::uint64_t kSelf = rounded_up(sizeof(Localizer)) + rounded_up(sizeof(LocalizerParts));
  constexpr std::uint64_t kNamed = sizeof(RunningSums) + sizeof(StreamOptimum) + sizeof(Refinement);
  return {{{"configuration, pose and verdicts", kSelf - kNamed},
           {"sums", sizeof(RunningSums)},
           {"programs of the stream", sizeof(StreamOptimum)},
           {"refinement", sizeof(Refinement)},
           {"points", rounded_up(sizeof(StoredPoint) * points)},
           {"points by sequence", rounded_up(sizeof(std::uint32_t) * points)},
           {"revisions that wait", rounded_up(sizeof(std::uint32_t) * points)},
           {"rows of the programs", rounded_up(sizeof(double) * rows)},
           {"other sheets of the points", rounded_up(sizeof(KeptPlaces) * places)}}};
}

LocalizerParts& build_parts(std::byte* place, const DesignImage& design, const LocalizerConfig& config) {
  auto* parts = new (place) LocalizerParts(design, config);
  place += rounded_up(sizeof(LocalizerParts));
  auto* points = placed<StoredPoint>(place, config.capacity);
  auto* order = placed<std::uint32_t>(place, config.capacity);
  parts->store.attach(points, order, config.capacity);
  parts->verdicts.attach(placed<std::uint32_t>(place, config.capacity), config.capacity);
  if (parts->plan.bounded()) {
    auto* rows = placed<double>(place, BoundRows::doubles_for(config.capacity));
    auto* places = placed<KeptPlaces>(place, config.capacity);
    parts->refinement.attach(rows, places, config.capacity);
  }
  return *parts;
}

}  // namespace bladefit

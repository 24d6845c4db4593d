#include <algorithm>
#include <limits>
#include <new>

#include "core/localizer.hpp"
#include "core/localizer/check_config.hpp"
#include "core/localizer/localizer_parts.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kAlignment = 64;
/// Where addresses have 32 bits, a large capacity needs more than that.
constexpr std::uint64_t kMoreThanThereIs = std::numeric_limits<std::size_t>::max() - 4096;

constexpr std::uint64_t rounded_up(std::uint64_t size) { return (size + kAlignment - 1) / kAlignment * kAlignment; }

/// Takes the next `count` objects out of the block at `place`, each constructed.
template <class Object>
Object* placed(std::byte*& place, std::size_t count) {
  auto* first = reinterpret_cast<Object*>(place);
  for (std::size_t k = 0; k < count; ++k) new (first + k) Object();
  place += rounded_up(sizeof(Object) * count);
  return first;
}

}  // namespace

std::array<MemoryPart, 9> Localizer::memory_parts(const LocalizerConfig& config) {
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

std::size_t Localizer::memory_required(const LocalizerConfig& config) {
  std::uint64_t size = 0;
  for (const MemoryPart& part : memory_parts(config)) size += part.size;
  return static_cast<std::size_t>(std::min<std::uint64_t>(size, kMoreThanThereIs));
}

Status Localizer::create(std::span<std::byte> memory, const DesignImage& design, const LocalizerConfig& config,
                         Localizer*& localizer) {
  if (memory.data() == nullptr || design.patches().empty()) return Status::null_argument;
  if (reinterpret_cast<std::uintptr_t>(memory.data()) % kAlignment != 0) return Status::misaligned;
  if (check_config(config, design.patches().size())) return Status::out_of_range;
  if (memory.size() < memory_required(config)) return Status::not_enough_memory;

  localizer = new (memory.data()) Localizer(build(memory.data() + rounded_up(sizeof(Localizer)), design, config));
  localizer->reset();
  return Status::ok;
}

/// The parts at `place`, which has room for memory_required().
LocalizerParts& Localizer::build(std::byte* place, const DesignImage& design, const LocalizerConfig& config) {
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

Status Localizer::set_tolerance(const ToleranceMap& map) {
  const DesignImage design = parts_->problem.surface.image();
  LocalizerConfig wanted = config();
  wanted.tolerance = map;
  if (parts_->stream.accepted > 0 || check_config(wanted, design.patches().size())) return Status::out_of_range;
  parts_ = &build(reinterpret_cast<std::byte*>(parts_), design, wanted);
  reset();
  return Status::ok;
}

const LocalizerConfig& Localizer::config() const { return parts_->problem.config; }

std::size_t Localizer::patches() const { return parts_->problem.surface.image().patches().size(); }

}  // namespace bladefit

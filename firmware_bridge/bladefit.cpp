#include "firmware_bridge/bladefit.h"
#include "firmware_bridge/bladefit_zones.h"

#include <cstdint>
#include <new>
#include <span>

#include "core/localizer.hpp"
#include "core/localizer/check_config.hpp"
#include "firmware_bridge/abi_conversion.hpp"

/// Stands at the start of the caller's memory; the localizer follows.
struct bladefit_handle {
  std::uint64_t mark;
  bladefit::Localizer* localizer;
};

namespace {

using bladefit::DesignImage;
using bladefit::Localizer;
using bladefit::LocalizerConfig;
using bladefit::Status;
using bladefit::Verdict;

/// Marks memory that bladefit_init() has made a fit in, and no copy of it elsewhere.
std::uint64_t mark_of(const void* memory) { return 0x626C616465666974ULL ^ reinterpret_cast<std::uintptr_t>(memory); }
constexpr std::size_t kHeadSize = BLADEFIT_MEMORY_ALIGNMENT;
static_assert(sizeof(bladefit_handle) <= kHeadSize);

bladefit_status to_abi(Status status) { return static_cast<bladefit_status>(status); }

bladefit_status check_pointer(const void* pointer, std::size_t alignment) {
  if (pointer == nullptr) return BLADEFIT_NULL_ARGUMENT;
  return reinterpret_cast<std::uintptr_t>(pointer) % alignment == 0 ? BLADEFIT_OK : BLADEFIT_MISALIGNED;
}

template <typename Struct>
bladefit_status check_struct(const Struct* pointer) {
  if (const bladefit_status status = check_pointer(pointer, alignof(Struct)); status != BLADEFIT_OK) return status;
  return pointer->struct_size == sizeof(Struct) ? BLADEFIT_OK : BLADEFIT_BAD_SIZE;
}

bladefit_status check_handle(const bladefit_handle* handle) {
  const bladefit_status status = check_pointer(handle, BLADEFIT_MEMORY_ALIGNMENT);
  if (status != BLADEFIT_OK) return status;
  return handle->mark == mark_of(handle) ? BLADEFIT_OK : BLADEFIT_BAD_HANDLE;
}

template <typename Struct>
bladefit_status check_call(const bladefit_handle* handle, const Struct* structure) {
  const bladefit_status status = check_handle(handle);
  return status != BLADEFIT_OK ? status : check_struct(structure);
}

std::span<const std::byte> bytes_of(const void* design, std::size_t design_size) {
  return {static_cast<const std::byte*>(design), design_size};
}

/// Checks the configuration by itself.
bladefit_status prepare(const bladefit_config* config, LocalizerConfig& translated) {
  const bladefit_status status = check_struct(config);
  return status != BLADEFIT_OK ? status : bladefit::translate_config(*config, translated);
}

/// What one push does behind the check of the handle.
bladefit_status push_one(Localizer& localizer, const bladefit_point* point, bladefit_verdict* verdict) {
  if (const bladefit_status status = check_struct(point); status != BLADEFIT_OK) return status;
  if (const bladefit_status status = check_struct(verdict); status != BLADEFIT_OK) return status;
  bladefit::ProbePoint translated;
  if (const bladefit_status status = bladefit::translate_point(*point, translated); status != BLADEFIT_OK) {
    return status;
  }
  Verdict result;
  const Status status = localizer.push(translated, result);
  if (succeeded(status) && status != Status::duplicate) *verdict = bladefit::translate_verdict(result);
  return to_abi(status);
}

}  // namespace

uint32_t bladefit_abi_version(void) { return BLADEFIT_ABI_VERSION; }

const char* bladefit_status_text(bladefit_status status) {
  switch (status) {
    case BLADEFIT_BAD_SIZE:
      return "struct_size is not that of this version of the struct";
    case BLADEFIT_POINTS_REFUSED:
      return "some points of the batch were not taken";
    case BLADEFIT_TOO_LATE:
      return "there are points already; set zones before the first one, or after bladefit_reset";
    case BLADEFIT_BAD_HANDLE:
      return "the handle does not come from a successful bladefit_init";
    default:
      return bladefit::status_text(static_cast<Status>(status));
  }
}

bladefit_status bladefit_design_check(const void* design, size_t design_size) {
  DesignImage image;
  return to_abi(DesignImage::open(bytes_of(design, design_size), image));
}

size_t bladefit_memory_required(const bladefit_config* config, const void* design, size_t design_size) {
  LocalizerConfig translated;
  const bladefit::ImageHeader* header = nullptr;
  if (prepare(config, translated) != BLADEFIT_OK) return 0;
  if (DesignImage::open_head(bytes_of(design, design_size), header) != Status::ok) return 0;
  if (bladefit::check_config(translated, header->patch_count)) return 0;
  return kHeadSize + Localizer::memory_required(translated);
}

bladefit_status bladefit_init(void* memory, size_t memory_size, const void* design, size_t design_size,
                              const bladefit_config* config, bladefit_handle** handle) {
  if (const bladefit_status status = check_pointer(memory, BLADEFIT_MEMORY_ALIGNMENT); status != BLADEFIT_OK) {
    return status;
  }
  if (const bladefit_status status = check_pointer(handle, alignof(bladefit_handle*)); status != BLADEFIT_OK) {
    return status;
  }
  LocalizerConfig translated;
  DesignImage image;
  if (const bladefit_status status = prepare(config, translated); status != BLADEFIT_OK) return status;
  const std::span bytes = bytes_of(design, design_size);
  if (const Status status = DesignImage::open(bytes, image); status != Status::ok) return to_abi(status);
  if (const auto fault = bladefit::check_config(translated, image.patches().size())) return to_abi(fault.status);
  if (memory_size < kHeadSize + Localizer::memory_required(translated)) return BLADEFIT_NOT_ENOUGH_MEMORY;
  const std::span block(static_cast<std::byte*>(memory), memory_size);
  Localizer* localizer = nullptr;
  const Status status = Localizer::create(block.subspan(kHeadSize), image, translated, localizer);
  if (status != Status::ok) return to_abi(status);
  *handle = new (memory) bladefit_handle{mark_of(memory), localizer};
  return BLADEFIT_OK;
}

bladefit_status bladefit_set_zones(bladefit_handle* handle, const bladefit_zone* zones, uint32_t count,
                                   const bladefit_axis* axis) {
  if (const bladefit_status status = check_handle(handle); status != BLADEFIT_OK) return status;
  if (const bladefit_status status = check_pointer(zones, alignof(bladefit_zone)); status != BLADEFIT_OK) return status;
  if (axis != nullptr) {
    if (const bladefit_status status = check_struct(axis); status != BLADEFIT_OK) return status;
  }
  Localizer& localizer = *handle->localizer;
  LocalizerConfig wanted = localizer.config();
  const bladefit_status status = bladefit::translate_zones({zones, count}, axis, wanted.tolerance);
  if (status != BLADEFIT_OK) return status;
  if (const auto fault = bladefit::check_config(wanted, localizer.patches())) return to_abi(fault.status);
  if (localizer.set_tolerance(wanted.tolerance) != Status::ok) return BLADEFIT_TOO_LATE;
  return BLADEFIT_OK;
}

bladefit_status bladefit_zone_of(const bladefit_handle* handle, uint32_t sequence, uint32_t* zone) {
  if (const bladefit_status status = check_handle(handle); status != BLADEFIT_OK) return status;
  if (const bladefit_status status = check_pointer(zone, alignof(uint32_t)); status != BLADEFIT_OK) return status;
  Verdict verdict;
  const Status status = handle->localizer->verdict_of(sequence, verdict);
  if (succeeded(status)) *zone = verdict.zone;
  return to_abi(status);
}

bladefit_status bladefit_push(bladefit_handle* handle, const bladefit_point* point, bladefit_verdict* verdict) {
  const bladefit_status status = check_handle(handle);
  return status != BLADEFIT_OK ? status : push_one(*handle->localizer, point, verdict);
}

bladefit_status bladefit_push_many(bladefit_handle* handle, const bladefit_point* points, size_t count,
                                   bladefit_verdict* verdicts, bladefit_status* statuses) {
  if (const bladefit_status status = check_handle(handle); status != BLADEFIT_OK) return status;
  for (const bladefit_status status :
       {check_pointer(points, alignof(bladefit_point)), check_pointer(verdicts, alignof(bladefit_verdict)),
        check_pointer(statuses, alignof(bladefit_status))}) {
    if (status != BLADEFIT_OK) return status;
  }
  bladefit_status outcome = BLADEFIT_OK;
  for (std::size_t k = 0; k < count; ++k) {
    statuses[k] = push_one(*handle->localizer, points + k, verdicts + k);
    if (statuses[k] < 0) outcome = BLADEFIT_POINTS_REFUSED;
  }
  return outcome;
}

bladefit_status bladefit_next_revision(bladefit_handle* handle, bladefit_verdict* verdict) {
  if (const bladefit_status status = check_call(handle, verdict); status != BLADEFIT_OK) return status;
  Verdict revised;
  if (!handle->localizer->next_revision(revised)) return BLADEFIT_NOT_FOUND;
  *verdict = bladefit::translate_verdict(revised);
  return BLADEFIT_OK;
}

bladefit_status bladefit_refine(bladefit_handle* handle, uint32_t max_points) {
  const bladefit_status status = check_handle(handle);
  return status != BLADEFIT_OK ? status : to_abi(handle->localizer->refine(max_points));
}

bladefit_status bladefit_conclude(bladefit_handle* handle) {
  const bladefit_status status = check_handle(handle);
  if (status == BLADEFIT_OK) handle->localizer->conclude();
  return status;
}

bladefit_status bladefit_fit(const bladefit_handle* handle, bladefit_fit_report* report) {
  if (const bladefit_status status = check_call(handle, report); status != BLADEFIT_OK) return status;
  *report = bladefit::translate_report(handle->localizer->fit());
  return BLADEFIT_OK;
}

bladefit_status bladefit_verdict_of(const bladefit_handle* handle, uint32_t sequence, bladefit_verdict* verdict) {
  if (const bladefit_status status = check_call(handle, verdict); status != BLADEFIT_OK) return status;
  Verdict found;
  if (const Status status = handle->localizer->verdict_of(sequence, found); status != Status::ok) {
    return to_abi(status);
  }
  *verdict = bladefit::translate_verdict(found);
  return BLADEFIT_OK;
}

bladefit_status bladefit_reset(bladefit_handle* handle) {
  const bladefit_status status = check_handle(handle);
  if (status == BLADEFIT_OK) handle->localizer->reset();
  return status;
}

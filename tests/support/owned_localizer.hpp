#pragma once
#include <cstddef>
#include <new>
#include <span>
#include <stdexcept>

#include "core/localizer.hpp"

namespace bladefit::testing {

/// A block of memory that begins at a multiple of 64.
class AlignedBlock {
 public:
  explicit AlignedBlock(std::size_t size)
      : size_(size), data_(static_cast<std::byte*>(::operator new(size, std::align_val_t(64)))) {}
  ~AlignedBlock() { ::operator delete(data_, std::align_val_t(64)); }
  AlignedBlock(const AlignedBlock&) = delete;
  AlignedBlock& operator=(const AlignedBlock&) = delete;
  [[nodiscard]] std::span<std::byte> bytes() const { return {data_, size_}; }

 private:
  std::size_t size_;
  std::byte* data_;
};

/// A localizer in memory of its own.
class OwnedLocalizer {
 public:
  OwnedLocalizer(const DesignImage& design, const LocalizerConfig& config)
      : memory_(Localizer::memory_required(config)) {
    const Status status = Localizer::create(memory_.bytes(), design, config, localizer_);
    if (status != Status::ok) throw std::runtime_error(status_text(status));
  }
  Localizer* operator->() const { return localizer_; }
  Localizer& operator*() const { return *localizer_; }

 private:
  AlignedBlock memory_;
  Localizer* localizer_ = nullptr;
};

/// refine() to its end.
inline Status refine_fully(Localizer& localizer) {
  Status status = Status::more_work;
  while (status == Status::more_work) status = localizer.refine(100000);
  return status;
}

}  // namespace bladefit::testing

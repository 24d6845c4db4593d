#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <new>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/surface/design_image.hpp"
#include "core/geometry/surface/surface.hpp"
#include "core/localizer.hpp"
#include "drivers/replay/points_csv.hpp"
#include "tests/support/reference_case.hpp"
#include "tools/design/image/image_writer.hpp"
#include "tools/design/load_design.hpp"

namespace bladefit::testing {

/// A design image with the memory it stands in.
class CompiledDesign {
 public:
  explicit CompiledDesign(std::vector<std::byte> bytes)
      : bytes_(std::move(bytes)), image_(opened(bytes_)), surface_(image_) {}
  CompiledDesign(const CompiledDesign&) = delete;
  CompiledDesign& operator=(const CompiledDesign&) = delete;

  [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }
  [[nodiscard]] const DesignImage& image() const { return image_; }
  [[nodiscard]] const Surface& surface() const { return surface_; }
  [[nodiscard]] double size() const { return surface_.half_diagonal(); }

 private:
  static DesignImage opened(const std::vector<std::byte>& bytes) {
    DesignImage image;
    const Status status = DesignImage::open(bytes, image);
    if (status != Status::ok) throw std::runtime_error(status_text(status));
    return image;
  }

  std::vector<std::byte> bytes_;
  DesignImage image_;
  Surface surface_;
};

/// The design of a case of tests/data; compiled once.
inline const CompiledDesign& reference_design(const std::string& name) {
  static std::map<std::string, std::unique_ptr<CompiledDesign>> designs;
  std::unique_ptr<CompiledDesign>& design = designs[name];
  if (!design) {
    const ReferenceCase c = read_case(name);
    design = std::make_unique<CompiledDesign>(load_design(c.folder / "design.igs", outward_of(c)).image);
  }
  return *design;
}

/// The measured points of a subset [mm]; without approach vectors where the case does not use them.
inline std::vector<ProbePoint> points_of(const ReferenceCase& c, const ReferenceSubset& subset) {
  PointsFile file = read_points_csv(subset.points, c.mm_per_unit);
  if (file.error) throw std::runtime_error(file.error.message);
  return file.points;
}

inline std::vector<ProbePoint> points_of(const ReferenceCase& c, const std::string& subset) {
  for (const ReferenceSubset& s : c.subsets) {
    if (s.name == subset) return points_of(c, s);
  }
  throw std::runtime_error("no subset " + subset);
}

/// Every `stride`-th measured point of a case, from `first` on.
inline std::vector<ProbePoint> thinned(const ReferenceCase& c, std::size_t first, std::size_t stride) {
  const std::vector<ProbePoint> all = read_points_csv(c.folder / "points.csv", c.mm_per_unit).points;
  std::vector<ProbePoint> points;
  for (std::size_t i = first; i < all.size(); i += stride) points.push_back(all[i]);
  return points;
}

/// What case.json asks of a fit, with room for `capacity` points.
inline LocalizerConfig config_of(const ReferenceCase& c, std::size_t capacity) {
  LocalizerConfig config;
  config.capacity = static_cast<std::uint32_t>(capacity);
  config.probe_radius_mm = c.probe_radius * c.mm_per_unit;
  config.use_approach = c.use_approach;
  for (const ReferenceCase::Box& box : c.leading_edge) {
    config.tolerance.boxes[config.tolerance.box_count++] = {box.patch, box.u[0], box.u[1], box.v[0], box.v[1]};
  }
  return config;
}

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

inline double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline Vec3 random_vector(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return {x, y, z};
}

inline Vec3 random_direction_in_space(std::mt19937_64& random) { return random_vector(random).normalized(); }

/// A place anywhere on the design, in the interior of a span.
inline SurfacePlace random_place(const Surface& surface, std::mt19937_64& random) {
  const auto spans = static_cast<std::uint32_t>(surface.image().spans().size());
  const std::uint32_t span = std::uniform_int_distribution<std::uint32_t>(0, spans - 1)(random);
  const SpanDomain d = surface.domain(span);
  const double u = uniform(random, d.u_min, d.u_max);
  return {span, u, uniform(random, d.v_min, d.v_max)};
}

}  // namespace bladefit::testing

#include "tests/support/reference_design.hpp"

#include <map>
#include <memory>
#include <span>
#include <stdexcept>

#include "drivers/replay/points_csv.hpp"
#include "tests/support/scratch_folder.hpp"

namespace bladefit::testing {
namespace {

std::vector<std::byte> image_on_file(const std::string& name) {
  const std::string text = read_whole(BLADEFIT_REFERENCE_DESIGNS + name + ".bfd");
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

}  // namespace

const CompiledDesign& reference_design(const std::string& name) {
  static std::map<std::string, std::unique_ptr<CompiledDesign>> designs;
  std::unique_ptr<CompiledDesign>& design = designs[name];
  if (!design) design = std::make_unique<CompiledDesign>(image_on_file(name));
  return *design;
}

std::vector<ProbePoint> points_of(const ReferenceCase& c, const ReferenceSubset& subset) {
  PointsFile file = read_points_csv(subset.points, {c.unit == "in" ? Unit::inch : Unit::mm, {}, {}, {}});
  if (file.error) throw std::runtime_error(file.error.message);
  return file.points;
}

std::vector<ProbePoint> points_of(const ReferenceCase& c, const std::string& subset) {
  for (const ReferenceSubset& s : c.subsets) {
    if (s.name == subset) return points_of(c, s);
  }
  throw std::runtime_error("no subset " + subset);
}

std::vector<ProbePoint> thinned(const ReferenceCase& c, std::size_t first, std::size_t stride) {
  const std::vector<ProbePoint> all =
      read_points_csv(c.folder / "points.csv", {c.unit == "in" ? Unit::inch : Unit::mm, {}, {}, {}}).points;
  std::vector<ProbePoint> points;
  for (std::size_t i = first; i < all.size(); i += stride) points.push_back(all[i]);
  return points;
}

LocalizerConfig config_of(const ReferenceCase& c, std::size_t capacity) {
  LocalizerConfig config;
  config.capacity = static_cast<std::uint32_t>(capacity);
  config.probe_radius_mm = c.probe_radius * c.mm_per_unit;
  config.use_approach = c.use_approach;
  for (const ReferenceCase::Box& box : c.leading_edge) {
    config.tolerance.boxes[config.tolerance.box_count++] = {box.patch, box.u[0], box.u[1], box.v[0], box.v[1]};
  }
  return config;
}

}  // namespace bladefit::testing

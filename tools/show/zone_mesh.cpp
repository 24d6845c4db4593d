#include "tools/show/zone_mesh.hpp"

#include <algorithm>

#include "core/geometry/surface/trim.hpp"

namespace bladefit {
namespace {

/// The lines of a grid with the limits of boxes among them.
std::vector<double> with_limits(std::vector<double> lines, const std::vector<double>& limits) {
  lines.insert(lines.end(), limits.begin(), limits.end());
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

/// Cells from `first` to before `end` of a row, all of one zone.
struct ZoneRun {
  std::uint32_t zone = 0;
  std::size_t first = 0, end = 0;
  friend bool operator==(const ZoneRun&, const ZoneRun&) = default;
};

class ZoneCells {
 public:
  ZoneCells(const Surface& surface, const FaceMesh& face, const ToleranceMap& map)
      : surface_(surface), map_(map), patch_(face.patch) {
    std::vector<double> us, vs;
    for (std::uint32_t k = 0; k < map.box_count; ++k) {
      const ParameterBox& box = map.boxes.at(k);
      if (box.patch != patch_) continue;
      us.insert(us.end(), {box.u_min, box.u_max});
      vs.insert(vs.end(), {box.v_min, box.v_max});
    }
    us_ = with_limits(face.us, us);
    vs_ = with_limits(face.vs, vs);
  }

  /// Rows with the same runs are one strip.
  [[nodiscard]] std::vector<FaceMesh> meshes() const {
    std::vector<FaceMesh> out;
    std::vector<ZoneRun> open;
    std::size_t begun = 0;
    for (std::size_t i = 0; i + 1 <= us_.size(); ++i) {
      const std::vector<ZoneRun> runs = i + 1 < us_.size() ? runs_of(i) : std::vector<ZoneRun>();
      if (runs == open) continue;
      for (const ZoneRun& run : open) out.push_back(strip(begun, i, run));
      open = runs;
      begun = i;
    }
    return out;
  }

 private:
  [[nodiscard]] std::uint32_t zone_of_cell(std::size_t i, std::size_t j) const {
    const double u = 0.5 * (us_[i] + us_[i + 1]), v = 0.5 * (vs_[j] + vs_[j + 1]);
    const SurfacePlace place = surface_.place_at(patch_, u, v);
    if (!inside_face(surface_.image(), place)) return 0;
    return part_at(map_, patch_, u, v, surface_.evaluate(place).s).zone;
  }

  [[nodiscard]] std::vector<ZoneRun> runs_of(std::size_t i) const {
    std::vector<ZoneRun> runs;
    for (std::size_t j = 0; j + 1 < vs_.size(); ++j) {
      const std::uint32_t zone = zone_of_cell(i, j);
      if (zone == 0) continue;
      if (!runs.empty() && runs.back().zone == zone && runs.back().end == j) {
        runs.back().end = j + 1;
      } else {
        runs.push_back({zone, j, j + 1});
      }
    }
    return runs;
  }

  [[nodiscard]] FaceMesh strip(std::size_t first, std::size_t last, const ZoneRun& run) const {
    const auto part = [](const std::vector<double>& lines, std::size_t from, std::size_t to) {
      return std::vector<double>(lines.begin() + static_cast<std::ptrdiff_t>(from),
                                 lines.begin() + static_cast<std::ptrdiff_t>(to) + 1);
    };
    FaceMesh mesh = mesh_over(surface_, patch_, part(us_, first, last), part(vs_, run.first, run.end));
    mesh.zone = run.zone;
    return mesh;
  }

  const Surface& surface_;
  const ToleranceMap& map_;
  std::uint32_t patch_;
  std::vector<double> us_, vs_;
};

}  // namespace

std::vector<FaceMesh> mesh_zones(const Surface& surface, const FaceMesh& face, const ToleranceMap& map) {
  return ZoneCells(surface, face, map).meshes();
}

}  // namespace bladefit

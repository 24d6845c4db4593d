#pragma once
#include <vector>

#include "core/geometry/surface/surface.hpp"
#include "core/inspection/tolerance_map.hpp"
#include "tools/drawing/shaft_frame.hpp"
#include "tools/results/blade_drawing.hpp"

namespace bladefit {

/// The design on a grid of its parameters, with the radius at every node, ready to be cut by cylinders. Leading-edge
/// boxes have finer grids of their own. Views the surface, which must outlive it.
class RadiusGrid {
 public:
  /// Cost: some 100,000 evaluations of the surface for its patches, and again for its boxes.
  RadiusGrid(const Surface& surface, const ShaftFrame& frame, const std::vector<ParameterBox>& boxes);

  [[nodiscard]] double least_radius() const { return least_; }
  [[nodiscard]] double greatest_radius() const { return greatest_; }

  /// The pieces of the section at a radius, in no order; ends lie on the cylinder to 1e-6 of the grid's step. Those
  /// within a leading-edge box come from its own grid. Cost: linear in the nodes.
  [[nodiscard]] std::vector<SectionPiece> cut(double radius) const;

 private:
  /// (steps + 1)^2 nodes over a box; a radius that is NaN is outside of the trimmed face.
  struct Patch {
    ParameterBox box;
    std::size_t steps = 0;
    bool leading_edge = false;
    std::vector<double> radius;
    std::vector<ParameterBox> holes;  ///< which grids of their own cover

    [[nodiscard]] double u(double i) const {
      return box.u_min + (box.u_max - box.u_min) * i / static_cast<double>(steps);
    }
    [[nodiscard]] double v(double j) const {
      return box.v_min + (box.v_max - box.v_min) * j / static_cast<double>(steps);
    }
    [[nodiscard]] double at(std::size_t i, std::size_t j) const { return radius[i * (steps + 1) + j]; }
  };
  /// A node, and one beside it.
  struct Edge {
    std::size_t i, j, i2, j2;
  };

  void add(const ParameterBox& box, std::size_t steps, bool leading_edge, std::vector<ParameterBox> holes);
  void cut_cell(const Patch& patch, std::size_t i, std::size_t j, double radius, std::vector<SectionPiece>& out) const;
  [[nodiscard]] UnrolledPlace crossing(const Patch& patch, const Edge& edge, double radius) const;

  const Surface& surface_;
  const ShaftFrame& frame_;
  std::vector<Patch> patches_;
  double least_ = 0, greatest_ = 0;
};

}  // namespace bladefit

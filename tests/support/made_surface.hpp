#pragma once
#include <cstdint>
#include <random>
#include <vector>

#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit::testing {

/// How a random direction is made.
struct DirectionPlan {
  int degree = 3;
  int spans = 4;
  bool clamped = true;
  bool sub_range = false;
  bool multiple_knots = false;
};

/// Knots that do not begin at 0, uneven, with inner multiplicities up to the degree where asked for.
inline SurfaceDirection random_direction(const DirectionPlan& plan, std::mt19937& random) {
  std::uniform_real_distribution<double> gap(0.05, 1.0);
  std::vector<double> knots;
  double knot = -3.7;
  const auto place = [&](int multiplicity) {
    knots.insert(knots.end(), static_cast<std::size_t>(multiplicity), knot);
    knot += gap(random);
  };
  if (!plan.clamped) {
    for (int k = 0; k < plan.degree; ++k) place(1);
  }
  place(plan.clamped ? plan.degree + 1 : 1);
  for (int k = 1; k < plan.spans; ++k) {
    place(plan.multiple_knots ? std::uniform_int_distribution<int>(1, plan.degree)(random) : 1);
  }
  place(plan.clamped ? plan.degree + 1 : 1);
  if (!plan.clamped) {
    for (int k = 0; k < plan.degree; ++k) place(1);
  }
  SurfaceDirection direction;
  direction.degree = plan.degree;
  direction.control_points = static_cast<int>(knots.size()) - plan.degree - 1;
  direction.knots = knots;
  direction.start = knots[static_cast<std::size_t>(plan.degree)];
  direction.end = knots[static_cast<std::size_t>(direction.control_points)];
  if (plan.sub_range) {
    const double length = direction.end - direction.start;
    direction.end = direction.start + 0.83 * length;
    direction.start += 0.21 * length;
  }
  return direction;
}

/// A wavy sheet of about 100 mm over uneven knots, with weights from 0.5 to 2 where `rational`.
inline NurbsSurface random_surface(const DirectionPlan& plan_u, const DirectionPlan& plan_v, bool rational,
                                   std::uint32_t seed) {
  std::mt19937 random(seed);
  NurbsSurface surface;
  surface.name = "made up";
  surface.u = random_direction(plan_u, random);
  surface.v = random_direction(plan_v, random);
  std::uniform_real_distribution<double> height(-10, 10);
  std::uniform_real_distribution<double> weight(0.5, 2.0);
  for (int i = 0; i < surface.u.control_points; ++i) {
    for (int j = 0; j < surface.v.control_points; ++j) {
      surface.control_points.emplace_back(100.0 * i / surface.u.control_points + height(random) / 20,
                                          80.0 * j / surface.v.control_points + height(random) / 20, height(random));
      surface.weights.push_back(rational ? weight(random) : 1.0);
    }
  }
  return surface;
}

/// The basis functions of `direction` that are not zero at knot parameter `t`, and the first control point of them
/// (The NURBS Book, algorithm A2.2). Independent of the blossoming that the product uses.
struct Basis {
  std::size_t first;
  std::vector<long double> values;
};
inline Basis basis_functions(const SurfaceDirection& direction, long double t) {
  const auto p = static_cast<std::size_t>(direction.degree);
  std::size_t span = p;
  while (span + 1 < static_cast<std::size_t>(direction.control_points) && direction.knots[span + 1] <= t) ++span;
  std::vector<long double> values(p + 1, 0);
  values[0] = 1;
  for (std::size_t j = 1; j <= p; ++j) {
    long double saved = 0;
    for (std::size_t r = 0; r < j; ++r) {
      const long double right = direction.knots[span + r + 1];
      const long double left = direction.knots[span + 1 + r - j];
      const long double part = values[r] / (right - left);
      values[r] = saved + (right - t) * part;
      saved = (t - left) * part;
    }
    values[j] = saved;
  }
  return {span - p, values};
}

/// The surface at parameters normalised to 0..1 [mm].
inline Eigen::Vector3d evaluate_surface(const NurbsSurface& surface, double u, double v) {
  const auto parameter = [](const SurfaceDirection& direction, double t) {
    return direction.start + t * (static_cast<long double>(direction.end) - direction.start);
  };
  const Basis basis_u = basis_functions(surface.u, parameter(surface.u, u));
  const Basis basis_v = basis_functions(surface.v, parameter(surface.v, v));
  Eigen::Matrix<long double, 3, 1> sum = Eigen::Matrix<long double, 3, 1>::Zero();
  long double weight = 0;
  for (std::size_t i = 0; i < basis_u.values.size(); ++i) {
    for (std::size_t j = 0; j < basis_v.values.size(); ++j) {
      const std::size_t k =
          (basis_u.first + i) * static_cast<std::size_t>(surface.v.control_points) + basis_v.first + j;
      const long double part = basis_u.values[i] * basis_v.values[j] * surface.weights[k];
      sum += part * surface.control_points[k].cast<long double>();
      weight += part;
    }
  }
  return (sum / weight).cast<double>();
}

}  // namespace bladefit::testing

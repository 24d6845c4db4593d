#include "tools/design/blades/face_groups.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace bladefit {
namespace {

/// Part along the direction of rotation that the normals of a surface of revolution may have.
constexpr double kTurning = 0.01;
/// Cosine of axis and +y above which angles count from +z.
constexpr double kAlongY = 0.9;

/// A turn about the axis moves the face in itself.
bool of_revolution(const std::vector<FaceSample>& samples, const ShaftAxis& axis) {
  return std::ranges::all_of(samples, [&axis](const FaceSample& sample) {
    const Eigen::Vector3d turning = axis.direction.cross(sample.point - axis.point);
    return std::abs(sample.normal.dot(turning)) <= kTurning * turning.norm();
  });
}

double mean_radius(const std::vector<FaceSample>& samples, const ShaftAxis& axis) {
  double area = 0, sum = 0;
  for (const FaceSample& sample : samples) {
    area += sample.area;
    sum += sample.area * axis.radius_of(sample.point);
  }
  return sum / std::max(area, std::numeric_limits<double>::min());
}

/// Gives faces that lie beside each other the number of the first of them; `left_out` ones keep their own.
std::vector<std::size_t> numbers_of_groups(std::size_t faces, const std::vector<Neighbours>& neighbours,
                                           const std::vector<bool>& left_out) {
  std::vector<std::size_t> number(faces);
  std::iota(number.begin(), number.end(), std::size_t{0});
  for (const Neighbours& pair : neighbours) {
    if (left_out[pair.surface] || left_out[pair.other]) continue;
    const auto [low, high] = std::minmax(number[pair.surface], number[pair.other]);
    std::ranges::replace(number, std::size_t{high}, std::size_t{low});
  }
  return number;
}

/// Gives faces of revolution at the end of one group the number of it.
void take_tips(const std::vector<std::vector<FaceSample>>& samples, const std::vector<Neighbours>& neighbours,
               const ShaftAxis& axis, std::vector<bool>& hub, std::vector<std::size_t>& number) {
  const std::vector<bool> revolved = hub;
  for (std::size_t face = 0; face < hub.size(); ++face) {
    if (!revolved[face]) continue;
    std::set<std::size_t> beside;
    double inner = std::numeric_limits<double>::infinity();
    for (const Neighbours& pair : neighbours) {
      if (pair.surface != face && pair.other != face) continue;
      const std::size_t other = pair.surface == face ? pair.other : pair.surface;
      beside.insert(revolved[other] ? face : number[other]);
      inner = std::min(inner, mean_radius(samples[other], axis));
    }
    if (beside.size() != 1 || *beside.begin() == face || mean_radius(samples[face], axis) <= inner) continue;
    hub[face] = false;
    number[face] = *beside.begin();
  }
}

FaceGroup group_of(std::vector<std::size_t> faces, const std::vector<std::vector<FaceSample>>& samples,
                   const ShaftAxis& axis) {
  FaceGroup group;
  group.least_radius = std::numeric_limits<double>::infinity();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  const auto each = [&](auto use) {
    for (const std::size_t face : faces) std::ranges::for_each(samples[face], use);
  };
  each([&](const FaceSample& sample) {
    group.area += sample.area;
    centre += sample.area * (sample.point - axis.point);
    group.least_radius = std::min(group.least_radius, axis.radius_of(sample.point));
  });
  centre /= std::max(group.area, std::numeric_limits<double>::min());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  each([&](const FaceSample& sample) {
    const Eigen::Vector3d arm = sample.point - axis.point - centre;
    spread += sample.area / std::max(group.area, std::numeric_limits<double>::min()) * arm * arm.transpose();
  });
  const Eigen::Vector3d from = across(axis), towards = axis.direction.cross(from);
  group.height = axis.direction.dot(centre);
  group.radius = (centre - group.height * axis.direction).norm();
  group.angle = std::atan2(towards.dot(centre), from.dot(centre));
  const Eigen::Vector3d out = std::cos(group.angle) * from + std::sin(group.angle) * towards;
  Eigen::Matrix3d frame;
  frame << out, axis.direction.cross(out), axis.direction;
  group.spread = frame.transpose() * spread * frame;
  group.faces = std::move(faces);
  return group;
}

}  // namespace

Eigen::Vector3d across(const ShaftAxis& axis) {
  const Eigen::Vector3d wanted =
      std::abs(axis.direction.y()) > kAlongY ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
  return (wanted - wanted.dot(axis.direction) * axis.direction).normalized();
}

FaceGroups group_faces(const std::vector<std::vector<FaceSample>>& samples, const std::vector<Neighbours>& neighbours,
                       const ShaftAxis& axis) {
  std::vector<bool> hub;
  hub.reserve(samples.size());
  for (const auto& face : samples) hub.push_back(of_revolution(face, axis));
  std::vector<std::size_t> number = numbers_of_groups(samples.size(), neighbours, hub);
  take_tips(samples, neighbours, axis, hub, number);
  FaceGroups result;
  for (std::size_t first = 0; first < samples.size(); ++first) {
    std::vector<std::size_t> faces;
    for (std::size_t face = 0; face < samples.size(); ++face) {
      if (!hub[face] && number[face] == first) faces.push_back(face);
    }
    if (!faces.empty()) result.groups.push_back(group_of(std::move(faces), samples, axis));
    if (!hub[first]) continue;
    result.hub.push_back(first);
    for (const FaceSample& sample : samples[first]) result.hub_area += sample.area;
  }
  return result;
}

}  // namespace bladefit

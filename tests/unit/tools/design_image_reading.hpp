#pragma once
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <vector>

#include "core/geometry/surface/span_net.hpp"

namespace bladefit::testing {

/// A point of a span with its derivatives, by de Casteljau on the homogeneous net; parameters 0..1 of the span.
struct SpanPoint {
  Eigen::Vector3d point, along_u, along_v;
};

inline SpanPoint evaluate_span(const DesignImage& image, const ImageSpan& span, double s, double t) {
  const ImagePatch& patch = image.patches()[span.patch];
  BezierNet net;
  bezier_net(image, span, net);
  using Homogeneous = Eigen::Matrix<long double, 4, 1>;
  struct Jet {
    Homogeneous value, slope;
  };
  const auto reduce = [](std::vector<Homogeneous> points, long double parameter) {
    Homogeneous slope = Homogeneous::Zero();
    for (std::size_t last = points.size() - 1; last > 0; --last) {
      if (last == 1) slope = static_cast<long double>(points.size() - 1) * (points[1] - points[0]);
      for (std::size_t k = 0; k < last; ++k) points[k] = (1 - parameter) * points[k] + parameter * points[k + 1];
    }
    return Jet{points[0], slope};
  };
  std::vector<Homogeneous> values;
  std::vector<Homogeneous> slopes_v;
  for (std::uint32_t i = 0; i <= patch.degree_u; ++i) {
    std::vector<Homogeneous> row;
    for (std::uint32_t j = 0; j <= patch.degree_v; ++j) {
      row.push_back(net.at(i, j).matrix().cast<long double>());
    }
    const Jet jet = reduce(row, t);
    values.push_back(jet.value);
    slopes_v.push_back(jet.slope);
  }
  const Jet jet = reduce(values, s);
  const Homogeneous slope_v = reduce(slopes_v, s).value;
  const Eigen::Matrix<long double, 3, 1> point = jet.value.head<3>() / jet.value[3];
  const auto quotient = [&](const Homogeneous& slope) {
    return Eigen::Vector3d(((slope.head<3>() - slope[3] * point) / jet.value[3]).cast<double>());
  };
  return {point.cast<double>(), quotient(jet.slope), quotient(slope_v)};
}

inline DesignImage open_image(const std::vector<std::byte>& bytes) {
  DesignImage image;
  EXPECT_EQ(DesignImage::open(bytes, image), Status::ok);
  return image;
}

/// Half the diagonal of the design's box [mm].
inline double image_size(const DesignImage& image) {
  return (Eigen::Vector3d(image.header().box_max) - Eigen::Vector3d(image.header().box_min)).norm() / 2;
}

/// Every normal on a dense grid of every span must lie in the span's cone. Returns the number of spans without bound.
inline int check_cones(const DesignImage& image, int grid) {
  int unknown = 0;
  for (const ImageSpan& span : image.spans()) {
    if (span.cone_cosine == -1) {
      ++unknown;
      continue;
    }
    for (int i = 0; i <= grid; ++i) {
      for (int j = 0; j <= grid; ++j) {
        const SpanPoint point = evaluate_span(image, span, double(i) / grid, double(j) / grid);
        const int side = image.patches()[span.patch].reversed != 0 ? -image.header().outward : image.header().outward;
        const Eigen::Vector3d normal = point.along_u.cross(point.along_v).normalized() * side;
        EXPECT_GE(normal.dot(Eigen::Vector3d(span.cone_axis)), span.cone_cosine)
            << "patch " << span.patch << " span " << span.iu << ", " << span.iv << " at " << i << ", " << j;
      }
    }
  }
  return unknown;
}

}  // namespace bladefit::testing

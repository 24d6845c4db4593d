#include "tools/design/image_writer.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "tools/design/bezier_extraction.hpp"
#include "tools/design/bounding_tree.hpp"
#include "tools/design/creases.hpp"
#include "tools/design/design_error.hpp"
#include "tools/design/leaf_subdivision.hpp"
#include "tools/design/normal_cone.hpp"
#include "tools/design/seams.hpp"

namespace bladefit {
namespace {

/// The arrays of an image while it is being put together.
struct ImageParts {
  std::vector<ImagePatch> patches;
  std::vector<ImageSpan> spans;
  std::vector<ImageNode> nodes;
  std::vector<double> breaks;
  std::vector<double> coefficients, taylor;
  std::vector<ImageLeaf> leaves;
  std::vector<Box> boxes;  ///< one a leaf
};

/// A leaf is to tell of points this near to the surface [half diagonals of the control points' box].
constexpr double kNear = 5e-3;
/// Boxes are wider than their control points by this share of their coordinates, so that whoever checks the image may
/// round otherwise.
constexpr double kBoxMargin = 1e-13;

Box control_box(const BezierNet& net) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::uint32_t k = 0; k < (net.degree_u + 1) * (net.degree_v + 1); ++k) {
      const double coordinate = net.points[k][axis] / net.points[k][3];
      low = std::min(low, coordinate);
      high = std::max(high, coordinate);
    }
    const double margin = kBoxMargin * std::max(std::abs(low), std::abs(high));
    box.min[axis] = low - margin;
    box.max[axis] = high + margin;
  }
  return box;
}

/// Half the diagonal of the box of all control points [mm].
double half_diagonal(const std::vector<NurbsSurface>& surfaces) {
  Eigen::AlignedBox3d box;
  for (const NurbsSurface& surface : surfaces) {
    for (const Eigen::Vector3d& point : surface.control_points) box.extend(point);
  }
  return 0.5 * box.diagonal().norm();
}

std::uint32_t append_breaks(const std::vector<double>& breaks, ImageParts& parts) {
  const auto first = static_cast<std::uint32_t>(parts.breaks.size());
  parts.breaks.insert(parts.breaks.end(), breaks.begin(), breaks.end());
  return first;
}

void append_leaves(std::span<const double> net, const BezierPatch& bezier, double near, ImageParts& parts) {
  for (ImageLeaf& leaf : cut_into_leaves(net, bezier.degree_u, bezier.degree_v, near)) {
    BezierNet restricted;
    restrict_net(net.data(), static_cast<std::uint32_t>(bezier.degree_u), static_cast<std::uint32_t>(bezier.degree_v),
                 {leaf.s_min, leaf.s_max, leaf.t_min, leaf.t_max}, restricted);
    leaf.span = static_cast<std::uint32_t>(parts.spans.size());
    parts.leaves.push_back(leaf);
    parts.boxes.push_back(control_box(restricted));
  }
}

void append_spans(const BezierPatch& bezier, int outward, double near, ImageParts& parts) {
  const auto patch = static_cast<std::uint32_t>(parts.patches.size());
  const std::size_t count = bezier.spans_u() * bezier.spans_v();
  for (std::size_t k = 0; k < count; ++k) {
    const std::span<const double> net{&bezier.coefficients[k * bezier.span_size()], bezier.span_size()};
    const NormalCone cone = normal_cone(net, bezier.degree_u, bezier.degree_v, outward);
    ImageSpan span{};
    span.patch = patch;
    span.iu = static_cast<std::uint32_t>(k / bezier.spans_v());
    span.iv = static_cast<std::uint32_t>(k % bezier.spans_v());
    span.first_coefficient = parts.coefficients.size();
    std::copy(cone.axis.begin(), cone.axis.end(), span.cone_axis);
    span.cone_cosine = cone.cosine;
    span.ends = span_ends(bezier, span.iu, span.iv);
    append_leaves(net, bezier, near, parts);
    parts.spans.push_back(span);
    parts.coefficients.insert(parts.coefficients.end(), net.begin(), net.end());
    const auto taylor = bezier.taylor.begin() + static_cast<std::ptrdiff_t>(k * bezier.span_size());
    parts.taylor.insert(parts.taylor.end(), taylor, taylor + static_cast<std::ptrdiff_t>(bezier.span_size()));
  }
}

void append_patch(const BezierPatch& bezier, int outward, double near, ImageParts& parts) {
  ImagePatch patch{};
  patch.degree_u = static_cast<std::uint32_t>(bezier.degree_u);
  patch.degree_v = static_cast<std::uint32_t>(bezier.degree_v);
  patch.spans_u = static_cast<std::uint32_t>(bezier.spans_u());
  patch.spans_v = static_cast<std::uint32_t>(bezier.spans_v());
  patch.first_span = static_cast<std::uint32_t>(parts.spans.size());
  patch.first_break_u = append_breaks(bezier.breaks_u, parts);
  patch.first_break_v = append_breaks(bezier.breaks_v, parts);
  patch.rational = bezier.rational ? 1 : 0;
  append_spans(bezier, outward, near, parts);
  parts.patches.push_back(patch);
}

ImageHeader make_header(const ImageParts& parts, DesignUnit unit, int outward) {
  ImageHeader header{};
  std::memcpy(header.magic, kImageMagic, sizeof kImageMagic);
  header.version = kImageVersion;
  header.design_unit = static_cast<std::uint32_t>(unit);
  header.outward = outward;
  header.patch_count = static_cast<std::uint32_t>(parts.patches.size());
  header.span_count = static_cast<std::uint32_t>(parts.spans.size());
  header.leaf_count = static_cast<std::uint32_t>(parts.leaves.size());
  header.node_count = static_cast<std::uint32_t>(parts.nodes.size());
  header.break_count = static_cast<std::uint32_t>(parts.breaks.size());
  header.coefficient_count = parts.coefficients.size();
  header.patches_offset = sizeof(ImageHeader);
  header.spans_offset = header.patches_offset + parts.patches.size() * sizeof(ImagePatch);
  header.leaves_offset = header.spans_offset + parts.spans.size() * sizeof(ImageSpan);
  header.nodes_offset = header.leaves_offset + parts.leaves.size() * sizeof(ImageLeaf);
  header.breaks_offset = header.nodes_offset + parts.nodes.size() * sizeof(ImageNode);
  header.coefficients_offset = header.breaks_offset + parts.breaks.size() * sizeof(double);
  header.taylor_offset = header.coefficients_offset + parts.coefficients.size() * sizeof(double);
  header.total_size = header.taylor_offset + parts.taylor.size() * sizeof(double);
  const Box whole = box_around(parts.boxes);
  std::copy_n(whole.min, 3, header.box_min);
  std::copy_n(whole.max, 3, header.box_max);
  return header;
}

template <class Element>
void copy_array(const std::vector<Element>& array, std::uint64_t offset, std::vector<std::byte>& image) {
  std::memcpy(image.data() + offset, array.data(), array.size() * sizeof(Element));
}

void seal(std::vector<std::byte>& image) {
  const std::uint32_t crc = image_crc(image);
  std::memcpy(image.data() + offsetof(ImageHeader, crc32), &crc, sizeof crc);
}

}  // namespace

std::vector<std::byte> write_image(const std::vector<NurbsSurface>& surfaces, DesignUnit unit, int outward) {
  ImageParts parts;
  const double near = kNear * half_diagonal(surfaces);
  for (const NurbsSurface& surface : surfaces) append_patch(extract_bezier(surface), outward, near, parts);
  if (parts.leaves.size() > std::numeric_limits<std::uint32_t>::max() / 4) {
    throw DesignError("the design has too many knot spans; export the blade with fewer knots");
  }
  parts.nodes = build_bounding_tree(parts.boxes);
  for (std::uint32_t k = 0; k < parts.nodes.size(); ++k) {
    for (const std::uint32_t child : parts.nodes[k].child) {
      if (child != kNoChild && (child & kLeafChild) != 0) parts.leaves[child & ~kLeafChild].node = k;
    }
  }
  const ImageHeader header = make_header(parts, unit, outward);
  std::vector<std::byte> image(header.total_size);
  std::memcpy(image.data(), &header, sizeof header);
  copy_array(parts.patches, header.patches_offset, image);
  copy_array(parts.spans, header.spans_offset, image);
  copy_array(parts.leaves, header.leaves_offset, image);
  copy_array(parts.nodes, header.nodes_offset, image);
  copy_array(parts.breaks, header.breaks_offset, image);
  copy_array(parts.coefficients, header.coefficients_offset, image);
  copy_array(parts.taylor, header.taylor_offset, image);
  seal(image);
  mark_seams(image);
  seal(image);
  return image;
}

void set_outward(std::vector<std::byte>& image, int outward) {
  ImageHeader header;
  std::memcpy(&header, image.data(), sizeof header);
  if (header.outward == outward) return;
  header.outward = outward;
  std::memcpy(image.data(), &header, sizeof header);
  for (std::uint64_t k = 0; k < header.span_count; ++k) {
    std::byte* place = image.data() + header.spans_offset + k * sizeof(ImageSpan);
    ImageSpan span;
    std::memcpy(&span, place, sizeof span);
    for (double& component : span.cone_axis) component = -component;
    std::memcpy(place, &span, sizeof span);
  }
  seal(image);
}

}  // namespace bladefit

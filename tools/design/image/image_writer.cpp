#include "tools/design/image/image_writer.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "tools/design/image/creases.hpp"
#include "tools/design/image/joints.hpp"
#include "tools/design/image/span_bounding.hpp"
#include "tools/design/image/tree_builder.hpp"
#include "tools/design/image/trim_pieces.hpp"
#include "tools/design/nurbs/bezier_extraction.hpp"
#include "tools/files/tool_error.hpp"

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
  TrimParts trims;
};

/// A leaf is to tell of points this near to the surface [half diagonals of the control points' box].
constexpr double kNear = 5e-3;

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

void append_leaves(const SpanBounding& bounding, const TrimmedSpan& face, ImageParts& parts) {
  for (std::size_t k = 0; k < bounding.leaves.size(); ++k) {
    ImageLeaf leaf = bounding.leaves[k];
    if (!face.reaches({leaf.s_min, leaf.s_max, leaf.t_min, leaf.t_max})) continue;
    leaf.span = static_cast<std::uint32_t>(parts.spans.size());
    parts.leaves.push_back(leaf);
    parts.boxes.push_back(bounding.boxes[k]);
  }
}

/// Trim loops lie in leaves, whose boxes may be the tighter.
Box common_to(const Box& a, const Box& b) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::max(a.min[axis], b.min[axis]);
    box.max[axis] = std::min(a.max[axis], b.max[axis]);
  }
  return box;
}

/// The edges of a patch with trim loops are no ends.
std::uint32_t creases_only(std::uint32_t ends, const ImageSpan& span, const BezierPatch& bezier) {
  if (span.iu == 0) ends &= ~kEndsAtLowU;
  if (span.iu + 1 == bezier.spans_u()) ends &= ~kEndsAtHighU;
  if (span.iv == 0) ends &= ~kEndsAtLowV;
  if (span.iv + 1 == bezier.spans_v()) ends &= ~kEndsAtHighV;
  return ends;
}

void append_spans(const BezierPatch& bezier, const std::vector<TrimLoop>& loops, int outward, double near,
                  ImageSize size, ImageParts& parts) {
  const auto patch = static_cast<std::uint32_t>(parts.patches.size());
  const std::size_t first = parts.coefficients.size();
  std::size_t k = 0;
  for (const SpanBounding& bounding : bound_spans(bezier, outward, near, size)) {
    ImageSpan span{};
    span.patch = patch;
    span.iu = static_cast<std::uint32_t>(k / bezier.spans_v());
    span.iv = static_cast<std::uint32_t>(k % bezier.spans_v());
    span.first_coefficient = first + k * bezier.span_size();
    std::copy(bounding.cone.axis.begin(), bounding.cone.axis.end(), span.cone_axis);
    span.cone_cosine = bounding.cone.cosine;
    span.ends = span_ends(bezier, span.iu, span.iv);
    if (!loops.empty()) span.ends = creases_only(span.ends, span, bezier);
    append_leaves(bounding, TrimmedSpan(loops, bezier, span.iu, span.iv), parts);
    parts.spans.push_back(span);
    ++k;
  }
  parts.coefficients.insert(parts.coefficients.end(), bezier.coefficients.begin(), bezier.coefficients.end());
  parts.taylor.insert(parts.taylor.end(), bezier.taylor.begin(), bezier.taylor.end());
}

void append_patch(const NurbsSurface& surface, int outward, double near, ImageSize size, ImageParts& parts) {
  const BezierPatch bezier = extract_bezier(surface);
  ImagePatch patch{};
  patch.degree_u = static_cast<std::uint32_t>(bezier.degree_u);
  patch.degree_v = static_cast<std::uint32_t>(bezier.degree_v);
  patch.spans_u = static_cast<std::uint32_t>(bezier.spans_u());
  patch.spans_v = static_cast<std::uint32_t>(bezier.spans_v());
  patch.first_span = static_cast<std::uint32_t>(parts.spans.size());
  patch.first_break_u = append_breaks(bezier.breaks_u, parts);
  patch.first_break_v = append_breaks(bezier.breaks_v, parts);
  patch.rational = bezier.rational ? 1 : 0;
  patch.reversed = surface.reversed ? 1 : 0;
  patch.first_slab = static_cast<std::uint32_t>(parts.trims.slabs.size());
  const std::vector<TrimLoop> loops = pieces_of(surface.trims, bezier);
  append_trims(loops, bezier, patch.first_span, parts.trims);
  patch.slab_count = static_cast<std::uint32_t>(parts.trims.slabs.size()) - patch.first_slab;
  append_spans(bezier, loops, surface.reversed ? -outward : outward, near, size, parts);
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
  header.trim_count = static_cast<std::uint32_t>(parts.trims.pieces.size());
  header.run_count = static_cast<std::uint32_t>(parts.trims.runs.size());
  header.slab_count = static_cast<std::uint32_t>(parts.trims.slabs.size());
  header.slab_trim_count = static_cast<std::uint32_t>(parts.trims.slab_trims.size());
  header.patches_offset = sizeof(ImageHeader);
  header.spans_offset = header.patches_offset + parts.patches.size() * sizeof(ImagePatch);
  header.leaves_offset = header.spans_offset + parts.spans.size() * sizeof(ImageSpan);
  header.nodes_offset = header.leaves_offset + parts.leaves.size() * sizeof(ImageLeaf);
  header.breaks_offset = header.nodes_offset + parts.nodes.size() * sizeof(ImageNode);
  header.coefficients_offset = header.breaks_offset + parts.breaks.size() * sizeof(double);
  header.taylor_offset = header.coefficients_offset + parts.coefficients.size() * sizeof(double);
  header.trims_offset = header.taylor_offset + parts.taylor.size() * sizeof(double);
  header.runs_offset = header.trims_offset + parts.trims.pieces.size() * sizeof(ImageTrim);
  header.slabs_offset = header.runs_offset + parts.trims.runs.size() * sizeof(ImageTrimRun);
  header.slab_trims_offset = header.slabs_offset + parts.trims.slabs.size() * sizeof(ImageSlab);
  header.total_size = header.slab_trims_offset + (parts.trims.slab_trims.size() + 1) / 2 * 8;
  const Box whole = box_around(parts.boxes);
  std::copy_n(whole.min, 3, header.box_min);
  std::copy_n(whole.max, 3, header.box_max);
  return header;
}

template <class Element>
void copy_array(const std::vector<Element>& array, std::uint64_t offset, std::vector<std::byte>& image) {
  if (!array.empty()) std::memcpy(image.data() + offset, array.data(), array.size() * sizeof(Element));
}

}  // namespace

DesignImage open_new_image(const std::vector<std::byte>& image) {
  DesignImage design;
  if (const Status status = DesignImage::open(image, design); status != Status::ok)
    throw std::logic_error(std::string("a new image is not valid: ") + status_text(status));
  return design;
}

void seal_image(std::vector<std::byte>& image) {
  const std::uint32_t crc = image_crc(image);
  std::memcpy(image.data() + offsetof(ImageHeader, crc32), &crc, sizeof crc);
}

std::vector<std::byte> write_image(const std::vector<NurbsSurface>& surfaces, DesignUnit unit, int outward,
                                   ImageSize size) {
  ImageParts parts;
  const double near = kNear * half_diagonal(surfaces);
  for (const NurbsSurface& surface : surfaces) append_patch(surface, outward, near, size, parts);
  if (parts.leaves.size() + parts.trims.runs.size() > std::numeric_limits<std::uint32_t>::max() / 4) {
    throw ToolError("the design has too many knot spans; export the blade with fewer knots");
  }
  const Box leaves = box_around(parts.boxes);
  for (const Box& run : parts.trims.boxes) parts.boxes.push_back(common_to(run, leaves));
  parts.nodes = build_bounding_tree(parts.boxes);
  for (std::uint32_t k = 0; k < parts.nodes.size(); ++k) {
    for (const std::uint32_t child : parts.nodes[k].child) {
      if (child == kNoChild || (child & kLeafChild) == 0) continue;
      const std::size_t index = child & ~kLeafChild;
      (index < parts.leaves.size() ? parts.leaves[index].node : parts.trims.runs[index - parts.leaves.size()].node) = k;
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
  copy_array(parts.trims.pieces, header.trims_offset, image);
  copy_array(parts.trims.runs, header.runs_offset, image);
  copy_array(parts.trims.slabs, header.slabs_offset, image);
  copy_array(parts.trims.slab_trims, header.slab_trims_offset, image);
  seal_image(image);
  mark_joints(image);
  seal_image(image);
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
    std::fill_n(span.joints, 4, 0U);  // a ridge becomes a valley
    std::memcpy(place, &span, sizeof span);
  }
  seal_image(image);
  mark_joints(image);
  seal_image(image);
}

}  // namespace bladefit

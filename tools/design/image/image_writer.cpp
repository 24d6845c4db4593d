#include "tools/design/image/image_writer.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "tools/design/image/creases.hpp"
#include "tools/design/image/image_parts.hpp"
#include "tools/design/image/joints.hpp"
#include "tools/design/image/leaf_choice.hpp"
#include "tools/design/image/span_bounding.hpp"
#include "tools/design/image/tree_builder.hpp"
#include "tools/design/image/trim_pieces.hpp"
#include "tools/design/nurbs/bezier_extraction.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// A leaf is to tell of points this near to the surface [half diagonals of the control points' box].
constexpr double kNear = 5e-3;

/// Bytes that an image may have, in those of its control points.
constexpr std::uint64_t kPointBytes = 4 * sizeof(double);
constexpr std::uint64_t times_of_points(ImageSize size) { return size == ImageSize::compact ? 20 : 40; }
/// Bytes of a leaf with its share of the nodes, of which there are some three to eight leaves.
constexpr std::uint64_t kLeafBytes = sizeof(ImageLeaf) + sizeof(ImageNode) * 3 / 8;
/// Tries until an image is as small as it may be.
constexpr int kMostTries = 16;

/// Half the diagonal of the box of all control points [mm].
double half_diagonal(const std::vector<NurbsSurface>& surfaces) {
  Eigen::AlignedBox3d box;
  for (const NurbsSurface& surface : surfaces) {
    for (const Eigen::Vector3d& point : surface.control_points) box.extend(point);
  }
  return 0.5 * box.diagonal().norm();
}

/// Appends numbers and says where they begin.
std::uint32_t append(const std::vector<double>& numbers, std::vector<double>& to) {
  const auto first = static_cast<std::uint32_t>(to.size());
  to.insert(to.end(), numbers.begin(), numbers.end());
  return first;
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

void append_spans(const BezierPatch& bezier, const std::vector<TrimLoop>& loops, const ImagePatch& patch,
                  std::vector<SpanBounding> boundings, ImageParts& parts, std::vector<LeafTree>& trees) {
  const std::uint32_t first_point = append(bezier.points, parts.points) / 4,
                      first_taylor = append(bezier.taylor, parts.taylor) / 4;
  std::size_t k = 0;
  for (SpanBounding& bounding : boundings) {
    ImageSpan span{};
    span.patch = static_cast<std::uint32_t>(parts.patches.size());
    span.iu = static_cast<std::uint32_t>(k / patch.spans_v);
    span.iv = static_cast<std::uint32_t>(k % patch.spans_v);
    span.first_point = first_point + static_cast<std::uint32_t>(bezier.first_point(k));
    span.first_taylor = first_taylor + static_cast<std::uint32_t>(k * bezier.span_size() / 4);
    std::copy(bounding.cone.axis.begin(), bounding.cone.axis.end(), span.cone_axis);
    span.cone_cosine = bounding.cone.cosine;
    span.ends = span_ends(bezier, span.iu, span.iv);
    if (!loops.empty()) span.ends = creases_only(span.ends, span, bezier);
    const TrimmedSpan face(loops, bezier, span.iu, span.iv);
    for (LeafCandidate& candidate : bounding.leaves) candidate.on_face = face.reaches(rect_of(candidate.leaf));
    trees.push_back(std::move(bounding.leaves));
    parts.spans.push_back(span);
    ++k;
  }
}

void append_patch(const NurbsSurface& surface, int outward, double near, ImageSize size, ImageParts& parts,
                  std::vector<LeafTree>& trees) {
  const BezierPatch bezier = extract_bezier(surface);
  ImagePatch patch{};
  patch.degree_u = static_cast<std::uint32_t>(bezier.degree_u);
  patch.degree_v = static_cast<std::uint32_t>(bezier.degree_v);
  patch.spans_u = static_cast<std::uint32_t>(bezier.spans_u());
  patch.spans_v = static_cast<std::uint32_t>(bezier.spans_v());
  patch.first_span = static_cast<std::uint32_t>(parts.spans.size());
  patch.first_break_u = append(bezier.breaks_u, parts.breaks);
  patch.first_break_v = append(bezier.breaks_v, parts.breaks);
  patch.rational = bezier.rational ? 1 : 0;
  patch.reversed = surface.reversed ? 1 : 0;
  patch.points_v = static_cast<std::uint32_t>(bezier.points_v);
  patch.first_extraction_u = append(bezier.along_u.shares, parts.extractions);
  patch.first_extraction_v = append(bezier.along_v.shares, parts.extractions);
  patch.first_slab = static_cast<std::uint32_t>(parts.trims.slabs.size());
  const std::vector<TrimLoop> loops = pieces_of(surface.trims, bezier);
  append_trims(loops, bezier, patch.first_span, parts.trims);
  patch.slab_count = static_cast<std::uint32_t>(parts.trims.slabs.size()) - patch.first_slab;
  append_spans(bezier, loops, patch, bound_spans(bezier, surface.reversed ? -outward : outward, near, size), parts,
               trees);
  parts.patches.push_back(patch);
}

/// Around whole spans, so that it does not depend on how these are cut.
Box box_of(const std::vector<LeafTree>& trees) {
  std::vector<Box> boxes;
  for (const LeafTree& tree : trees) {
    if (tree.front().on_face) boxes.push_back(tree.front().box);
  }
  return box_around(boxes);
}

/// Puts the chosen leaves into the image, with the tree over them and the trim loops.
void put_leaves(const LeafChoice& choice, const std::vector<LeafTree>& trees, const Box& whole, ImageParts& parts) {
  parts.leaves.clear();
  std::vector<Box> boxes;
  for (std::size_t span = 0; span < trees.size(); ++span) {
    for (const std::size_t k : choice[span]) {
      parts.leaves.push_back(trees[span][k].leaf);
      parts.leaves.back().span = static_cast<std::uint32_t>(span);
      boxes.push_back(trees[span][k].box);
    }
  }
  const Box around = box_around(boxes);
  for (const Box& run : parts.trims.boxes) boxes.push_back(common_to(run, around));
  parts.nodes = build_bounding_tree(boxes, whole);
  for (std::uint32_t k = 0; k < parts.nodes.size(); ++k) {
    for (const std::uint32_t child : parts.nodes[k].child) {
      if (child == kNoChild || (child & kLeafChild) == 0) continue;
      const std::size_t index = child & ~kLeafChild;
      (index < parts.leaves.size() ? parts.leaves[index].node : parts.trims.runs[index - parts.leaves.size()].node) = k;
    }
  }
}

/// Leaves out what is a matter of speed alone, Taylor forms and cuts of leaves, as far as the image is too large.
void fit_size(std::uint64_t most_bytes, ImageSize size, const std::vector<LeafTree>& trees, const Box& whole,
              ImageParts& parts) {
  const std::size_t fewest = fewest_leaves(trees);
  if (size == ImageSize::compact || size_of(parts) + fewest * kLeafBytes > most_bytes) {
    parts.taylor.clear();
    for (ImageSpan& span : parts.spans) span.first_taylor = 0;
  }
  const std::uint64_t others = size_of(parts);
  std::size_t most = most_bytes > others ? static_cast<std::size_t>((most_bytes - others) / kLeafBytes) : 0;
  for (int k = 0; k < kMostTries; ++k) {
    put_leaves(choose_leaves(trees, most), trees, whole, parts);
    const std::uint64_t bytes = size_of(parts);
    if (bytes <= most_bytes || parts.leaves.size() == fewest) return;
    most = parts.leaves.size() - std::min(parts.leaves.size(), std::size_t{1} + (bytes - most_bytes) / kLeafBytes);
  }
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
  std::vector<LeafTree> trees;
  const double near = kNear * half_diagonal(surfaces);
  std::uint64_t points = 0;
  for (const NurbsSurface& surface : surfaces) {
    append_patch(surface, outward, near, size, parts, trees);
    points += surface.control_points.size();
  }
  if (trees.size() + parts.trims.runs.size() + parts.taylor.size() > std::numeric_limits<std::uint32_t>::max() / 4) {
    throw ToolError("the design has too many knot spans; export the blade with fewer knots");
  }
  const Box whole = box_of(trees);
  fit_size(times_of_points(size) * kPointBytes * points, size, trees, whole, parts);
  std::vector<std::byte> image = assembled(parts, unit, outward, whole);
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

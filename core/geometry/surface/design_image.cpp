#include "core/geometry/surface/design_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/crc32.hpp"
#include "core/geometry/surface/span_net.hpp"
#include "core/geometry/surface/taylor.hpp"
#include "core/geometry/surface/tree_check.hpp"
#include "core/geometry/surface/trim_check.hpp"

namespace bladefit {
namespace {

/// Coefficients of a Taylor form may differ from their own by this share of the largest control point.
constexpr double kTaylorRounding = 1e-12;

/// By so much the shares of control points may add up to something else than 1.
constexpr double kMeanRounding = 1e-14;

/// True where `count` elements of T at `offset` lie inside the image, 8-byte aligned, behind the header.
template <class T>
bool array_fits(std::uint64_t offset, std::uint64_t count, std::uint64_t total) {
  return offset % 8 == 0 && offset >= sizeof(ImageHeader) && offset <= total && count <= (total - offset) / sizeof(T);
}

template <class T>
std::span<const T> view(std::span<const std::byte> bytes, std::uint64_t offset, std::uint64_t count) {
  return {reinterpret_cast<const T*>(bytes.data() + offset), static_cast<std::size_t>(count)};
}

bool finite3(const double (&x)[3]) { return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]); }

/// Finite, and not a single point: its half diagonal is the scale of all tolerances.
bool box_valid(const ImageHeader& h) {
  double size = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(h.box_min[axis] <= h.box_max[axis])) return false;
    size += h.box_max[axis] - h.box_min[axis];
  }
  return finite3(h.box_min) && finite3(h.box_max) && size > 0.0;
}

bool breaks_valid(std::span<const double> breaks, std::uint64_t first, std::uint64_t spans) {
  if (first > breaks.size() || spans + 1 > breaks.size() - first) return false;
  const auto b = breaks.subspan(first, spans + 1);
  for (std::size_t i = 0; i + 1 < b.size(); ++i) {
    if (!(b[i] < b[i + 1])) return false;
  }
  return b.front() == 0.0 && b.back() == 1.0;
}

/// The extractions of one direction are means, but for rounding.
bool extractions_valid(std::span<const double> extractions, std::uint64_t first, std::uint64_t spans,
                       std::uint64_t order) {
  const std::uint64_t count = spans * order * order;
  if (first > extractions.size() || count > extractions.size() - first) return false;
  for (std::uint64_t row = first; row < first + count; row += order) {
    double sum = 0.0;
    for (std::uint64_t k = row; k < row + order; ++k) {
      if (!(extractions[k] >= 0.0 && extractions[k] <= 1.0)) return false;
      sum += extractions[k];
    }
    if (!(std::abs(sum - 1.0) <= kMeanRounding)) return false;
  }
  return true;
}

bool patches_valid(const DesignImage& image) {
  std::uint64_t next_span = 0;
  for (const ImagePatch& p : image.patches()) {
    const bool degrees = p.degree_u >= 1 && p.degree_u <= kMaxDegree && p.degree_v >= 1 && p.degree_v <= kMaxDegree;
    const bool spans = p.spans_u >= 1 && p.spans_v >= 1 && p.first_span == next_span;
    if (!degrees || !spans || p.rational > 1 || p.reversed > 1 || p.points_v <= p.degree_v) return false;
    next_span += static_cast<std::uint64_t>(p.spans_u) * p.spans_v;
    if (next_span > image.spans().size()) return false;
    if (!breaks_valid(image.breaks(), p.first_break_u, p.spans_u)) return false;
    if (!breaks_valid(image.breaks(), p.first_break_v, p.spans_v)) return false;
    if (!extractions_valid(image.extractions(), p.first_extraction_u, p.spans_u, p.degree_u + 1)) return false;
    if (!extractions_valid(image.extractions(), p.first_extraction_v, p.spans_v, p.degree_v + 1)) return false;
  }
  return next_span == image.spans().size();
}

bool cone_valid(const ImageSpan& s) {
  if (!finite3(s.cone_axis) || !(s.cone_cosine >= -1.0 && s.cone_cosine <= 1.0)) return false;
  const double n2 = s.cone_axis[0] * s.cone_axis[0] + s.cone_axis[1] * s.cone_axis[1] + s.cone_axis[2] * s.cone_axis[2];
  return s.cone_cosine == -1.0 || std::abs(n2 - 1.0) < 1e-9;
}

/// That they hold is the compiler's promise, as with the bounds of leaves.
bool reach_valid(const ImageSpan& s) {
  const auto length = [](float x) { return std::isfinite(x) && x >= 0.0F; };
  return length(s.reach[0]) && length(s.reach[1]) && length(s.apart) && s.inset[kLowU] + s.inset[kHighU] < 256 &&
         s.inset[kLowV] + s.inset[kHighV] < 256;
}

/// Every number finite and every range the right way round. That the bounds hold is the compiler's promise, kept by the
/// CRC: it cannot be checked at this cost.
bool bounds_valid(const ImageBounds& b) {
  const auto rises = [](const HalfFloat* low, const HalfFloat* high, int count) {
    return std::equal(low, low + count, high, [](HalfFloat l, HalfFloat h) {
      return std::isfinite(from_half_float(l)) && std::isfinite(from_half_float(h)) &&
             from_half_float(l) <= from_half_float(h);
    });
  };
  const auto finite = [](const float(&x)[3]) {
    return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
  };
  bool valid = finite(b.middle) && finite(b.stretch) && b.stretch[0] > 0.0F && b.stretch[1] != 0.0F &&
               rises(b.low, b.high, 3) && rises(b.self_low, b.self_high, 7);
  for (const auto& axis : b.axis) valid = valid && finite(axis);
  for (const auto& derivative : b.derivative) valid = valid && finite(derivative);
  for (const auto& spread : b.spread) {
    for (const HalfFloat x : spread) valid = valid && std::isfinite(from_half_float(x)) && from_half_float(x) >= 0.0;
  }
  return valid;
}

/// The sides on the patch's edges are marked, joints are at marked sides, and nothing else is set.
bool ends_valid(const ImageSpan& s, const ImagePatch& p) {
  const std::uint32_t sides = (s.iu == 0 ? kEndsAtLowU : 0U) | (s.iu + 1 == p.spans_u ? kEndsAtHighU : 0U) |
                              (s.iv == 0 ? kEndsAtLowV : 0U) | (s.iv + 1 == p.spans_v ? kEndsAtHighV : 0U);
  if ((s.ends & sides) != (p.slab_count == 0 ? sides : 0U) || s.ends >= 16U) return false;
  for (std::uint32_t side = 0; side < 4; ++side) {
    if (s.joints[side] != 0 && (s.ends & (1U << side)) == 0) return false;
    for (std::uint32_t part = 0; part < kJointParts; ++part) {
      if (!is_joint(static_cast<std::uint32_t>(joint_of_part(s.joints[side], part)))) return false;
    }
  }
  return true;
}

/// Control points finite, weights positive.
bool points_valid(const DesignImage& image, const ImageSpan& s, const ImagePatch& p) {
  const std::uint64_t count = image.points().size() / 4,
                      last = static_cast<std::uint64_t>(p.degree_u) * p.points_v + p.degree_v;
  if (s.first_point >= count || last >= count - s.first_point) return false;
  const double* first = &image.points()[4U * static_cast<std::size_t>(s.first_point)];
  for (std::uint32_t i = 0; i <= p.degree_u; ++i) {
    for (std::uint32_t j = 0; j <= p.degree_v; ++j) {
      const double* c = first + 4U * (static_cast<std::size_t>(i) * p.points_v + j);
      const double w = c[3];
      if (!(w > 0.0) || !std::isfinite(w) || (p.rational == 0 && w != 1.0)) return false;
      for (int k = 0; k < 3; ++k) {
        if (!std::isfinite(c[k] / w)) return false;
      }
    }
  }
  return true;
}

/// The Taylor form, where there is one, is that of the control points, but for rounding.
bool taylor_valid(const DesignImage& image, const ImageSpan& s, const ImagePatch& p) {
  const auto taylor = image.taylor();
  const std::size_t count = 4U * (p.degree_u + 1) * (p.degree_v + 1), first = 4U * std::size_t{s.first_taylor};
  if (taylor.empty()) return s.first_taylor == 0;
  if (first > taylor.size() || count > taylor.size() - first) return false;
  std::array<double, 4 * kMaxOrder * kMaxOrder> expected;
  bezier_points(source_of(image, s), expected.data());
  double size = 0.0;
  for (std::size_t k = 0; k < count; ++k) size = std::max(size, std::abs(expected[k]));
  to_taylor_form(p.degree_u, p.degree_v, expected.data());
  for (std::size_t k = 0; k < count; ++k) {
    if (!(std::abs(taylor[first + k] - expected[k]) <= kTaylorRounding * size)) return false;
  }
  return true;
}

bool spans_valid(const DesignImage& image) {
  for (std::size_t i = 0; i < image.spans().size(); ++i) {
    const ImageSpan& s = image.spans()[i];
    if (s.patch >= image.patches().size()) return false;
    const ImagePatch& p = image.patches()[s.patch];
    if (s.iu >= p.spans_u || s.iv >= p.spans_v ||
        i != p.first_span + static_cast<std::uint64_t>(s.iu) * p.spans_v + s.iv)
      return false;
    if (!cone_valid(s) || !reach_valid(s) || !ends_valid(s, p) || !points_valid(image, s, p) ||
        !taylor_valid(image, s, p))
      return false;
  }
  return true;
}

bool rectangle_valid(const ImageLeaf& leaf) {
  return leaf.spare == 0 && leaf.bounds.spare == 0 && leaf.s_min >= 0.0F && leaf.s_min < leaf.s_max &&
         leaf.s_max <= 1.0F && leaf.t_min >= 0.0F && leaf.t_min < leaf.t_max && leaf.t_max <= 1.0F;
}

/// The leaves of a span follow each other and cover its area: they are cut by halves, so that areas add up exactly.
/// With trim loops some are left out.
bool leaves_valid(const DesignImage& image) {
  std::size_t i = 0;
  for (std::uint32_t span = 0; span < image.spans().size(); ++span) {
    double area = 0.0;
    for (; i < image.leaves().size() && image.leaves()[i].span == span; ++i) {
      const ImageLeaf& leaf = image.leaves()[i];
      if (!rectangle_valid(leaf) || !bounds_valid(leaf.bounds)) return false;
      const LocalRect rect = rect_of(leaf);
      area += (rect.s_max - rect.s_min) * (rect.t_max - rect.t_min);
    }
    const bool trimmed = image.patches()[image.spans()[span].patch].slab_count > 0;
    if (trimmed ? area > 1.0 : area != 1.0) return false;
  }
  return i == image.leaves().size();
}

constexpr std::uint32_t swapped(std::uint32_t word) {
  return word << 24U | (word & 0xFF00U) << 8U | (word >> 8U & 0xFF00U) | word >> 24U;
}

/// Where the field crc32 ends.
constexpr std::size_t kCrcEnd = offsetof(ImageHeader, crc32) + sizeof(std::uint32_t);

/// CRC-32 of an image to there, the field taken as 0; 0 where it is shorter.
std::uint32_t crc_before_its_end(std::span<const std::byte> image) {
  constexpr std::array<std::byte, sizeof(std::uint32_t)> zero{};
  if (image.size() < kCrcEnd) return 0;
  return crc32(zero, crc32(image.first(kCrcEnd - zero.size())));
}

Status header_status(std::span<const std::byte> bytes, const ImageHeader& h) {
  if (image_crc(bytes) != h.crc32) return Status::bad_crc;
  const bool arrays = array_fits<ImagePatch>(h.patches_offset, h.patch_count, h.total_size) &&
                      array_fits<ImageSpan>(h.spans_offset, h.span_count, h.total_size) &&
                      array_fits<ImageLeaf>(h.leaves_offset, h.leaf_count, h.total_size) &&
                      array_fits<ImageNode>(h.nodes_offset, h.node_count, h.total_size) &&
                      array_fits<double>(h.breaks_offset, h.break_count, h.total_size) &&
                      array_fits<double[4]>(h.points_offset, h.point_count, h.total_size) &&
                      array_fits<double>(h.extractions_offset, h.extraction_count, h.total_size) &&
                      array_fits<double>(h.taylor_offset, h.taylor_count, h.total_size) &&
                      array_fits<ImageTrim>(h.trims_offset, h.trim_count, h.total_size) &&
                      array_fits<ImageTrimRun>(h.runs_offset, h.run_count, h.total_size) &&
                      array_fits<ImageSlab>(h.slabs_offset, h.slab_count, h.total_size) &&
                      array_fits<std::uint32_t>(h.slab_trims_offset, h.slab_trim_count, h.total_size);
  const bool counts = h.patch_count >= 1 && h.span_count >= 1 && h.leaf_count >= 1 && h.node_count >= 1;
  const bool fields = h.design_unit <= 1 && (h.outward == 1 || h.outward == -1) && box_valid(h);
  return arrays && counts && fields ? Status::ok : Status::bad_content;
}

}  // namespace

std::uint32_t image_crc(std::span<const std::byte> image) {
  const std::uint32_t before = crc_before_its_end(image);
  return image.size() < kCrcEnd ? 0 : crc32(image.subspan(kCrcEnd), before);
}

std::uint32_t DesignImage::identity() const {
  const std::span image(reinterpret_cast<const std::byte*>(header_), static_cast<std::size_t>(header_->total_size));
  const std::size_t spans = static_cast<std::size_t>(header_->spans_offset), after = spans + spans_.size_bytes();
  std::uint32_t crc = crc32(image.subspan(kCrcEnd, spans - kCrcEnd), crc_before_its_end(image));
  for (ImageSpan span : spans_) {
    span.reach[0] = span.reach[1] = span.apart = 0.0F;
    std::fill(std::begin(span.inset), std::end(span.inset), std::uint8_t{0});
    crc = crc32(std::as_bytes(std::span(&span, 1)), crc);
  }
  return crc32(image.subspan(after), crc);
}

Status DesignImage::open_head(std::span<const std::byte> bytes, const ImageHeader*& header) {
  if (bytes.data() == nullptr) return Status::null_argument;
  if (reinterpret_cast<std::uintptr_t>(bytes.data()) % 8 != 0) return Status::misaligned;
  if (bytes.size() >= sizeof kImageMagic && std::memcmp(bytes.data(), kImageMagic, sizeof kImageMagic) != 0)
    return Status::bad_magic;
  if (bytes.size() < sizeof(ImageHeader)) return Status::bad_length;
  const auto* const h = reinterpret_cast<const ImageHeader*>(bytes.data());
  if (h->version == swapped(kImageVersion)) return Status::bad_byte_order;
  if (h->version != kImageVersion) return Status::bad_version;
  if (h->total_size != bytes.size()) return Status::bad_length;
  header = h;
  return Status::ok;
}

Status DesignImage::open(std::span<const std::byte> bytes, DesignImage& image) {
  DesignImage candidate;
  if (const Status status = open_head(bytes, candidate.header_); status != Status::ok) return status;
  const ImageHeader& h = *candidate.header_;
  if (const Status status = header_status(bytes, h); status != Status::ok) return status;
  candidate.patches_ = view<ImagePatch>(bytes, h.patches_offset, h.patch_count);
  candidate.spans_ = view<ImageSpan>(bytes, h.spans_offset, h.span_count);
  candidate.leaves_ = view<ImageLeaf>(bytes, h.leaves_offset, h.leaf_count);
  candidate.nodes_ = view<ImageNode>(bytes, h.nodes_offset, h.node_count);
  candidate.breaks_ = view<double>(bytes, h.breaks_offset, h.break_count);
  candidate.points_ = view<double>(bytes, h.points_offset, 4 * h.point_count);
  candidate.extractions_ = view<double>(bytes, h.extractions_offset, h.extraction_count);
  candidate.taylor_ = view<double>(bytes, h.taylor_offset, h.taylor_count);
  candidate.trims_ = view<ImageTrim>(bytes, h.trims_offset, h.trim_count);
  candidate.runs_ = view<ImageTrimRun>(bytes, h.runs_offset, h.run_count);
  candidate.slabs_ = view<ImageSlab>(bytes, h.slabs_offset, h.slab_count);
  candidate.slab_trims_ = view<std::uint32_t>(bytes, h.slab_trims_offset, h.slab_trim_count);
  if (!patches_valid(candidate) || !spans_valid(candidate) || !leaves_valid(candidate) || !trims_valid(candidate) ||
      !tree_valid(candidate))
    return Status::bad_content;
  image = candidate;
  return Status::ok;
}

}  // namespace bladefit

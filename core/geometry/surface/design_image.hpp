#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/geometry/surface/joint.hpp"
#include "core/status.hpp"

namespace bladefit {

/// The compiled design: one flat, relocatable block, used in place from memory, a file mapping or flash.
/// Layout (little endian, 8-byte aligned throughout): ImageHeader, then the arrays at the offsets it names.
/// All lengths are millimetres; every patch has its parameters normalised to 0..1.

inline constexpr char kImageMagic[8] = {'B', 'L', 'D', 'E', 'F', 'I', 'T', '\n'};
inline constexpr std::uint32_t kImageVersion = 10;
inline constexpr std::uint32_t kMaxDegree = 9;
inline constexpr std::uint32_t kMaxTreeDepth = 48;

enum class DesignUnit : std::uint32_t { mm = 0, inch = 1 };

struct ImageHeader {
  char magic[8];
  std::uint32_t version;
  std::uint32_t crc32;        ///< CRC-32 (IEEE 802.3, as in zlib) over the whole image with this field as 0
  std::uint64_t total_size;   ///< bytes
  std::uint32_t design_unit;  ///< DesignUnit of the file it was compiled from; the numbers here are mm all the same
  std::int32_t outward;       ///< +1 or -1: outward normal = outward * (Su x Sv), of reversed patches minus that
  std::uint32_t patch_count, span_count, node_count, break_count;
  std::uint32_t leaf_count, trim_count, run_count, slab_count, slab_trim_count, extraction_count;
  std::uint64_t point_count;   ///< control points
  std::uint64_t taylor_count;  ///< doubles of the spans' Taylor forms; 0: each is worked out where it is asked for
  std::uint64_t patches_offset, spans_offset, leaves_offset, nodes_offset, breaks_offset, points_offset,
      extractions_offset, taylor_offset, trims_offset, runs_offset, slabs_offset, slab_trims_offset;
  double box_min[3], box_max[3];  ///< of the control points [mm]
};

/// One NURBS patch, cut into spans_u x spans_v Bezier spans. The control points of a span in one direction are means of
/// the patch's: Bezier point k of span i is the sum of extraction[l] times control point l of the degree + 1 that the
/// span takes part in, extraction being the row k of the span's (degree + 1) x (degree + 1) numbers in
/// extractions[first_extraction + i (degree + 1)^2]. (Borden and others, Isogeometric finite element data structures
/// based on Bezier extraction of NURBS, 2011.)
struct ImagePatch {
  std::uint32_t degree_u, degree_v;  ///< 1..9
  std::uint32_t spans_u, spans_v;
  std::uint32_t first_span;                    ///< span (iu, iv) is spans[first_span + iu * spans_v + iv]
  std::uint32_t first_break_u, first_break_v;  ///< spans_u + 1 (spans_v + 1) rising parameters, the first 0, the last 1
  std::uint32_t rational;                      ///< 0: every weight is 1
  std::uint32_t reversed;                      ///< 1: the outward side is the other one than the header says
  std::uint32_t first_slab, slab_count;        ///< of its trim loops; no slabs: the face is all of the patch
  std::uint32_t points_v;                      ///< control points of a row: from one to the next in u
  std::uint32_t first_extraction_u, first_extraction_v;
};

/// Sides of a span beyond which the surface ends or is not smooth: bits of ImageSpan::ends. The edges of a patch with
/// trim loops are none: there the face ends at its loops.
inline constexpr std::uint32_t kEndsAtLowU = 1, kEndsAtHighU = 2, kEndsAtLowV = 4, kEndsAtHighV = 8;

/// One Bezier span. Control point (i, j), 0 <= i <= degree_u, 0 <= j <= degree_v, of those of the patch that it takes
/// part in stands at points[4 (first_point + i points_v + j)] as (w x, w y, w z, w). The coefficient of its Taylor form
/// (taylor.hpp) of order i in s, j in t, where the image holds these: taylor[4 (first_taylor + i (degree_v + 1) + j)].
struct ImageSpan {
  std::uint32_t patch, iu, iv;
  std::uint32_t ends;       ///< kEndsAt... bits: edges of the patch and creases
  std::uint64_t joints[4];  ///< of these sides: a Joint a part, in rising parameter from the lowest bits on
  std::uint32_t first_point, first_taylor;
  double cone_axis[3];  ///< every outward normal of the span is within the cone about this unit axis
  double cone_cosine;   ///< cosine of the half angle; -1 where no bound is known
  /// No ball of this radius that touches the design from one side in this span, at whatever place but for `inset`,
  /// holds another point of the design: [0] on the side of Su x Sv, [1] on the other one [mm]. 0: nothing is known.
  float reach[2];
  /// From a foot there to a point that is nearer to it than the reach there is no other local minimum of the distance
  /// so near to the foot [mm]. 0: nothing is known.
  float apart;
  std::uint8_t inset[4];  ///< that is not told of places so near to these sides [kInsetUnit]
};

/// In spans, of ImageSpan::inset.
inline constexpr double kInsetUnit = 1.0 / 256.0;

/// The upper half of a number in single precision: 8 bits of fraction, the sign and range of a float (bfloat16).
using HalfFloat = std::uint16_t;
[[nodiscard]] inline double from_half_float(HalfFloat x) {
  return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(x) << 16U));
}

/// Bounds of a rectangle of a span about a place c near to its middle: what lets most of them be judged without looking
/// at control points. Vectors are in the frame of `axis`, whose first row is the normal in the middle. All is rounded
/// to few digits, so that the bounds hold for what is written here: the axes are a little shorter than 1, so that
/// nothing is farther apart in them than it is. First derivatives are along the rectangle's own parameters s, t in
/// 0..1, and across its sides: along the unit vectors that are perpendicular in the middle to the sides of constant s
/// and of constant t. Their signs are what counts, so they are taken as such positive multiples that along themselves
/// they stay what they are in the middle: only how they turn is in their spread. Second derivatives are along a, b,
/// linear in s and t, with Sa = stretch[0] Ss and Sb = stretch[1] St + stretch[2] Ss, which are orthonormal in the
/// middle: there the Hessian of a squared distance is near to the unit matrix. Order: s, t, aa, ab, bb, across s,
/// across t.
struct ImageBounds {
  float middle[3];            ///< c, in design coordinates [mm]
  float axis[3][3];           ///< at right angles but for rounding, one a row
  float stretch[3];           ///< [1/mm]
  float derivative[7][3];     ///< of S, in the middle [mm, mm, 1/mm ...]
  HalfFloat low[3], high[3];  ///< axis[k] . (S - c) lies between these [mm]
  HalfFloat spread[7][3];     ///< no component of a derivative is farther from that in the middle
  HalfFloat self_low[7];      ///< the same derivatives of 1/2 |S - c|^2 lie between these [mm^2, mm^2, 1 ...]
  HalfFloat self_high[7];
  HalfFloat spare;  ///< 0
};

/// A rectangle of a span, so small that its bounds are tight. The leaves of a span tile it; where the patch has trim
/// loops, those outside of the face are left out.
struct ImageLeaf {
  std::uint32_t span;
  std::uint32_t node;                ///< index of the node that it is a child of
  float s_min, s_max, t_min, t_max;  ///< parameters of the span, 0..1
  ImageBounds bounds;
  std::uint32_t spare;  ///< 0
};

/// A piece of a trim loop, straight in the parameters of its patch, from its own start to that of the next one. It lies
/// in one span. The face is on its left, where u points to the right and v upwards. Loops are closed, those along the
/// sides of the patch too.
struct ImageTrim {
  double u, v;                ///< of its start
  double start[3];            ///< the surface there [mm]
  double slope, bend, third;  ///< no first, second, third derivative along it is longer, its parameter being 0..1 [mm]
  std::uint32_t span;
  std::uint32_t previous, next;  ///< pieces of the same loop
  std::uint16_t joint;           ///< a Joint: what lies beyond it
  std::uint16_t corner;          ///< 1: the loop has a corner at its start
};

/// Pieces of trim loops that follow each other: a child of a node, numbered after the leaves. Runs tile the trims.
struct ImageTrimRun {
  std::uint32_t first, count;
  std::uint32_t node;   ///< index of the node that it is a child of
  std::uint32_t spare;  ///< 0
};
inline constexpr std::uint32_t kMostTrimsInRun = 8;

/// A strip of a patch between two values of v; the slabs of a patch are equally wide. Its trims, in rising order, are
/// slab_trims[first] and so on: all of the patch that reach into it.
struct ImageSlab {
  std::uint32_t first, count;
};

/// ImageNode::child: this bit and the index of a leaf or run, or no child, or the index of a node.
inline constexpr std::uint32_t kLeafChild = 0x80000000U, kNoChild = 0xFFFFFFFFU;

/// Node of the bounding tree, in depth-first order: up to four children with their boxes, about the middle of the
/// header's box, in single precision, rounded outwards. The box of a leaf holds its control points [mm]. Where there is
/// no child, which is behind all others, low is infinite and high minus infinite.
struct ImageNode {
  float low[3][4], high[3][4];  ///< [axis][child]
  std::uint32_t child[4];
};

static_assert(sizeof(ImageHeader) == 232 && sizeof(ImagePatch) == 56 && sizeof(ImageSpan) == 104 &&
              sizeof(ImageBounds) == 228 && sizeof(ImageLeaf) == 256 && sizeof(ImageNode) == 112 &&
              sizeof(ImageTrim) == 80 && sizeof(ImageTrimRun) == 16 && sizeof(ImageSlab) == 8);

/// CRC-32 of an image, its crc32 field taken as 0. Cost: linear in the size.
[[nodiscard]] std::uint32_t image_crc(std::span<const std::byte> image);

/// A validated image; views into memory that the caller keeps alive. Copying it copies the views only.
class DesignImage {
 public:
  /// Checks length, magic, version, CRC and every index, number and box of `bytes` before it is trusted.
  /// Returns ok, null_argument, misaligned (8 bytes), bad_length, bad_magic, bad_byte_order, bad_version, bad_crc or
  /// bad_content; `image` is written only with ok. Cost: linear in the size; done once.
  [[nodiscard]] static Status open(std::span<const std::byte> bytes, DesignImage& image);

  /// The first part of these checks: alignment, magic, version and length. `header` points into `bytes` with ok. Cost:
  /// constant.
  [[nodiscard]] static Status open_head(std::span<const std::byte> bytes, const ImageHeader*& header);

  /// CRC-32 of everything that a fit depends on: the same with and without reach, which leaves out searches alone.
  /// Cost: linear in the size.
  [[nodiscard]] std::uint32_t identity() const;

  [[nodiscard]] const ImageHeader& header() const { return *header_; }
  [[nodiscard]] std::span<const ImagePatch> patches() const { return patches_; }
  [[nodiscard]] std::span<const ImageSpan> spans() const { return spans_; }
  [[nodiscard]] std::span<const ImageLeaf> leaves() const { return leaves_; }
  [[nodiscard]] std::span<const ImageNode> nodes() const { return nodes_; }
  [[nodiscard]] std::span<const double> breaks() const { return breaks_; }
  [[nodiscard]] std::span<const double> points() const { return points_; }  ///< four numbers each
  [[nodiscard]] std::span<const double> extractions() const { return extractions_; }
  [[nodiscard]] std::span<const double> taylor() const { return taylor_; }
  [[nodiscard]] std::span<const ImageTrim> trims() const { return trims_; }
  [[nodiscard]] std::span<const ImageTrimRun> runs() const { return runs_; }
  [[nodiscard]] std::span<const ImageSlab> slabs() const { return slabs_; }
  [[nodiscard]] std::span<const std::uint32_t> slab_trims() const { return slab_trims_; }

 private:
  const ImageHeader* header_ = nullptr;
  std::span<const ImagePatch> patches_;
  std::span<const ImageSpan> spans_;
  std::span<const ImageLeaf> leaves_;
  std::span<const ImageNode> nodes_;
  std::span<const double> breaks_;
  std::span<const double> points_, extractions_, taylor_;
  std::span<const ImageTrim> trims_;
  std::span<const ImageTrimRun> runs_;
  std::span<const ImageSlab> slabs_;
  std::span<const std::uint32_t> slab_trims_;
};

}  // namespace bladefit

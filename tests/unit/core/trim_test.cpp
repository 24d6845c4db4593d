// Patches with trim loops: the image, feet on, over and beyond the loops, what goes on there, and tracking.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "core/geometry/nearest/global_projection.hpp"
#include "core/geometry/surface/trim.hpp"
#include "tests/support/flat_sheets.hpp"

namespace bladefit::testing {
namespace {

TrimLoop polygon(std::initializer_list<std::pair<double, double>> places) {
  TrimLoop loop;
  for (const auto& [u, v] : places) loop.push_back({u, v, true});
  return loop;
}

TrimLoop whole_patch() { return polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}); }

/// 100 x 100 mm in the plane z = 0, with a square hole from 40 to 60 mm: u runs along x, v along y.
NurbsSurface plate_with_square_hole() {
  NurbsSurface plate = flat_sheet({{0, 0, 0}, {100, 0, 0}});
  plate.trims = {whole_patch(), polygon({{0.4, 0.4}, {0.4, 0.6}, {0.6, 0.6}, {0.6, 0.4}})};
  return plate;
}

Foot foot_on(const CompiledDesign& design, const Vec3& r) {
  const GlobalProjection found = project_global(design.surface(), {r}, nullptr);
  EXPECT_TRUE(found.proven) << r.transpose();
  return foot_of(design.surface(), found.nearest, 0.0);
}

void expect_foot(const Foot& foot, const Vec3& point, FootKind kind, FootBorder border) {
  EXPECT_LT((foot.point - point).norm(), 1e-9) << foot.point.transpose();
  EXPECT_EQ(foot.kind, kind);
  EXPECT_EQ(foot.border, border);
}

TEST(Trim, FeetAreInTheFaceOrOnItsLoops) {
  const CompiledDesign design(flat_design({plate_with_square_hole()}));
  expect_foot(foot_on(design, {20, 30, 2}), {20, 30, 0}, FootKind::interior, FootBorder::none);
  expect_foot(foot_on(design, {45, 50, 1}), {40, 50, 0}, FootKind::edge, FootBorder::outer);
  expect_foot(foot_on(design, {110, 50, 1}), {100, 50, 0}, FootKind::edge, FootBorder::outer);
  expect_foot(foot_on(design, {-3, -4, 12}), {0, 0, 0}, FootKind::corner, FootBorder::outer);
  EXPECT_NEAR(foot_on(design, {45, 50, 12}).distance, 13.0, 1e-9);
  EXPECT_NEAR(foot_on(design, {45, 50, 12}).beyond, 5.0, 1e-9);
  EXPECT_NEAR(foot_on(design, {20, 30, -2}).distance, -2.0, 1e-12);
}

/// Half of a plate each, on either side of a slanted line; the second on a patch of other parameters.
std::vector<NurbsSurface> two_halves(double rise) {
  NurbsSurface low = flat_sheet({{0, 0, 0}, {100, 0, 0}}), high = turned_parameters(low);
  low.trims = {polygon({{0, 0}, {0.3, 0}, {0.7, 1}, {0, 1}})};
  // u' runs along y, v' against x.
  high.trims = {polygon({{0, 0}, {1, 0}, {1, 0.3}, {0, 0.7}})};
  for (Eigen::Vector3d& point : high.control_points) point.z() += rise;
  return {low, high};
}

TEST(Trim, FacesThatMeetAlongLoopsGoOn) {
  const CompiledDesign design(flat_design(two_halves(0.0)));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> along(1.0, 99.0);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 place(along(random), along(random), 0);
    const Foot foot = foot_on(design, place + Vec3(0, 0, 0.7));
    expect_foot(foot, place, FootKind::interior, FootBorder::none);
    EXPECT_NEAR(foot.distance, 0.7, 1e-9);
    EXPECT_EQ(foot.patch, place.x() < 30 + 0.4 * place.y() ? 0U : 1U);
  }
}

TEST(Trim, LoopsThatMeetNothingAreOuterEdges) {
  const CompiledDesign design(flat_design(two_halves(-30.0)));
  // Over what the plane of the upper half is beyond its loop: that is no surface.
  const Foot foot = foot_on(design, {55, 50, 1});
  EXPECT_EQ(foot.patch, 0U);
  EXPECT_EQ(foot.kind, FootKind::edge);
  EXPECT_EQ(foot.border, FootBorder::outer);
  EXPECT_NEAR(foot.beyond, 5 / std::hypot(1.0, 0.4), 1e-9);
}

TEST(Trim, WalksThatEndBeyondALoopSaySo) {
  const CompiledDesign design(flat_design({plate_with_square_hole()}));
  const Surface& surface = design.surface();
  const SurfacePlace start = surface.place_at(0, 0.3, 0.5);
  EXPECT_FALSE(project_local(surface, {20, 50, 1}, start).outside);
  EXPECT_TRUE(project_local(surface, {50, 50, 1}, start).outside);
  EXPECT_TRUE(project_local(surface, {110, 50, 1}, start).outside);
}

/// The margin to the runner-up knows the loops: while a point moves by less than half of it, its foot stays nearest.
TEST(Trim, MarginsHoldBesideLoops) {
  const CompiledDesign design(
      flat_design({plate_with_square_hole(), displaced(flat_sheet({{0, 0, 0}, {100, 0, 0}}), {0, 0, -9})}));
  const Surface& surface = design.surface();
  std::mt19937 random(9);
  std::uniform_real_distribution<double> place(35.0, 65.0), unit(-1.0, 1.0);
  int tracked = 0;
  for (int k = 0; k < 4000; ++k) {
    const Vec3 r(place(random), place(random), -4.5 + 4.5 * unit(random));
    const GlobalProjection found = project_global(surface, {r, Vec3::Zero(), 4.0}, nullptr);
    if (found.nearest.on_trim()) {
      EXPECT_EQ(found.runner_up.margin, 0.0);
      continue;
    }
    const Vec3 to = r + 0.499 * found.runner_up.margin * Vec3(unit(random), unit(random), unit(random)).normalized();
    const Projection walked = project_local(surface, to, found.nearest.place);
    if (walked.outside || walked.fixed_u || walked.fixed_v) continue;
    ++tracked;
    EXPECT_NEAR(walked.offset.norm(), project_global(surface, {to}, nullptr).nearest.offset.norm(), 1e-8);
  }
  EXPECT_GT(tracked, 1000);
}

/// The parts of an image that have to do with trims, to be written into.
struct TrimForgery {
  explicit TrimForgery(std::vector<std::byte>& image) : bytes(image) {}
  [[nodiscard]] ImageHeader* header() const { return reinterpret_cast<ImageHeader*>(bytes.data()); }
  template <class T>
  [[nodiscard]] T* at(std::uint64_t offset) const {
    return reinterpret_cast<T*>(bytes.data() + offset);
  }
  [[nodiscard]] ImageTrim* trim() const { return at<ImageTrim>(header()->trims_offset); }
  [[nodiscard]] ImageTrimRun* run() const { return at<ImageTrimRun>(header()->runs_offset); }
  [[nodiscard]] ImageSlab* slab() const { return at<ImageSlab>(header()->slabs_offset); }
  [[nodiscard]] std::uint32_t* slab_trim() const { return at<std::uint32_t>(header()->slab_trims_offset); }
  [[nodiscard]] ImagePatch* patch() const { return at<ImagePatch>(header()->patches_offset); }
  std::vector<std::byte>& bytes;
};

Status status_with_crc(std::vector<std::byte>& bytes, DesignImage& image) {
  const std::uint32_t crc = image_crc(bytes);
  std::memcpy(&bytes[offsetof(ImageHeader, crc32)], &crc, sizeof crc);
  return DesignImage::open(bytes, image);
}

template <class Change>
bool refused_trims(Change change) {
  std::vector<std::byte> bytes = flat_design({plate_with_square_hole()});
  change(TrimForgery(bytes));
  DesignImage image;
  return status_with_crc(bytes, image) == Status::bad_content;
}

TEST(Trim, ContradictoryLoopsAreRefused) {
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.trim()->next = 0xFFFFFFFFU; }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.trim()->next = 2; }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.trim()->previous = 1; }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.trim()->span = 7; }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.trim()->u = -0.1; }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.trim()->v = NAN; }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.trim()->start[1] += 1.0; }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.trim()->bend = -1.0; }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.trim()->third = INFINITY; }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.trim()->joint = 5; }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.trim()->corner = 2; }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.run()->count = 9; }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.run()->first = 1; }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.run()->node = 99; }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.slab()->count -= 1; }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.slab_trim()[0] = 0xFFFFFFFFU; }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { std::swap(f.slab_trim()[0], f.slab_trim()[1]); }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.patch()->slab_count = 0; }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.patch()->first_slab = 1; }));
  EXPECT_TRUE(refused_trims([](TrimForgery f) { f.header()->trims_offset = ~std::uint64_t{7}; }));
}

/// With its CRC made right again a changed byte is refused or does no harm.
TEST(Trim, EveryForgedByteIsRefusedOrHarmless) {
  std::vector<std::byte> bytes = flat_design({plate_with_square_hole()});
  const std::size_t first = TrimForgery(bytes).header()->trims_offset;
  int accepted = 0;
  for (std::size_t k = first; k < bytes.size(); ++k) {
    for (const std::byte pattern : {std::byte{1}, std::byte{0x10}, std::byte{0x80}}) {
      bytes[k] ^= pattern;
      DesignImage image;
      if (status_with_crc(bytes, image) == Status::ok) {
        ++accepted;
        const Surface surface(image);
        const GlobalProjection found = project_global(surface, {Vec3(47, 52, 3), Vec3::Zero(), 5.0}, nullptr);
        EXPECT_TRUE(foot_of(surface, found.nearest, 0.0).point.allFinite());
      }
      bytes[k] ^= pattern;
    }
  }
  EXPECT_GT(accepted, 0);
}

}  // namespace
}  // namespace bladefit::testing

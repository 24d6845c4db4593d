// Small images: the same feet as the fast ones, proven.
#include <gtest/gtest.h>

#include <chrono>

#include "core/geometry/nearest/global_projection.hpp"
#include "tests/support/random_places.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/tools/design_image_reading.hpp"
#include "tools/design/image/image_writer.hpp"
#include "tools/design/load_design.hpp"
#include "tools/design/read_design.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// Bytes of a control point in a file: x, y, z and its weight.
constexpr double kPointBytes = 32;

double bytes_a_point(const std::vector<std::byte>& image, const DesignFile& design) {
  std::size_t points = 0;
  for (const NurbsSurface& surface : design.surfaces) points += surface.control_points.size();
  return static_cast<double>(image.size()) / (kPointBytes * static_cast<double>(points));
}

class CompactImage : public ::testing::TestWithParam<const char*> {};

TEST_P(CompactImage, IsSmallAndHasTheSameFeet) {
  const DesignFile design = read_design(std::filesystem::path(BLADEFIT_TEST_DATA) / GetParam() / "design.igs");
  const std::vector<std::byte> fast = write_image(design.surfaces, design.unit, 1),
                               compact = write_image(design.surfaces, design.unit, 1, ImageSize::compact);
  const DesignImage fast_image = testing::open_image(fast), compact_image = testing::open_image(compact);
  const Surface fast_surface(fast_image), surface(compact_image);
  const double size = testing::image_size(fast_image);
  std::mt19937_64 random(5);
  std::uint64_t pieces = 0, fast_pieces = 0;
  std::uint32_t most = 0;
  constexpr int kPoints = 1000;
  for (int k = 0; k < kPoints; ++k) {
    const SurfacePlace place = testing::random_place(surface, random);
    const double off = 0.02 * size * testing::uniform(random, 0, 1);
    const Vec3 r = surface.evaluate(place).s + off * testing::random_direction_in_space(random);
    const GlobalProjection a = project_global(fast_surface, {r}, nullptr), b = project_global(surface, {r}, nullptr);
    ASSERT_TRUE(a.proven && b.proven);
    EXPECT_NEAR(a.nearest.offset.norm(), b.nearest.offset.norm(), 1e-12 * size);
    if (a.runner_up.margin > 1e-9 * size) {
      EXPECT_LT((a.nearest.at.s - b.nearest.at.s).norm(), 1e-9 * size);
    }
    fast_pieces += a.pieces;
    pieces += b.pieces;
    most = std::max(most, b.pieces);
  }
  std::printf(
      "%s: %zu bytes, %.0f times the control points; compact %zu, %.0f times; pieces a search %.2f, %.2f, at most %u\n",
      GetParam(), fast.size(), bytes_a_point(fast, design), compact.size(), bytes_a_point(compact, design),
      static_cast<double>(fast_pieces) / kPoints, static_cast<double>(pieces) / kPoints, most);
  EXPECT_LE(bytes_a_point(fast, design), 40);
  EXPECT_LE(bytes_a_point(compact, design), 20);
}

INSTANTIATE_TEST_SUITE_P(Of, CompactImage,
                         ::testing::Values("arl_fan", "arl_3patch", "dtmb4119", "pnsy_sub", "pnsy_3patch"));

TEST(CompactDesign, IsNotMadeOfAnImage) {
  const testing::ScratchFolder folder;
  DesignChoice choice(OutwardOption::plus);
  choice.size = ImageSize::compact;
  EXPECT_THROW(load_design(folder.write("a.bfd", "x"), choice), ToolError);
}

}  // namespace
}  // namespace bladefit

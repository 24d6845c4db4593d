// A design image is refused with a reason or harmless, whatever was done to its bytes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/crc32.hpp"
#include "core/geometry/nearest/global_projection.hpp"
#include "tests/support/localizer_fixtures.hpp"
#include "tests/support/made_surface.hpp"
#include "tools/design/image/image_writer.hpp"

namespace bladefit::testing {
namespace {

/// Two small patches, one rational, with several spans and a tree of some depth; nearly flat, so that leaves are few.
const std::vector<std::byte>& small_image() {
  static const std::vector<std::byte> bytes = [] {
    std::vector<NurbsSurface> surfaces{random_surface({2, 2}, {2, 2}, true, 31),
                                       random_surface({1, 1}, {3, 1}, false, 32)};
    for (NurbsSurface& surface : surfaces) {
      for (Eigen::Vector3d& point : surface.control_points) point.z() *= 0.01;
      for (double& weight : surface.weights) weight = 1.0 + 0.01 * weight;
    }
    if (!surfaces.back().weights.empty())
      std::fill(surfaces.back().weights.begin(), surfaces.back().weights.end(), 1.0);
    return write_image(surfaces, DesignUnit::inch, -1);
  }();
  return bytes;
}

Status status_of(std::span<const std::byte> bytes) {
  DesignImage image;
  return DesignImage::open(bytes, image);
}

void mend_crc(std::vector<std::byte>& bytes) {
  const std::uint32_t crc = image_crc(bytes);
  std::memcpy(&bytes[offsetof(ImageHeader, crc32)], &crc, sizeof crc);
}

/// Does with an accepted image what the localizer does. It may give nonsense; it must come back.
void use(const DesignImage& image) {
  const Surface surface(image);
  const GlobalProjection projection = project_global(surface, {Vec3(-500, 40, 30), Vec3::UnitZ(), 0.1}, nullptr);
  const Foot foot = foot_of(surface, projection.nearest, 0.0);
  EXPECT_LT(foot.patch, image.patches().size());
  LocalizerConfig config;
  config.capacity = 8;
  AlignedBlock memory(Localizer::memory_required(config));
  Localizer* localizer = nullptr;
  if (Localizer::create(memory.bytes(), image, config, localizer) != Status::ok) return;
  Verdict verdict;
  for (std::uint32_t k = 1; k <= 2; ++k) {
    const auto x = static_cast<double>(k);
    (void)localizer->push({k, 0, {11.0 * x, 7.0 * x, x}, {}, 0}, verdict);
  }
  (void)localizer->fit();
}

TEST(DesignImage, GoodOneIsAccepted) {
  DesignImage image;
  ASSERT_EQ(DesignImage::open(small_image(), image), Status::ok);
  EXPECT_EQ(image.patches().size(), 2U);
  EXPECT_EQ(image.header().outward, -1);
  EXPECT_EQ(image.header().design_unit, static_cast<std::uint32_t>(DesignUnit::inch));
}

TEST(DesignImage, EveryDamagedByteIsRefused) {
  std::vector<std::byte> bytes = small_image();
  for (std::byte& b : bytes) {
    for (const std::byte pattern : {std::byte{1}, std::byte{0x80}, std::byte{0xFF}}) {
      b ^= pattern;
      EXPECT_LT(static_cast<int>(status_of(bytes)), 0) << "byte " << &b - bytes.data();
      b ^= pattern;
    }
  }
}

/// As above with the CRC made right again, so that the content itself is what must be refused or harmless.
TEST(DesignImage, EveryForgedByteIsRefusedOrHarmless) {
  std::vector<std::byte> bytes = small_image();
  const auto* header = reinterpret_cast<const ImageHeader*>(bytes.data());
  const std::size_t structure = header->coefficients_offset, first_net = structure + 512;
  int accepted = 0;
  for (std::size_t k = 0; k < std::min(first_net, bytes.size()); ++k) {
    for (const int bit : {0, 7}) {
      const std::byte before = bytes[k];
      bytes[k] ^= std::byte{1} << bit;
      mend_crc(bytes);
      DesignImage image;
      if (DesignImage::open(bytes, image) == Status::ok) {
        ++accepted;
        use(image);
      }
      bytes[k] = before;
    }
  }
  EXPECT_GT(accepted, 0);
}

TEST(Crc32, IsThatOfIeee) {
  const std::string text = "123456789";
  EXPECT_EQ(crc32(std::as_bytes(std::span(text))), 0xCBF43926U);
}

/// Taken at once and byte by byte, from any place on.
TEST(Crc32, GoesOnFromAnyPlace) {
  std::mt19937 random(3);
  std::vector<std::byte> bytes(100);
  for (std::byte& b : bytes) b = static_cast<std::byte>(random() & 0xFFU);
  for (std::size_t first = 0; first < 20; ++first) {
    const std::span<const std::byte> part = std::span<const std::byte>(bytes).subspan(first, 70 - 2 * first);
    std::uint32_t one_by_one = 0;
    for (std::size_t k = 0; k < part.size(); ++k) one_by_one = crc32(part.subspan(k, 1), one_by_one);
    EXPECT_EQ(crc32(part), one_by_one);
    EXPECT_EQ(crc32(part.subspan(11), crc32(part.first(11))), one_by_one);
  }
}

TEST(DesignImage, CutOffOrTooLongIsRefused) {
  std::vector<std::byte> bytes = small_image();
  for (std::size_t length = 0; length < bytes.size(); length += length < 400 ? 1 : 97) {
    const std::vector<std::byte> part(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    // An empty vector has no address.
    EXPECT_LT(static_cast<int>(status_of(part)), 0) << length;
  }
  bytes.resize(bytes.size() + 8);
  EXPECT_EQ(status_of(bytes), Status::bad_length);
  bytes.resize(small_image().size() - 8);
  EXPECT_EQ(status_of(bytes), Status::bad_length);
  // The length field agrees with the cut, the CRC too: then the arrays do not fit.
  const std::uint64_t length = bytes.size();
  std::memcpy(&bytes[offsetof(ImageHeader, total_size)], &length, sizeof length);
  mend_crc(bytes);
  EXPECT_EQ(status_of(bytes), Status::bad_content);
}

TEST(DesignImage, NamesWhatIsWrong) {
  EXPECT_EQ(status_of({}), Status::null_argument);
  std::vector<std::byte> bytes = small_image();
  bytes.resize(bytes.size() + 8);
  EXPECT_EQ(status_of({bytes.data() + 1, bytes.size() - 8}), Status::misaligned);
  bytes = small_image();
  bytes[0] = std::byte{'X'};
  EXPECT_EQ(status_of(bytes), Status::bad_magic);
  bytes = small_image();
  bytes[offsetof(ImageHeader, version)] = std::byte{9};
  EXPECT_EQ(status_of(bytes), Status::bad_version);
  bytes = small_image();
  bytes.back() ^= std::byte{1};
  EXPECT_EQ(status_of(bytes), Status::bad_crc);
}

/// The image is left alone when the bytes are refused.
TEST(DesignImage, IsWrittenOnlyWhenAccepted) {
  DesignImage image;
  ASSERT_EQ(DesignImage::open(small_image(), image), Status::ok);
  const ImageHeader* before = &image.header();
  std::vector<std::byte> bytes = small_image();
  bytes.back() ^= std::byte{1};
  EXPECT_EQ(DesignImage::open(bytes, image), Status::bad_crc);
  EXPECT_EQ(&image.header(), before);
}

template <class T>
T* array_at(std::vector<std::byte>& bytes, std::uint64_t ImageHeader::*offset) {
  return reinterpret_cast<T*>(bytes.data() + reinterpret_cast<const ImageHeader*>(bytes.data())->*offset);
}

/// Forgeries by hand, each of which would lead the search astray or out of memory.
TEST(DesignImage, ContradictionsAreRefused) {
  const auto refused = [](auto change) {
    std::vector<std::byte> bytes = small_image();
    change(bytes);
    mend_crc(bytes);
    return status_of(bytes) == Status::bad_content;
  };
  const auto patch = [](auto& b) { return array_at<ImagePatch>(b, &ImageHeader::patches_offset); };
  const auto span = [](auto& b) { return array_at<ImageSpan>(b, &ImageHeader::spans_offset); };
  const auto leaf = [](auto& b) { return array_at<ImageLeaf>(b, &ImageHeader::leaves_offset); };
  const auto node = [](auto& b) { return array_at<ImageNode>(b, &ImageHeader::nodes_offset); };
  const auto last = [](auto& b) -> ImageNode& {
    const auto count = reinterpret_cast<const ImageHeader*>(b.data())->node_count;
    return array_at<ImageNode>(b, &ImageHeader::nodes_offset)[count - 1];
  };
  const auto taylor = [](auto& b) { return array_at<double>(b, &ImageHeader::taylor_offset); };
  const auto number = [](auto& b) { return array_at<double>(b, &ImageHeader::coefficients_offset); };
  const auto header = [](auto& b) { return reinterpret_cast<ImageHeader*>(b.data()); };
  EXPECT_TRUE(refused([&](auto& b) { patch(b)->degree_u = 10; }));
  EXPECT_TRUE(refused([&](auto& b) { patch(b)->degree_v = 0; }));
  EXPECT_TRUE(refused([&](auto& b) { patch(b)->spans_u = 0xFFFFFFFFU; }));
  EXPECT_TRUE(refused([&](auto& b) { patch(b)->first_break_u = 0xFFFFFFFFU; }));
  EXPECT_TRUE(refused([&](auto& b) { patch(b)[1].first_span = 0; }));
  EXPECT_TRUE(refused([&](auto& b) { patch(b)->rational = 0; }));
  EXPECT_TRUE(refused([&](auto& b) { span(b)->patch = 1; }));
  EXPECT_TRUE(refused([&](auto& b) { span(b)->ends = 0; }));
  EXPECT_TRUE(refused([&](auto& b) { span(b)->ends |= 256U; }));
  EXPECT_TRUE(refused([&](auto& b) { span(b)->ends = (span(b)->ends & 15U) | ((~span(b)->ends & 15U) << 4U); }));
  EXPECT_TRUE(refused([&](auto& b) { leaf(b)->node = leaf(b)[1].node; }));
  EXPECT_TRUE(refused([&](auto& b) { leaf(b)->span = 1; }));
  EXPECT_TRUE(refused([&](auto& b) { leaf(b)->s_max = 0.75; }));
  EXPECT_TRUE(refused([&](auto& b) { leaf(b)->t_min = NAN; }));
  EXPECT_TRUE(refused([&](auto& b) { leaf(b)->bounds.middle[1] = INFINITY; }));
  EXPECT_TRUE(refused([&](auto& b) { leaf(b)->bounds.spread[4][2] = -1.0; }));
  EXPECT_TRUE(refused([&](auto& b) { leaf(b)->bounds.self_low[3] = 1e9; }));
  EXPECT_TRUE(refused([&](auto& b) { header(b)->leaves_offset = ~std::uint64_t{7}; }));
  EXPECT_TRUE(refused([&](auto& b) { span(b)->first_coefficient = ~std::uint64_t{0}; }));
  EXPECT_TRUE(refused([&](auto& b) { span(b)->first_coefficient = header(b)->coefficient_count - 4; }));
  EXPECT_TRUE(refused([&](auto& b) { span(b)->cone_cosine = NAN; }));
  EXPECT_TRUE(refused([&](auto& b) { node(b)->child[0] = kNoChild; }));
  EXPECT_TRUE(refused([&](auto& b) { node(b)->child[0] = 0; }));
  EXPECT_TRUE(refused([&](auto& b) { node(b)->child[0] = 0x7FFFFFFFU; }));
  EXPECT_TRUE(refused([&](auto& b) { node(b)->child[0] = kLeafChild; }));
  EXPECT_TRUE(refused([&](auto& b) { last(b).child[0] = kLeafChild | 0x7FFFFFFEU; }));
  EXPECT_TRUE(refused([&](auto& b) { last(b).child[1] = last(b).child[0]; }));
  EXPECT_TRUE(refused([&](auto& b) { last(b).high[0][0] += 1e6F; }));
  EXPECT_TRUE(refused([&](auto& b) { last(b).high[1][0] = last(b).low[1][0]; }));
  EXPECT_TRUE(refused([&](auto& b) { node(b)->low[2][0] = NAN; }));
  EXPECT_TRUE(refused([&](auto& b) { taylor(b)[0] += 1e-6; }));
  EXPECT_TRUE(refused([&](auto& b) { taylor(b)[7] = NAN; }));
  EXPECT_TRUE(refused([&](auto& b) { header(b)->taylor_offset = ~std::uint64_t{7}; }));
  EXPECT_TRUE(refused([&](auto& b) { number(b)[0] = NAN; }));
  EXPECT_TRUE(refused([&](auto& b) { number(b)[0] = 1e6; }));
  EXPECT_TRUE(refused([&](auto& b) { number(b)[3] = 0.0; }));
  EXPECT_TRUE(refused([&](auto& b) { number(b)[3] = -1.0; }));
  EXPECT_TRUE(refused([&](auto& b) { number(b)[3] = INFINITY; }));
  EXPECT_TRUE(refused([&](auto& b) { header(b)->outward = 0; }));
  EXPECT_TRUE(refused([&](auto& b) { header(b)->design_unit = 2; }));
  EXPECT_TRUE(refused([&](auto& b) { header(b)->spare = 1; }));
  EXPECT_TRUE(refused([&](auto& b) { header(b)->nodes_offset = ~std::uint64_t{7}; }));
  EXPECT_TRUE(refused([&](auto& b) { header(b)->coefficient_count = ~std::uint64_t{0}; }));
  EXPECT_TRUE(refused([&](auto& b) { header(b)->patches_offset += 4; }));
  EXPECT_TRUE(refused([&](auto& b) { header(b)->span_count = 0; }));
}

}  // namespace
}  // namespace bladefit::testing

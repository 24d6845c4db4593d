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

void fix_crc(std::vector<std::byte>& bytes) {
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
  const std::size_t structure = header->points_offset, first_net = structure + 512;
  int accepted = 0;
  for (std::size_t k = 0; k < std::min(first_net, bytes.size()); ++k) {
    for (const int bit : {0, 7}) {
      const std::byte before = bytes[k];
      bytes[k] ^= std::byte{1} << bit;
      fix_crc(bytes);
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
  fix_crc(bytes);
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
  for (const std::uint32_t version : {kImageVersion - 1, kImageVersion + 1}) {
    std::memcpy(&bytes[offsetof(ImageHeader, version)], &version, sizeof version);
    EXPECT_EQ(status_of(bytes), Status::bad_version);
  }
  bytes = small_image();
  bytes = small_image();
  std::reverse(bytes.begin() + offsetof(ImageHeader, version), bytes.begin() + offsetof(ImageHeader, version) + 4);
  EXPECT_EQ(status_of(bytes), Status::bad_byte_order);
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

/// The parts of an image, to be written into.
class Parts {
 public:
  explicit Parts(std::vector<std::byte>& bytes) : bytes_(bytes) {}

  [[nodiscard]] ImageHeader* header() const { return reinterpret_cast<ImageHeader*>(bytes_.data()); }
  [[nodiscard]] ImagePatch* patch() const { return at<ImagePatch>(header()->patches_offset); }
  [[nodiscard]] ImageSpan* span() const { return at<ImageSpan>(header()->spans_offset); }
  [[nodiscard]] ImageLeaf* leaf() const { return at<ImageLeaf>(header()->leaves_offset); }
  [[nodiscard]] ImageNode* node() const { return at<ImageNode>(header()->nodes_offset); }
  [[nodiscard]] ImageNode& last_node() const { return node()[header()->node_count - 1]; }
  [[nodiscard]] double* taylor() const { return at<double>(header()->taylor_offset); }
  [[nodiscard]] double* number() const { return at<double>(header()->points_offset); }
  [[nodiscard]] double* share() const { return at<double>(header()->extractions_offset); }

 private:
  template <class T>
  [[nodiscard]] T* at(std::uint64_t offset) const {
    return reinterpret_cast<T*>(bytes_.data() + offset);
  }

  std::vector<std::byte>& bytes_;
};

/// Whether the image is refused for its content after a forgery by hand, its CRC made right again. Each of those below
/// would lead the search astray or out of memory.
template <class Change>
bool refused(Change change) {
  std::vector<std::byte> bytes = small_image();
  change(Parts(bytes));
  fix_crc(bytes);
  return status_of(bytes) == Status::bad_content;
}

TEST(DesignImage, ContradictionsAreRefused) {
  EXPECT_TRUE(refused([](Parts p) { p.patch()->degree_u = 10; }));
  EXPECT_TRUE(refused([](Parts p) { p.patch()->degree_v = 0; }));
  EXPECT_TRUE(refused([](Parts p) { p.patch()->spans_u = 0xFFFFFFFFU; }));
  EXPECT_TRUE(refused([](Parts p) { p.patch()->first_break_u = 0xFFFFFFFFU; }));
  EXPECT_TRUE(refused([](Parts p) { p.patch()[1].first_span = 0; }));
  EXPECT_TRUE(refused([](Parts p) { p.patch()->rational = 0; }));
  EXPECT_TRUE(refused([](Parts p) { p.span()->patch = 1; }));
  EXPECT_TRUE(refused([](Parts p) { p.span()->ends = 0; }));
  EXPECT_TRUE(refused([](Parts p) { p.span()->ends |= 256U; }));
  EXPECT_TRUE(refused([](Parts p) { p.span()->ends = (p.span()->ends & 15U) | ((~p.span()->ends & 15U) << 4U); }));
  EXPECT_TRUE(refused([](Parts p) { p.patch()->points_v = p.patch()->degree_v; }));
  EXPECT_TRUE(refused([](Parts p) { p.patch()->points_v = 0xFFFFFFFFU; }));
  EXPECT_TRUE(refused([](Parts p) { p.patch()->first_extraction_u = 0xFFFFFFFFU; }));
  EXPECT_TRUE(refused([](Parts p) { p.patch()[1].first_extraction_v = p.header()->extraction_count - 1; }));
  EXPECT_TRUE(refused([](Parts p) { p.span()->first_point = 0xFFFFFFFFU; }));
  EXPECT_TRUE(
      refused([](Parts p) { p.span()->first_point = static_cast<std::uint32_t>(p.header()->point_count - 1); }));
  EXPECT_TRUE(refused([](Parts p) { p.span()->first_taylor = 0xFFFFFFFFU; }));
  EXPECT_TRUE(
      refused([](Parts p) { p.span()->first_taylor = static_cast<std::uint32_t>(p.header()->taylor_count / 4 - 1); }));
  EXPECT_TRUE(refused([](Parts p) { p.span()->cone_cosine = NAN; }));
  EXPECT_TRUE(refused([](Parts p) { p.span()->reach[0] = NAN; }));
  EXPECT_TRUE(refused([](Parts p) { p.span()->reach[1] = INFINITY; }));
  EXPECT_TRUE(refused([](Parts p) { p.span()->reach[1] = -1.0F; }));
  EXPECT_TRUE(refused([](Parts p) { p.span()->apart = -1e-9F; }));
  EXPECT_TRUE(refused([](Parts p) { p.span()->inset[0] = p.span()->inset[1] = 128; }));
}

TEST(DesignImage, ContradictoryLeavesAndNodesAreRefused) {
  EXPECT_TRUE(refused([](Parts p) { p.leaf()->node ^= 1U; }));
  EXPECT_TRUE(refused([](Parts p) { p.leaf()->span = 1; }));
  EXPECT_TRUE(refused([](Parts p) { p.leaf()->s_max = 0.75F; }));
  EXPECT_TRUE(refused([](Parts p) { p.leaf()->t_min = NAN; }));
  EXPECT_TRUE(refused([](Parts p) { p.leaf()->bounds.middle[1] = INFINITY; }));
  EXPECT_TRUE(refused([](Parts p) {
    p.leaf()->bounds.spread[4][2] = 0xBF80U; /* -1 */
  }));
  EXPECT_TRUE(refused([](Parts p) {
    p.leaf()->bounds.self_low[3] = 0x4E6EU; /* 1e9 */
  }));
  EXPECT_TRUE(refused([](Parts p) { p.node()->child[0] = kNoChild; }));
  EXPECT_TRUE(refused([](Parts p) { p.node()->child[0] = 0; }));
  EXPECT_TRUE(refused([](Parts p) { p.node()->child[0] = 0x7FFFFFFFU; }));
  EXPECT_TRUE(refused([](Parts p) { p.node()->child[0] = kLeafChild; }));
  EXPECT_TRUE(refused([](Parts p) { p.last_node().child[0] = kLeafChild | 0x7FFFFFFEU; }));
  EXPECT_TRUE(refused([](Parts p) { p.last_node().child[1] = p.last_node().child[0]; }));
  EXPECT_TRUE(refused([](Parts p) { p.last_node().high[0][0] += 1e6F; }));
  EXPECT_TRUE(refused([](Parts p) { p.last_node().high[1][0] = p.last_node().low[1][0]; }));
  EXPECT_TRUE(refused([](Parts p) { p.node()->low[2][0] = NAN; }));
}

TEST(DesignImage, ContradictoryNumbersAreRefused) {
  EXPECT_TRUE(refused([](Parts p) { p.taylor()[0] += 1e-6; }));
  EXPECT_TRUE(refused([](Parts p) { p.share()[0] = NAN; }));
  EXPECT_TRUE(refused([](Parts p) { p.share()[1] += 1e-6; }));
  EXPECT_TRUE(refused([](Parts p) { p.share()[0] += 0.5, p.share()[1] -= 0.5; }));
  EXPECT_TRUE(refused([](Parts p) { p.leaf()->spare = 1; }));
  EXPECT_TRUE(refused([](Parts p) { p.leaf()->bounds.spare = 1; }));
  EXPECT_TRUE(refused([](Parts p) { p.taylor()[7] = NAN; }));
  EXPECT_TRUE(refused([](Parts p) { p.number()[0] = NAN; }));
  EXPECT_TRUE(refused([](Parts p) { p.number()[0] = 1e6; }));
  EXPECT_TRUE(refused([](Parts p) { p.number()[3] = 0.0; }));
  EXPECT_TRUE(refused([](Parts p) { p.number()[3] = -1.0; }));
  EXPECT_TRUE(refused([](Parts p) { p.number()[3] = INFINITY; }));
}

TEST(DesignImage, ContradictoryHeadersAreRefused) {
  EXPECT_TRUE(refused([](Parts p) { p.header()->leaves_offset = ~std::uint64_t{7}; }));
  EXPECT_TRUE(refused([](Parts p) { p.header()->taylor_offset = ~std::uint64_t{7}; }));
  EXPECT_TRUE(refused([](Parts p) { p.header()->outward = 0; }));
  EXPECT_TRUE(refused([](Parts p) { p.header()->design_unit = 2; }));
  EXPECT_TRUE(refused([](Parts p) { p.header()->extractions_offset = ~std::uint64_t{7}; }));
  EXPECT_TRUE(refused([](Parts p) { p.header()->extraction_count = 0; }));
  EXPECT_TRUE(refused([](Parts p) { p.header()->nodes_offset = ~std::uint64_t{7}; }));
  EXPECT_TRUE(refused([](Parts p) { p.header()->point_count = ~std::uint64_t{0}; }));
  EXPECT_TRUE(refused([](Parts p) { p.header()->patches_offset += 4; }));
  EXPECT_TRUE(refused([](Parts p) { p.header()->span_count = 0; }));
}

}  // namespace
}  // namespace bladefit::testing

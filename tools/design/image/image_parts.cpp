#include "tools/design/image/image_parts.hpp"

#include <algorithm>
#include <cstring>

namespace bladefit {
namespace {

ImageHeader layout_of(const ImageParts& parts) {
  ImageHeader header{};
  header.patch_count = static_cast<std::uint32_t>(parts.patches.size());
  header.span_count = static_cast<std::uint32_t>(parts.spans.size());
  header.leaf_count = static_cast<std::uint32_t>(parts.leaves.size());
  header.node_count = static_cast<std::uint32_t>(parts.nodes.size());
  header.break_count = static_cast<std::uint32_t>(parts.breaks.size());
  header.point_count = parts.points.size() / 4;
  header.extraction_count = static_cast<std::uint32_t>(parts.extractions.size());
  header.taylor_count = parts.taylor.size();
  header.trim_count = static_cast<std::uint32_t>(parts.trims.pieces.size());
  header.run_count = static_cast<std::uint32_t>(parts.trims.runs.size());
  header.slab_count = static_cast<std::uint32_t>(parts.trims.slabs.size());
  header.slab_trim_count = static_cast<std::uint32_t>(parts.trims.slab_trims.size());
  std::uint64_t end = sizeof(ImageHeader);
  const auto place = [&end](const auto& array) {
    const std::uint64_t offset = end;
    end += (array.size() * sizeof(array[0]) + 7) / 8 * 8;
    return offset;
  };
  header.patches_offset = place(parts.patches);
  header.spans_offset = place(parts.spans);
  header.leaves_offset = place(parts.leaves);
  header.nodes_offset = place(parts.nodes);
  header.breaks_offset = place(parts.breaks);
  header.points_offset = place(parts.points);
  header.extractions_offset = place(parts.extractions);
  header.taylor_offset = place(parts.taylor);
  header.trims_offset = place(parts.trims.pieces);
  header.runs_offset = place(parts.trims.runs);
  header.slabs_offset = place(parts.trims.slabs);
  header.slab_trims_offset = place(parts.trims.slab_trims);
  header.total_size = end;
  return header;
}

template <class Element>
void copy_array(const std::vector<Element>& array, std::uint64_t offset, std::vector<std::byte>& image) {
  if (!array.empty()) std::memcpy(image.data() + offset, array.data(), array.size() * sizeof(Element));
}

}  // namespace

std::uint64_t size_of(const ImageParts& parts) { return layout_of(parts).total_size; }

std::vector<std::byte> assembled(const ImageParts& parts, DesignUnit unit, int outward, const Box& box) {
  ImageHeader header = layout_of(parts);
  std::memcpy(header.magic, kImageMagic, sizeof kImageMagic);
  header.version = kImageVersion;
  header.design_unit = static_cast<std::uint32_t>(unit);
  header.outward = outward;
  std::copy_n(box.min, 3, header.box_min);
  std::copy_n(box.max, 3, header.box_max);
  std::vector<std::byte> image(header.total_size);
  std::memcpy(image.data(), &header, sizeof header);
  copy_array(parts.patches, header.patches_offset, image);
  copy_array(parts.spans, header.spans_offset, image);
  copy_array(parts.leaves, header.leaves_offset, image);
  copy_array(parts.nodes, header.nodes_offset, image);
  copy_array(parts.breaks, header.breaks_offset, image);
  copy_array(parts.points, header.points_offset, image);
  copy_array(parts.extractions, header.extractions_offset, image);
  copy_array(parts.taylor, header.taylor_offset, image);
  copy_array(parts.trims.pieces, header.trims_offset, image);
  copy_array(parts.trims.runs, header.runs_offset, image);
  copy_array(parts.trims.slabs, header.slabs_offset, image);
  copy_array(parts.trims.slab_trims, header.slab_trims_offset, image);
  return image;
}

}  // namespace bladefit

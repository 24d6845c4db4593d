#include "tools/design/image/reach.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <future>
#include <limits>
#include <thread>

#include "tools/design/image/image_writer.hpp"
#include "tools/design/image/span_reach.hpp"

namespace bladefit {
namespace {

float rounded_down(double x) {
  const auto rounded = static_cast<float>(x);
  return static_cast<double>(rounded) > x ? std::nextafter(rounded, 0.0F) : rounded;
}

}  // namespace

void mark_reach(std::vector<std::byte>& image, const std::function<void(std::uint32_t done, std::size_t spans)>& tell) {
  const DesignImage opened = open_new_image(image);
  const Surface surface(opened);
  const ReachDesign design(surface);
  std::vector<ImageSpan> spans(opened.spans().begin(), opened.spans().end());
  std::atomic<std::uint32_t> next{0};
  const auto work = [&](bool tells) {
    PartCache parts(surface);
    for (std::uint32_t k = next++; k < spans.size(); k = next++) {
      if (tells) tell(k, spans.size());
      const SpanReach proven = prove_reach(design, parts, k);
      for (std::size_t side = 0; side < 2; ++side) spans[k].reach[side] = rounded_down(proven.reach[side]);
      spans[k].apart = rounded_down(proven.apart);
      std::copy(proven.inset.begin(), proven.inset.end(), spans[k].inset);
    }
  };
  std::vector<std::future<void>> others;
  for (unsigned k = 1; k < std::thread::hardware_concurrency(); ++k)
    others.push_back(std::async(std::launch::async, work, false));
  work(tell != nullptr);
  for (std::future<void>& other : others) other.get();
  std::memcpy(image.data() + opened.header().spans_offset, spans.data(), spans.size() * sizeof(ImageSpan));
  seal_image(image);
}

}  // namespace bladefit

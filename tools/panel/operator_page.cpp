#include "tools/panel/operator_page.hpp"

#include <algorithm>

#include "tools/panel/defect_rows.hpp"
#include "tools/panel/edge_strip.hpp"
#include "tools/panel/page.hpp"
#include "tools/panel/progress_lines.hpp"
#include "tools/panel/trouble_lines.hpp"
#include "tools/panel/verdict_lines.hpp"

namespace bladefit {
namespace {

constexpr int kEssential = 3;         ///< what is less important than that gives its lines to defects
constexpr int kLeastDefectLines = 3;  ///< the heading, the worst, how many more

/// Where there is room what belongs together stands apart from the rest.
void put_space(Page& page) {
  page.group(6);
  page.put(page.line());
}

}  // namespace

std::vector<std::string> operator_page(const ScreenView& view, int width, int height) {
  Page page(view, width);
  page.group(0);
  put_heading(view, page);
  put_verdict(view, page, height);
  put_trouble(view, page, height);
  put_space(page);
  put_progress(view, page);
  put_space(page);
  put_edge_strip(view, page);
  put_space(page);
  const int room = height - 1 - static_cast<int>(page.count(kEssential));
  put_defects(view, page, std::max(room, kLeastDefectLines));
  page.group(0);
  put_keys(view, page);
  return page.take(height, true);
}

}  // namespace bladefit

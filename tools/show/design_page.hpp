#pragma once
#include <string>

#include "tools/show/page_content.hpp"

namespace bladefit {

/// One HTML page that shows `content` in three dimensions and asks for no other file: the grids as single-precision
/// numbers about the middle of the design, normals as bytes.
[[nodiscard]] std::string design_page(const PageContent& content);

}  // namespace bladefit

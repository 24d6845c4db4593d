#pragma once
#include <string_view>

namespace bladefit {

/// page.html, and page.js with view.js before it, as they were when the program was built.
[[nodiscard]] std::string_view page_text();
[[nodiscard]] std::string_view page_script();

}  // namespace bladefit

// Compiles a design of tests/data for the tests that open it.
//   compile_design CASE FILE.bfd        CASE is the name of a case, or arl_3patch_gap

#include <exception>
#include <iostream>
#include <string>

#include "tests/support/compile_case.hpp"
#include "tests/support/reference_design.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/design/image/image_writer.hpp"
#include "tools/design/image/reach.hpp"
#include "tools/design/read_design.hpp"

namespace bladefit::testing {
namespace {

/// The design of a case, its middle patch moved by kGapMm.
std::vector<std::byte> with_gap(const ReferenceCase& c) {
  DesignFile file = read_design(c.folder / "design.igs");
  for (Eigen::Vector3d& point : file.surfaces.at(1).control_points) point += kGapMm * Eigen::Vector3d(0.6, 0.0, 0.8);
  return write_image(file.surfaces, file.unit, c.normal_sign);
}

std::vector<std::byte> image_of(const std::string& name) {
  return name == "arl_3patch_gap" ? with_gap(read_case("arl_3patch")) : compile_case(read_case(name));
}

}  // namespace
}  // namespace bladefit::testing

int main(int count, char** words) try {
  if (count != 3) return 2;
  std::vector<std::byte> image = bladefit::testing::image_of(words[1]);
  bladefit::mark_reach(image);
  bladefit::testing::write_whole(words[2], {reinterpret_cast<const char*>(image.data()), image.size()});
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}

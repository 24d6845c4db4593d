#pragma once
#include <memory>
#include <string>
#include <vector>

#include "tests/bench/peers/peer.hpp"
#include "tests/bench/peers/textbook_surface.hpp"
#include "tests/bench/table.hpp"
#include "tests/support/localizer_fixtures.hpp"

namespace bladefit::bench {

/// A design of tests/data with the peers on it.
struct BenchDesign {
  explicit BenchDesign(const std::string& name);

  testing::ReferenceCase reference;
  const testing::CompiledDesign& design;
  UnitSurface surface;
  TextbookSurface textbook;  ///< by which answers are checked
  std::vector<Peer> peers;
};

/// A fit with its solutions.
struct FitCase {
  std::string name;
  std::vector<ProbePoint> probes;
  LocalizerConfig config;
  FitProblem problem;  ///< the same, with the places of the design that the points were meant to touch as feet
  /// Solution of least squares; where `known` is false it is the best that the solvers found.
  Pose least_squares;
  double tolerance_mm = 0;  ///< value of min_tolerance; 0: the best that the solvers found
  bool known = true;
};

/// The whole of a case, with the solutions of its truth file.
FitCase measured_case(const BenchDesign& design, const std::string& name);

/// `count` points all over the design with smooth form error and noise, 2 to 5 mm away from where they belong. Seeded.
FitCase made_case(const BenchDesign& design, const std::string& name, std::size_t count);

/// `problem` at another start pose, with its feet there and the weights that follow from them.
FitProblem at_pose(const BenchDesign& design, const FitCase& fit, const Pose& pose);

/// The tasks. Each checks every answer and says on stderr what it is at.
std::vector<Row> nearest_rows(const BenchDesign& design);
std::vector<Row> fit_rows(const BenchDesign& design, FitCase fit);
std::vector<Row> push_rows(const BenchDesign& design, const FitCase& fit);

}  // namespace bladefit::bench

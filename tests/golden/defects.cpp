// Fits random patterns of defects on every design of tests/data in every mode beside least squares, with and without
// probing directions, in batch and as a stream, and counts what was answered. It takes minutes and is run by hand:
//   golden_defects [--first SEED] [--count PATTERNS] [--case NAME] [--mode NAME] [--way batch|stream] [--list]
//   [--second]
// Pattern number k is on design k mod 8. Exit code 1: a fit was not answered, was wrong or took more than 3 s.
// --second: each optimum is also looked for by another solver, and is wrong where that finds a better one.

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <string>

#include "tests/golden/second_solver.hpp"
#include "tests/support/defect_fits.hpp"

namespace bladefit::testing {
namespace {

constexpr double kMostSeconds = 3.0;
constexpr FitMode kModes[] = {FitMode::minimax, FitMode::range, FitMode::min_tolerance, FitMode::constrained};

struct Wanted {
  std::uint64_t first = 0, count = 80;
  std::string design, mode, way;
  bool list = false, second = false;
};

/// A design with the points that are made defective.
struct Source {
  ReferenceCase c;
  std::string subset;
  std::unique_ptr<DefectPatterns> patterns;
};

struct Tally {
  int fits = 0, converged = 0, infeasible = 0, unanswered = 0, wrong = 0, slow = 0;
  double longest_s = 0, total_s = 0;
};

class Experiment {
 public:
  explicit Experiment(Wanted wanted) : wanted_(std::move(wanted)) {
    for (const std::string& name : reference_case_names()) {
      add(name, "full");
      if (name == "arl_fan" || name == "pnsy_sub") add(name, "all");
    }
  }

  int run() {
    for (std::uint64_t k = wanted_.first; k < wanted_.first + wanted_.count; ++k) {
      const Source& source = *sources_[k % sources_.size()];
      if (wanted_.design.empty() || wanted_.design == source.c.name) run(source, k);
    }
    Tally all;
    for (const auto& [name, t] : tallies_) {
      print(name, t);
      all.fits += t.fits;
      all.converged += t.converged;
      all.infeasible += t.infeasible;
      all.unanswered += t.unanswered;
      all.wrong += t.wrong;
      all.slow += t.slow;
      all.longest_s = std::max(all.longest_s, t.longest_s);
      all.total_s += t.total_s;
    }
    print("all", all);
    return all.unanswered + all.wrong + all.slow > 0 ? 1 : 0;
  }

 private:
  void add(const std::string& name, const std::string& subset) {
    sources_.push_back(std::make_unique<Source>(Source{read_case(name), subset, nullptr}));
    Source& source = *sources_.back();
    source.patterns = std::make_unique<DefectPatterns>(source.c, subset);
  }

  void run(const Source& source, std::uint64_t seed) {
    const DefectPattern pattern = source.patterns->make(seed);
    for (const FitMode mode : kModes) {
      if (!wanted_.mode.empty() && wanted_.mode != word_of(mode)) continue;
      for (const bool directed : {true, false}) {
        LocalizerConfig config = config_of(source.c, pattern.points.size());
        config.mode = mode;
        config.use_approach = directed;
        config.edges = source.subset == "all" ? EdgePolicy::use : EdgePolicy::skip;
        config.tolerance.leading_edge_mm = pattern.leading_edge_mm;
        config.tolerance.rest_mm = pattern.rest_mm;
        for (const WayIn way : {WayIn::batch, WayIn::stream}) {
          const std::string name = way == WayIn::batch ? "batch" : "stream";
          if (!wanted_.way.empty() && wanted_.way != name) continue;
          DefectFit fit = fit_defects(reference_design(source.c.name), config, pattern.points, way);
          if (wanted_.second && fit.report.status == FitStatus::converged) compare(source, config, fit);
          count(source, seed, pattern, std::string(word_of(mode)) + (directed ? " directed " : " free ") + name, fit);
        }
      }
    }
  }

  /// The other solver, from the least-squares pose, with the bounds that the fit has given the points.
  static void compare(const Source& source, const LocalizerConfig& config, DefectFit& fit) {
    const CompiledDesign& design = reference_design(source.c.name);
    const SecondOptimum second = solve_again(ModeValue(design, config, fit.counted), fit.weights, fit.least_squares);
    std::printf("    %.9g; by the second solver %.9g\n", fit.value, second.value);
    if (fit.value > second.value * (1.0 + 1e-6) + 1e-9 * design.size())
      fit.complaint += " the second solver finds better";
  }

  void count(const Source& source, std::uint64_t seed, const DefectPattern& pattern, const std::string& kind,
             const DefectFit& fit) {
    Tally& t = tallies_[kind];
    ++t.fits;
    if (fit.report.status == FitStatus::converged) ++t.converged;
    if (fit.report.status == FitStatus::infeasible) ++t.infeasible;
    if (!fit.answered()) ++t.unanswered;
    if (!fit.complaint.empty()) ++t.wrong;
    if (fit.refine_s > kMostSeconds) ++t.slow;
    t.longest_s = std::max(t.longest_s, fit.refine_s);
    t.total_s += fit.refine_s;
    const bool well = fit.answered() && fit.complaint.empty() && fit.refine_s <= kMostSeconds;
    if (well && !wanted_.list) return;
    std::printf(
        "%3llu %-12s %-4s %-30s %s status %d %s held %u value %.9g (%.9g) searches %u unproven %u %.3f + %.3f s %s | "
        "%s\n",
        static_cast<unsigned long long>(seed), source.c.name.c_str(), source.subset.c_str(), kind.c_str(),
        fit.answered() ? "answered  " : "UNANSWERED", static_cast<int>(fit.report.status),
        std::string(word_of(fit.report.ended)).c_str(), fit.report.held_feet, fit.value, fit.least_squares_value,
        fit.report.searches, fit.report.unproven, fit.push_s, fit.refine_s, fit.complaint.c_str(),
        pattern.text.c_str());
    std::fflush(stdout);
  }

  static void print(const std::string& name, const Tally& t) {
    std::printf(
        "%-32s %5d fits: %5d converged, %4d infeasible, %4d unanswered, %4d wrong, %3d slow; longest %.2f s, mean %.3f "
        "s\n",
        name.c_str(), t.fits, t.converged, t.infeasible, t.unanswered, t.wrong, t.slow, t.longest_s,
        t.fits > 0 ? t.total_s / t.fits : 0.0);
  }

  Wanted wanted_;
  std::vector<std::unique_ptr<Source>> sources_;
  std::map<std::string, Tally> tallies_;
};

Wanted wanted_of(int count, char** words) {
  Wanted wanted;
  for (int k = 1; k < count; ++k) {
    const std::string word = words[k], value = k + 1 < count ? words[k + 1] : "";
    if (word == "--list" || word == "--second") {
      (word == "--list" ? wanted.list : wanted.second) = true;
      continue;
    }
    ++k;
    if (word == "--first") wanted.first = std::stoull(value);
    if (word == "--count") wanted.count = std::stoull(value);
    if (word == "--case") wanted.design = value;
    if (word == "--mode") wanted.mode = value;
    if (word == "--way") wanted.way = value;
  }
  return wanted;
}

}  // namespace
}  // namespace bladefit::testing

int main(int count, char** words) {
  using namespace bladefit::testing;
  return Experiment(wanted_of(count, words)).run();
}

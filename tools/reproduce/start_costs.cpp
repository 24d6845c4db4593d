#include "tools/reproduce/start_costs.hpp"

#include <algorithm>
#include <array>

#include "tools/batch/batch_fit.hpp"

namespace bladefit {
namespace {

/// The shortest time of so many fits is told.
constexpr int kRepeats = 3;

/// In the order of the table.
constexpr std::array kWays = {FootStarts::searched, FootStarts::curves, FootStarts::neighbour, FootStarts::global};

BatchFit quickest_fit(const StudyCase& study, FitPlan plan, const std::vector<ProbePoint>& points, FootStarts starts) {
  plan.starts = starts;
  BatchFit best = fit_points(study.design, plan, points, study.name);
  for (int k = 1; k < kRepeats; ++k) {
    const BatchFit again = fit_points(study.design, plan, points, study.name);
    best.fit.cpu_s = std::min(best.fit.cpu_s, again.fit.cpu_s);
    best.proof.cpu_s = std::min(best.proof.cpu_s, again.proof.cpu_s);
  }
  return best;
}

}  // namespace

ReportTable start_cost_table() {
  ReportTable table;
  table.title = "Cost of an unconstrained fit by how the first foot of each point is found (localize --starts)";
  table.head = "Data";
  table.columns = {{"points", "Points", "", Figure::count},
                   {"fit_cpu_s", "Fit", "(CPU)", Figure::time},
                   {"fit_searches", "Global", "Searches", Figure::count},
                   {"wrong_starts", "Wrong", "First Feet", Figure::count},
                   {"proof_cpu_s", "Proof of", "Starts (CPU)", Figure::time},
                   {"proof_searches", "Its Global", "Searches", Figure::count},
                   {"rms_after", "RMS Distance", "After (in)", Figure::length}};
  table.notes.emplace_back(
      "curves: the foot of a cubic through each pass, followed along it (thesis 5.3); neighbour: Newton's method from "
      "the point before; global: branch and bound without a hint; default: from the point before, then a search. A "
      "fit ends with a search for every foot at its optimum.");
  table.notes.emplace_back(
      "First feet that were only tracked are proven by a search afterwards, since distances before the fit are told. "
      "Where one was wrong the fit is made again from searched feet, and the proof contains that fit.");
  return table;
}

void add_start_costs(const StudyCase& study, const std::string& subset, ReportTable& table) {
  const std::vector<ProbePoint> points = read_subset_points(study, subset);
  for (const FootStarts starts : kWays) {
    const BatchFit fit = quickest_fit(study, study.plan, points, starts);
    table.rows.push_back(
        {study.name + " " + subset,
         std::string(kFootStartsWords[static_cast<std::size_t>(starts)]),
         study.name,
         subset,
         {static_cast<double>(points.size()), fit.fit.cpu_s, static_cast<double>(fit.fit.searches),
          static_cast<double>(fit.wrong_starts), fit.proof.cpu_s, static_cast<double>(fit.proof.searches),
          fit.result.all.rms_after / study.plan.mm_per_unit}});
  }
}

}  // namespace bladefit

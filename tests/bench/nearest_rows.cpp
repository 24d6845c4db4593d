// Nearest points: warm from a neighbouring foot, and cold over the whole design.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/geometry/nearest/global_projection.hpp"
#include "core/geometry/nearest/lane_projection.hpp"
#include "tests/bench/bench_case.hpp"
#include "tests/support/json_file.hpp"

namespace bladefit::bench {
namespace {

/// A foot found warm may be off by this; one found cold may be farther than the nearest by this [mm].
constexpr double kFootLimit = 1e-7, kMissLimit = 1e-9;
constexpr std::size_t kColdQueries = 200;
constexpr double kUnknown = std::numeric_limits<double>::infinity();

struct Query {
  Vec3 r;
  Parameters guess;
};

/// One solver's answers to all queries.
struct Answers {
  std::string name;
  std::vector<Parameters> feet;
  std::function<void(std::vector<Parameters>&)> find;
};

std::vector<Timing> timed(std::vector<Answers>& solvers, std::size_t queries, const Effort& effort) {
  std::vector<Contestant> contestants;
  for (Answers& solver : solvers) {
    solver.feet.resize(queries);
    contestants.push_back({solver.name, {}, [&solver] { solver.find(solver.feet); }});
  }
  return timed_in_turn(contestants, effort);
}

Row named_row(const BenchDesign& design, const Answers& solver, const Timing& timing, const Timing& base) {
  Row row = row_of(timing, base, static_cast<double>(solver.feet.size()));
  row.design = design.reference.name;
  row.solver = solver.name;
  row.count = solver.feet.size();
  row.misses = 0;
  return row;
}

double distance(const BenchDesign& design, const Vec3& r, const Parameters& foot) {
  return (Eigen::Vector3d(r) - design.textbook.evaluate(foot).s).norm();
}

/// Measured points moved by 1e-3 mm from where their feet are known, as after a small motion of the pose.
std::vector<Query> warm_queries(const FitProblem& problem) {
  std::vector<Query> queries;
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    queries.push_back({problem.points[k] + Vec3(6e-4, -6e-4, 5e-4), problem.feet[k]});
  }
  return queries;
}

/// The next feet at once, as sweeps over stored points find them.
void find_four(const Surface& surface, const std::vector<Query>& queries, const std::vector<SurfacePlace>& places,
               std::size_t first, std::vector<Parameters>& feet) {
  LaneProjections lanes;
  const std::size_t end = std::min(queries.size(), first + kLanes);
  for (std::size_t k = first; k < end; ++k) lanes.enter(surface, queries[k].r, places[k]);
  lanes.find(surface);
  for (std::size_t k = first; k < end; ++k) {
    const auto lane = static_cast<std::uint32_t>(k - first);
    SurfacePlace place = lanes.place(lane);
    if (!lanes.found(lane)) place = project_local(surface, queries[k].r, places[k]).place;
    feet[k] = {place.u, place.v};
  }
}

std::vector<Answers> warm_solvers(const BenchDesign& design, const std::vector<Query>& queries,
                                  const std::vector<SurfacePlace>& places) {
  std::vector<Answers> solvers;
  solvers.push_back({"bladefit", {}, [&](std::vector<Parameters>& feet) {
                       for (std::size_t k = 0; k < queries.size(); ++k) {
                         const Projection found = project_local(design.design.surface(), queries[k].r, places[k]);
                         feet[k] = {found.place.u, found.place.v};
                       }
                     }});
  solvers.push_back({"bladefit, four at a time", {}, [&](std::vector<Parameters>& feet) {
                       for (std::size_t first = 0; first < queries.size(); first += kLanes) {
                         find_four(design.design.surface(), queries, places, first, feet);
                       }
                     }});
  for (const Peer& peer : design.peers) {
    if (!peer.nearest_local) continue;
    solvers.push_back({peer.name, {}, [&](std::vector<Parameters>& feet) {
                         for (std::size_t k = 0; k < queries.size(); ++k) {
                           feet[k] = peer.nearest_local(queries[k].r, queries[k].guess);
                         }
                       }});
  }
  return solvers;
}

std::vector<Row> warm_rows(const BenchDesign& design, const FitProblem& problem) {
  std::fprintf(stderr, "  nearest point, warm\n");
  const std::vector<Query> queries = warm_queries(problem);
  std::vector<SurfacePlace> places;
  for (const Query& query : queries) {
    places.push_back(design.design.surface().place_at(0, query.guess.u, query.guess.v));
  }
  std::vector<Answers> solvers = warm_solvers(design, queries, places);
  const std::vector<Timing> timings = timed(solvers, queries.size(), {60, 5, 0.5});
  std::vector<Row> rows;
  for (std::size_t s = 0; s < solvers.size(); ++s) {
    Row row = named_row(design, solvers[s], timings[s], timings[0]);
    row.task = "nearest point, warm";
    for (std::size_t k = 0; k < queries.size(); ++k) {
      const Parameters best = design.textbook.foot(queries[k].r, queries[k].guess, 0.0);
      const double apart = (design.textbook.evaluate(solvers[s].feet[k]).s - design.textbook.evaluate(best).s).norm();
      row.error_mm = std::max(row.error_mm, apart);
      if (!(apart <= kFootLimit)) ++row.misses;
    }
    row.wrong = row.misses > 0;
    rows.push_back(row);
  }
  return rows;
}

/// All feet by bladefit's global search; `hints`: from these, or from nothing where there are none.
void search_all(const BenchDesign& design, const std::vector<Vec3>& queries, const std::vector<Projection>& hints,
                std::vector<Parameters>& feet) {
  for (std::size_t k = 0; k < queries.size(); ++k) {
    ProjectionQuery query;
    query.point = queries[k];
    const Projection* hint = hints.empty() ? nullptr : &hints[k];
    const GlobalProjection found = project_global(design.design.surface(), query, hint);
    // What is not proven is no answer.
    feet[k] = {found.proven ? found.nearest.place.u : kUnknown, found.nearest.place.v};
  }
}

std::vector<Answers> cold_solvers(const BenchDesign& design, const std::vector<Vec3>& queries) {
  std::vector<Projection> hints;
  for (const Vec3& r : queries) {
    ProjectionQuery query;
    query.point = r;
    hints.push_back(project_global(design.design.surface(), query, nullptr).nearest);
  }
  std::vector<Answers> solvers;
  solvers.push_back({"bladefit", {}, [&](std::vector<Parameters>& feet) { search_all(design, queries, {}, feet); }});
  solvers.push_back(
      {"bladefit, its own foot as the hint", {}, [&design, &queries, hints](std::vector<Parameters>& feet) {
         search_all(design, queries, hints, feet);
       }});
  for (const Peer& peer : design.peers) {
    if (!peer.nearest_global) continue;
    solvers.push_back({peer.name, {}, [&](std::vector<Parameters>& feet) {
                         for (std::size_t k = 0; k < queries.size(); ++k) feet[k] = peer.nearest_global(queries[k]);
                       }});
  }
  return solvers;
}

/// `best` holds distances that are known already, or infinity.
std::vector<Row> cold_rows(const BenchDesign& design, const char* task, const std::vector<Vec3>& queries,
                           std::vector<double> best) {
  std::fprintf(stderr, "  %s\n", task);
  std::vector<Answers> solvers = cold_solvers(design, queries);
  const std::vector<Timing> timings = timed(solvers, queries.size(), {40, 2, 0.5});
  for (const Answers& solver : solvers) {
    for (std::size_t k = 0; k < queries.size(); ++k) {
      best[k] = std::fmin(best[k], distance(design, queries[k], solver.feet[k]));
    }
  }
  std::vector<Row> rows;
  for (std::size_t s = 0; s < solvers.size(); ++s) {
    Row row = named_row(design, solvers[s], timings[s], timings[0]);
    row.task = task;
    for (std::size_t k = 0; k < queries.size(); ++k) {
      const double excess = distance(design, queries[k], solvers[s].feet[k]) - best[k];
      row.error_mm = std::max(row.error_mm, excess);
      if (!(excess <= kMissLimit)) ++row.misses;
    }
    row.wrong = row.misses > 0;
    rows.push_back(row);
  }
  return rows;
}

/// Measured points at the start pose, evenly taken; with the distances of the truth file where it has those.
std::vector<Row> cold_measured_rows(const BenchDesign& design, const FitProblem& problem) {
  const testing::ReferenceCase& c = design.reference;
  const nlohmann::json truth = testing::read_json(c.folder / "truth" / "full.json");
  const nlohmann::json& known = truth.at("before").at("points").at("distance");
  std::vector<Vec3> queries;
  std::vector<double> best;
  for (std::size_t q = 0; q < kColdQueries; ++q) {
    const std::size_t k = q * problem.points.size() / kColdQueries;
    queries.push_back(problem.points[k]);
    best.push_back(c.use_approach ? kUnknown : std::abs(known.at(k).get<double>()) * c.mm_per_unit);
  }
  return cold_rows(design, "nearest point, cold", queries, best);
}

/// Points 5 to 50 mm off the blade whose nearest point is not on its border: there not every peer looks.
std::vector<Row> cold_far_rows(const BenchDesign& design) {
  std::mt19937_64 random(7);
  std::vector<Vec3> queries;
  while (queries.size() < kColdQueries) {
    const SurfacePlace place = testing::random_place(design.design.surface(), random);
    const SurfacePoint at = design.design.surface().evaluate(place);
    ProjectionQuery query;
    query.point = at.s + testing::uniform(random, 5.0, 50.0) * design.design.surface().normal(place, at);
    const Projection foot = project_global(design.design.surface(), query, nullptr).nearest;
    if (!foot.fixed_u && !foot.fixed_v) queries.push_back(query.point);
  }
  return cold_rows(design, "nearest point, cold, 5-50 mm off", queries, std::vector<double>(kColdQueries, kUnknown));
}

}  // namespace

std::vector<Row> nearest_rows(const BenchDesign& design) {
  const FitProblem problem = measured_case(design, design.reference.name).problem;
  FitCase nearest;  // without approach vectors: all peers answer the same question
  nearest.problem.points = problem.points;
  const FitProblem start = at_pose(design, nearest, Pose());
  std::vector<Row> rows = warm_rows(design, start);
  for (const std::vector<Row>& more : {cold_measured_rows(design, start), cold_far_rows(design)}) {
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return rows;
}

}  // namespace bladefit::bench

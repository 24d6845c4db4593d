#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/fit/pose.hpp"
#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit::bench {

/// Normalised parameters of a point of the design; the designs compared on have one patch.
struct Parameters {
  double u = 0, v = 0;
};

/// Points to be brought to a design by a rigid motion r = C R + t. Every point counts, with the foot that is nearest
/// (with an approach vector: the nearest whose outward normal faces the probe).
struct FitProblem {
  std::vector<Vec3> points;      ///< R [mm]
  std::vector<Vec3> approaches;  ///< unit vectors from the probe to the material, one a point; empty: not used
  std::vector<Parameters> feet;  ///< next to which the points have their feet; empty: not known, and to be found
  std::vector<double> weights;   ///< of min_tolerance: 1 at the leading edge, the ratio of the tolerances elsewhere
  Pose start;
};

/// What a solver can do. An empty function: it does not do that.
/// To add a peer: a file beside this one that makes such a record, a line below, and one in all_peers().
struct Peer {
  std::string name;
  /// The foot of r [mm] next to `guess`, whose point of the surface is within 1e-3 mm of it.
  std::function<Parameters(const Vec3& r, const Parameters& guess)> nearest_local;
  /// The point of the whole design nearest to r [mm].
  std::function<Parameters(const Vec3& r)> nearest_global;
  /// The pose with the least sum of squared distances.
  std::function<Pose(const FitProblem& problem)> least_squares;
  /// The pose with the least max |d| / w. `start` is the least-squares pose, and `feet` are known.
  std::function<Pose(const FitProblem& problem)> min_tolerance;
};

/// A surface whose knots run from 0 to 1 in both directions, and of which all is used.
using UnitSurface = NurbsSurface;

/// Peers on one surface. `outward`: +1 or -1, outward normal = outward * (Su x Sv).
std::vector<Peer> textbook_peers(const UnitSurface& surface, int outward);
std::vector<Peer> opencascade_peers(const UnitSurface& surface);
std::vector<Peer> sisl_peers(const UnitSurface& surface);
std::vector<Peer> ceres_peers(const UnitSurface& surface, int outward);
std::vector<Peer> nlopt_peers(const UnitSurface& surface, int outward);
std::vector<Peer> ipopt_peers(const UnitSurface& surface, int outward);

/// All of them.
std::vector<Peer> all_peers(const UnitSurface& surface, int outward);

}  // namespace bladefit::bench

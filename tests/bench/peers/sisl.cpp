// SISL (SINTEF): s1775, Newton's method from a guess, and s1954, the closest points by recursive subdivision.

#include <sisl.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "tests/bench/peers/peer.hpp"

namespace bladefit::bench {
namespace {

constexpr double kResolution = 1e-9;  // geometric resolution asked for [mm]

using SislSurface = std::shared_ptr<SISLSurf>;

SislSurface sisl_surface(const UnitSurface& surface) {
  constexpr int kPolynomial = 1, kRational = 2, kCopied = 1;
  const bool rational = std::any_of(surface.weights.begin(), surface.weights.end(), [](double w) { return w != 1.0; });
  const int nu = surface.u.control_points, nv = surface.v.control_points;
  std::vector<double> knots_u = surface.u.knots, knots_v = surface.v.knots, net;
  for (int j = 0; j < nv; ++j) {  // the first parameter runs fastest
    for (int i = 0; i < nu; ++i) {
      const auto k = static_cast<std::size_t>(i * nv + j);
      const double w = surface.weights[k];
      for (const double x : surface.control_points[k]) net.push_back(w * x);
      if (rational) net.push_back(w);
    }
  }
  return {newSurf(nu, nv, surface.u.degree + 1, surface.v.degree + 1, knots_u.data(), knots_v.data(), net.data(),
                  rational ? kRational : kPolynomial, 3, kCopied),
          freeSurf};
}

Parameters sisl_local(SISLSurf* surface, Vec3 r, const Parameters& guess) {
  double start[2] = {0, 0}, end[2] = {1, 1}, first[2] = {guess.u, guess.v}, found[2] = {guess.u, guess.v};
  int status = 0;
  s1775(surface, r.data(), 3, kResolution, start, end, first, found, &status);
  return {found[0], found[1]};
}

/// All closest points have the same distance: the first is taken, or else the start of a curve of them.
Parameters sisl_global(SISLSurf* surface, Vec3 r) {
  int points = 0, curves = 0, status = 0;
  double* parameters = nullptr;
  SISLIntcurve** lines = nullptr;
  s1954(surface, r.data(), 3, 0.0, kResolution, &points, &parameters, &curves, &lines, &status);
  Parameters found;
  if (points > 0) found = {parameters[0], parameters[1]};
  if (points == 0 && curves > 0) found = {lines[0]->epar1[0], lines[0]->epar1[1]};
  std::free(parameters);
  if (curves > 0) freeIntcrvlist(lines, curves);
  return found;
}

}  // namespace

std::vector<Peer> sisl_peers(const UnitSurface& surface) {
  const SislSurface sisl = sisl_surface(surface);
  Peer peer;
  peer.name = "SISL";
  peer.nearest_local = [sisl](const Vec3& r, const Parameters& guess) { return sisl_local(sisl.get(), r, guess); };
  peer.nearest_global = [sisl](const Vec3& r) { return sisl_global(sisl.get(), r); };
  return {peer};
}

}  // namespace bladefit::bench

// OpenCASCADE: Extrema from a guess, and GeomAPI's projection onto the whole surface by either of its algorithms.

#include <Extrema_GenLocateExtPS.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <memory>

#include "tests/bench/peers/peer.hpp"

namespace bladefit::bench {
namespace {

/// Knots as this library takes them: each once, with its multiplicity.
struct CountedKnots {
  explicit CountedKnots(const SurfaceDirection& d) {
    for (const double knot : d.knots) {
      if (values.empty() || knot != values.back()) {
        values.push_back(knot);
        counts.push_back(0);
      }
      ++counts.back();
    }
  }
  std::vector<double> values;
  std::vector<int> counts;
};

opencascade::handle<Geom_BSplineSurface> opencascade_surface(const UnitSurface& surface) {
  const int nu = surface.u.control_points, nv = surface.v.control_points;
  TColgp_Array2OfPnt poles(1, nu, 1, nv);
  TColStd_Array2OfReal weights(1, nu, 1, nv);
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      const auto k = static_cast<std::size_t>(i * nv + j);
      const Eigen::Vector3d& p = surface.control_points[k];
      poles.SetValue(i + 1, j + 1, gp_Pnt(p.x(), p.y(), p.z()));
      weights.SetValue(i + 1, j + 1, surface.weights[k]);
    }
  }
  const CountedKnots u(surface.u), v(surface.v);
  const TColStd_Array1OfReal u_values(u.values.front(), 1, static_cast<int>(u.values.size()));
  const TColStd_Array1OfReal v_values(v.values.front(), 1, static_cast<int>(v.values.size()));
  const TColStd_Array1OfInteger u_counts(u.counts.front(), 1, static_cast<int>(u.counts.size()));
  const TColStd_Array1OfInteger v_counts(v.counts.front(), 1, static_cast<int>(v.counts.size()));
  return new Geom_BSplineSurface(poles, weights, u_values, v_values, u_counts, v_counts, surface.u.degree,
                                 surface.v.degree);
}

gp_Pnt point_of(const Vec3& r) { return {r.x(), r.y(), r.z()}; }

Parameters located(const GeomAdaptor_Surface& surface, const Vec3& r, const Parameters& guess) {
  Extrema_GenLocateExtPS extremum(surface);
  extremum.Perform(point_of(r), guess.u, guess.v);
  Parameters found = guess;
  if (extremum.IsDone()) extremum.Point().Parameter(found.u, found.v);
  return found;
}

/// The nearest of the perpendicular feet; (0, 0) where there is none.
Parameters lowest(GeomAPI_ProjectPointOnSurf& projection, const Vec3& r) {
  projection.Perform(point_of(r));
  Parameters found;
  if (projection.NbPoints() > 0) projection.LowerDistanceParameters(found.u, found.v);
  return found;
}

Peer global_peer(const opencascade::handle<Geom_BSplineSurface>& surface, Extrema_ExtAlgo algorithm, const char* name) {
  const auto projection = std::make_shared<GeomAPI_ProjectPointOnSurf>();
  projection->Init(surface, 0.0, 1.0, 0.0, 1.0, algorithm);
  projection->SetExtremaFlag(Extrema_ExtFlag_MIN);
  Peer peer;
  peer.name = name;
  peer.nearest_global = [projection](const Vec3& r) { return lowest(*projection, r); };
  return peer;
}

}  // namespace

std::vector<Peer> opencascade_peers(const UnitSurface& surface) {
  const opencascade::handle<Geom_BSplineSurface> made = opencascade_surface(surface);
  const auto adaptor = std::make_shared<GeomAdaptor_Surface>(made);
  Peer local;
  local.name = "OpenCASCADE, Extrema_GenLocateExtPS";
  local.nearest_local = [adaptor](const Vec3& r, const Parameters& guess) { return located(*adaptor, r, guess); };
  return {local, global_peer(made, Extrema_ExtAlgo_Grad, "OpenCASCADE, GeomAPI (Grad)"),
          global_peer(made, Extrema_ExtAlgo_Tree, "OpenCASCADE, GeomAPI (Tree)")};
}

}  // namespace bladefit::bench

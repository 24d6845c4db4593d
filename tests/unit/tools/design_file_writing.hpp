#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/unit/tools/design_fixtures.hpp"
#include "tools/design/nurbs/iges_writer.hpp"
#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit::testing {

/// A number that reads back as the same double, with the decimal point that STEP asks for.
inline std::string real_text(double value) {
  std::string text = iges_real(value);
  std::replace(text.begin(), text.end(), 'D', 'E');
  return text;
}

template <class Values, class Text>
std::string joined(const Values& values, Text text) {
  std::string list;
  for (const auto& value : values) list += (list.empty() ? "" : ",") + text(value);
  return list;
}

/// Entity 128 with the numbers of `surface` as they are.
inline IgesOutputEntity iges_surface(const NurbsSurface& surface, int matrix = 0) {
  return {128, iges_surface_parameters(surface), matrix, ""};
}

/// A whole IGES file; `units` are fields 14 and 15 of the global section, `scale` is field 13.
inline std::string iges_file(const std::vector<IgesOutputEntity>& entities, const std::string& units = "2,2HMM",
                             const std::string& scale = "1.0") {
  IgesOutputHeader header;
  header.units = units;
  header.scale = scale;
  return iges_file_text(header, entities);
}

/// How a STEP surface says its knots.
enum class StepForm { explicit_knots, bezier, uniform, quasi_uniform };

/// Statements of a STEP surface and of the face `face` on it; numbers begin at `first`, which is moved on.
inline std::string step_surface(const NurbsSurface& surface, const std::string& face, int& first,
                                StepForm form = StepForm::explicit_knots) {
  std::string text;
  const int points = first;
  for (const Eigen::Vector3d& point : surface.control_points) {
    text += fmt::format("#{}=CARTESIAN_POINT('',({},{},{}));\n", first++, real_text(point.x()), real_text(point.y()),
                        real_text(point.z()));
  }
  const auto net = [&](auto entry) {
    std::string rows;
    for (int i = 0; i < surface.u.control_points; ++i) {
      std::string row;
      for (int j = 0; j < surface.v.control_points; ++j) {
        row += (j == 0 ? "" : ",") + entry(i * surface.v.control_points + j);
      }
      rows += (i == 0 ? "(" : ",(") + row + ")";
    }
    return "(" + rows + ")";
  };
  const auto knot_lists = [](const SurfaceDirection& direction) {
    std::vector<double> knots;
    std::vector<int> multiplicities;
    for (const double knot : direction.knots) {
      if (knots.empty() || knot != knots.back()) {
        knots.push_back(knot);
        multiplicities.push_back(0);
      }
      ++multiplicities.back();
    }
    return std::pair{"(" + joined(multiplicities, [](int m) { return std::to_string(m); }) + ")",
                     "(" + joined(knots, real_text) + ")"};
  };
  const auto [multiplicities_u, knots_u] = knot_lists(surface.u);
  const auto [multiplicities_v, knots_v] = knot_lists(surface.v);
  std::string kind = fmt::format("B_SPLINE_SURFACE_WITH_KNOTS({},{},{},{},.UNSPECIFIED.)", multiplicities_u,
                                 multiplicities_v, knots_u, knots_v);
  if (form == StepForm::bezier) kind = "BEZIER_SURFACE()";
  if (form == StepForm::uniform) kind = "UNIFORM_SURFACE()";
  if (form == StepForm::quasi_uniform) kind = "QUASI_UNIFORM_SURFACE()";
  const std::string spline = fmt::format("B_SPLINE_SURFACE({},{},{},.UNSPECIFIED.,.F.,.F.,.F.)", surface.u.degree,
                                         surface.v.degree, net([&](int k) { return fmt::format("#{}", points + k); }));
  const std::string weights =
      fmt::format("RATIONAL_B_SPLINE_SURFACE({})",
                  net([&](int k) { return real_text(surface.weights[static_cast<std::size_t>(k)]); }));
  // The parts of a complex entity stand in the order of the alphabet.
  const auto only = [&](StepForm wanted) { return form == wanted ? kind : std::string(); };
  text += fmt::format(
      "#{}=({}BOUNDED_SURFACE(){}{}GEOMETRIC_REPRESENTATION_ITEM(){}{}REPRESENTATION_ITEM('')SURFACE(){});\n", first++,
      only(StepForm::bezier), spline, only(StepForm::explicit_knots), only(StepForm::quasi_uniform), weights,
      only(StepForm::uniform));
  text += fmt::format("#{}=ADVANCED_FACE('{}',(),#{},.T.);\n", first, face, first - 1);
  ++first;
  return text;
}

inline constexpr const char* kStepMillimetre =
    "#2=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
    "#1=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#2))REPRESENTATION_CONTEXT('',''));\n";

/// Statements that make the faces among `statements` the shape of a product, as CAD systems write it.
inline std::string step_product(const std::string& statements) {
  std::string faces;
  for (std::size_t at = statements.find("=ADVANCED_FACE"); at != std::string::npos;
       at = statements.find("=ADVANCED_FACE", at + 1)) {
    const std::size_t number = statements.rfind('#', at);
    faces += (faces.empty() ? "" : ",") + statements.substr(number, at - number);
  }
  if (faces.empty()) return {};
  return fmt::format(
      "#20=APPLICATION_CONTEXT('automotive design');\n#21=PRODUCT_CONTEXT('',#20,'mechanical');\n"
      "#22=PRODUCT('blade','blade','',(#21));\n#23=PRODUCT_DEFINITION_FORMATION('','',#22);\n"
      "#24=PRODUCT_DEFINITION_CONTEXT('part definition',#20,'design');\n#25=PRODUCT_DEFINITION('','',#23,#24);\n"
      "#26=PRODUCT_DEFINITION_SHAPE('','',#25);\n#27=OPEN_SHELL('',({}));\n#28=SHELL_BASED_SURFACE_MODEL('',(#27));\n"
      "#29=MANIFOLD_SURFACE_SHAPE_REPRESENTATION('',(#28),#1);\n#30=SHAPE_DEFINITION_REPRESENTATION(#26,#29);\n",
      faces);
}

/// A whole STEP file of these statements. Numbers from 100 on are free for surfaces.
inline std::string step_file(const std::string& statements, const std::string& units = kStepMillimetre) {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
         "FILE_NAME('test.stp','2024-01-01T00:00:00',(''),(''),'','','');\n"
         "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n" +
         units + statements + step_product(statements) + "ENDSEC;\nEND-ISO-10303-21;\n";
}

}  // namespace bladefit::testing

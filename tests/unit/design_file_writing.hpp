#pragma once
#include <fmt/format.h>

#include <string>
#include <vector>

#include "tests/unit/design_fixtures.hpp"
#include "tools/design/nurbs_surface.hpp"

namespace bladefit::testing {

/// A number that reads back as the same double, with the decimal point that IGES and STEP ask for.
inline std::string real_text(double value) {
  std::string text = fmt::format("{:.17g}", value);
  const std::size_t exponent = text.find('e');
  if (text.find('.') == std::string::npos) text.insert(exponent == std::string::npos ? text.size() : exponent, ".");
  if (const std::size_t e = text.find('e'); e != std::string::npos) text[e] = 'E';
  return text;
}

template <class Values, class Text>
std::string joined(const Values& values, Text text) {
  std::string list;
  for (const auto& value : values) list += (list.empty() ? "" : ",") + text(value);
  return list;
}

/// One IGES entity: its type, its parameters without end mark, and the directory number of its matrix or 0.
struct IgesEntity {
  int type;
  std::string parameters;
  int matrix = 0;
};

/// Entity 128 with the numbers of `surface` as they are.
inline IgesEntity iges_surface(const NurbsSurface& surface, int matrix = 0) {
  std::string text = fmt::format("128,{},{},{},{},0,0,0,0,0", surface.u.control_points - 1,
                                 surface.v.control_points - 1, surface.u.degree, surface.v.degree);
  const auto append = [&](double value) { text += "," + real_text(value); };
  for (const double knot : surface.u.knots) append(knot);
  for (const double knot : surface.v.knots) append(knot);
  const auto count_v = static_cast<std::size_t>(surface.v.control_points);
  const auto count_u = static_cast<std::size_t>(surface.u.control_points);
  for (std::size_t j = 0; j < count_v; ++j) {  // the first index varies fastest
    for (std::size_t i = 0; i < count_u; ++i) append(surface.weights[i * count_v + j]);
  }
  for (std::size_t j = 0; j < count_v; ++j) {
    for (std::size_t i = 0; i < count_u; ++i) {
      for (int axis = 0; axis < 3; ++axis) append(surface.control_points[i * count_v + j][axis]);
    }
  }
  for (const double end : {surface.u.start, surface.u.end, surface.v.start, surface.v.end}) append(end);
  return {128, text, matrix};
}

/// A whole IGES file; `units` are fields 14 and 15 of the global section, `scale` is field 13.
inline std::string iges_file(const std::vector<IgesEntity>& entities, const std::string& units = "2,2HMM",
                             const std::string& scale = "1.0") {
  const auto record = [](const std::string& text, char section, int number) {
    return fmt::format("{:<72}{}{:>7}\n", text, section, number);
  };
  const std::string global = "1H,,1H;,4Htest,8Htest.igs,8Hbladefit,3H1.0,32,38,6,308,15,4Htest," + scale + "," + units +
                             ",1,0.01,15H20240101.000000,1.0E-06,100.0,4Htest,4Htest,11,0,15H20240101.000000;";
  std::string file = record("made up", 'S', 1);
  int globals = 0;
  for (std::size_t k = 0; k < global.size(); k += 72) file += record(global.substr(k, 72), 'G', ++globals);
  std::string directory;
  std::string parameters;
  int entries = 0;
  int lines = 0;
  for (const IgesEntity& entity : entities) {
    const int first = lines + 1;
    std::string text = entity.parameters + ";";
    while (!text.empty()) {  // a number is not broken over two records
      std::size_t length = text.size() <= 64 ? text.size() : text.rfind(',', 63) + 1;
      parameters += record(fmt::format("{:<64}{:>8}", text.substr(0, length), entries + 1), 'P', ++lines);
      text.erase(0, length);
    }
    directory += record(fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}", entity.type, first, 0, 1, 0, 0,
                                    entity.matrix, 0, "00000000"),
                        'D', entries + 1);
    directory +=
        record(fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}{:>24}{:>8}", entity.type, 0, 0, lines - first + 1, 0, "", 0), 'D',
               entries + 2);
    entries += 2;
  }
  return file + directory + parameters +
         record(fmt::format("S{:>7}G{:>7}D{:>7}P{:>7}", 1, globals, entries, lines), 'T', 1);
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

/// A whole STEP file of these statements. Numbers from 100 on are free for surfaces.
inline std::string step_file(const std::string& statements, const std::string& units = kStepMillimetre) {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
         "FILE_NAME('test.stp','2024-01-01T00:00:00',(''),(''),'','','');\n"
         "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n" +
         units + statements + "ENDSEC;\nEND-ISO-10303-21;\n";
}

}  // namespace bladefit::testing

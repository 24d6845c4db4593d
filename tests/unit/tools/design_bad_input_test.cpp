#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "tests/unit/tools/design_file_writing.hpp"
#include "tests/unit/tools/design_fixtures.hpp"
#include "tools/design/load_design.hpp"
#include "tools/design/read_design.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

using testing::iges_file;
using testing::iges_surface;
using testing::random_surface;
using testing::replaced;
using testing::ScratchFolder;
using testing::step_file;
using testing::step_surface;

/// What reading `content` under `name` throws: one line that names the file.
std::string message_of(const std::string& name, const std::string& content) {
  const ScratchFolder folder;
  const auto path = folder.write(name, content);
  try {
    read_design(path);
  } catch (const ToolError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.rfind(path.string() + ":", 0), 0U) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_EQ(error.exit_code(), 2);
    return message;
  }
  return "accepted";
}

void expect_message(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << "got: " << message << "\nwanted: " << part;
}

const NurbsSurface kGood = random_surface({3, 4}, {2, 3}, true, 21);

std::string good_iges() { return iges_file({iges_surface(kGood)}); }

/// The good file with something else in the parameters of its surface.
std::string iges_with(const std::string& from, const std::string& to) {
  IgesOutputEntity entity = iges_surface(kGood);
  entity.parameters = replaced(entity.parameters, from, to);
  return iges_file({entity});
}

std::string good_step() {
  int number = 100;
  return step_file(step_surface(kGood, "PATCH1", number));
}

/// A fault of a surface, and what both readers must say of it.
struct Fault {
  const char* wanted;
  std::function<void(NurbsSurface&)> make;
};

const std::vector<Fault>& surface_faults() {
  static const std::vector<Fault> faults = {
      {"weight (1, 2) is 0", [](NurbsSurface& s) { s.weights[static_cast<std::size_t>(s.v.control_points) + 2] = 0; }},
      {"weight (0, 0) is -1", [](NurbsSurface& s) { s.weights[0] = -1; }},
      {"decreasing knots in u", [](NurbsSurface& s) { s.u.knots[5] = s.u.knots[4] - 0.01; }},
      {"decreasing knots in v", [](NurbsSurface& s) { s.v.knots[3] = s.v.knots[2] - 0.01; }},
      {"torn at u",
       [](NurbsSurface& s) {
         s = random_surface({1, 3}, {2, 3}, true, 1), s.u.knots[3] = s.u.knots[2];
       }},
  };
  return faults;
}

TEST(DesignBadInput, GoodFilesAreAccepted) {
  EXPECT_EQ(message_of("a.igs", good_iges()), "accepted");
  EXPECT_EQ(message_of("a.stp", good_step()), "accepted");
}

TEST(DesignBadInput, FaultySurfaces) {
  for (const Fault& fault : surface_faults()) {
    NurbsSurface surface = kGood;
    fault.make(surface);
    expect_message(message_of("a.igs", iges_file({iges_surface(surface)})), fault.wanted);
    expect_message(message_of("a.igs", iges_file({iges_surface(surface)})), "entity 128 at D1");
    int number = 100;
    expect_message(message_of("a.stp", step_file(step_surface(surface, "PATCH1", number))), fault.wanted);
  }
}

TEST(DesignBadInput, SurfacesThatOnlyIgesCanHold) {
  const auto message = [](const std::function<void(NurbsSurface&)>& make) {
    NurbsSurface surface = kGood;
    make(surface);
    return message_of("a.igs", iges_file({iges_surface(surface)}));
  };
  expect_message(message([](NurbsSurface& s) { s.u.start = s.u.end; }), "degenerate");
  expect_message(message([](NurbsSurface& s) { s.u.start = 9; }), "degenerate or outside");
  expect_message(message([](NurbsSurface& s) { s.v.end += 1; }), "parameter range");
  expect_message(message([](NurbsSurface& s) { s.v.knots.pop_back(); }), "number of knots");
  expect_message(message([](NurbsSurface& s) { s.u.degree = 0; }), "degree M1 in u");
  expect_message(message([](NurbsSurface& s) { s.v.degree = 26; }), "degree M2 in v");
  expect_message(message_of("a.igs", iges_with("128,6,", "128,2000000000,")), "upper index K1");
  expect_message(message_of("a.igs", iges_with("128,6,4,", "128,99999,99999,")), "not matching");
  expect_message(message([](NurbsSurface& s) {
                   for (std::size_t k = 4; k < 8; ++k) s.u.knots[k] = s.u.knots[3];
                 }),
                 "leave no parameter range");
}

TEST(DesignBadInput, KnotMultiplicityBeyondDegreePlusOne) {
  NurbsSurface surface = random_surface({2, 6, false}, {2, 3}, false, 1);
  for (std::size_t k = 4; k < 8; ++k) surface.u.knots[k] = surface.u.knots[4];
  expect_message(message_of("a.igs", iges_file({iges_surface(surface)})), "has multiplicity 4, more than degree + 1");
  int number = 100;
  expect_message(message_of("a.stp", step_file(step_surface(surface, "", number))), "has multiplicity 4");
}

TEST(DesignBadInput, NotANumber) {
  const std::string first = testing::real_text(kGood.control_points[0].z());
  for (const std::string wrong : {"nan", "inf", "1.2.3", "abc", "1e999", "-", "1.0E", "0x10"}) {
    const std::string message = message_of("a.igs", iges_with(first, wrong));
    expect_message(message, "is \"" + wrong + "\", which is not a finite number (line ");
    const std::string step_message = message_of("a.stp", replaced(good_step(), first, wrong));
    EXPECT_NE(step_message, "accepted") << wrong;
    if (wrong.find_first_of("0123456789") == 0)
      expect_message(step_message, "\"" + wrong + "\" is not a finite number");
  }
  expect_message(message_of("a.igs", iges_with(first, "")), "is \"\", which is not a finite number");
  expect_message(message_of("a.igs", iges_with(first, "1e300")), "control point (0, 0) is over 1000000000 mm away");
}

TEST(DesignBadInput, NoSurface) {
  const std::string message =
      message_of("a.igs", iges_file({{110, "110,0.,0.,0.,1.,1.,1.", 0, ""}, {110, "110,0.,0.,0.,1.,1.,2.", 0, ""}}));
  expect_message(message, "no visible surface in the file");
  expect_message(message, "2 x 110");
  expect_message(message_of("a.stp", step_file("#100=CARTESIAN_POINT('',(0.,0.,0.));\n")),
                 "no face of a product in the file");
}

TEST(DesignBadInput, UnknownUnits) {
  const auto with_units = [](const std::string& units) { return iges_file({iges_surface(kGood)}, units); };
  expect_message(message_of("a.igs", with_units("3,3HELL")), "unknown unit name \"ELL\" in field 15");
  expect_message(message_of("a.igs", with_units("12,2HMM")), "unknown unit flag \"12\" in field 14");
  expect_message(message_of("a.igs", with_units(",2HMM")), "unknown unit flag \"\"");
  expect_message(message_of("a.igs", iges_file({iges_surface(kGood)}, "2,2HMM", "0.0")), "model space scale");
  expect_message(message_of("a.stp", replaced(good_step(), "SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT(.GIGA.,.METRE.)")),
                 "unknown unit of length");
  expect_message(message_of("a.stp", replaced(good_step(), "SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT(.MILLI.,.GRAM.)")),
                 "unknown unit of length");
  expect_message(message_of("a.stp", replaced(good_step(), "GLOBAL_UNIT_ASSIGNED_CONTEXT((#2))", "")),
                 "unit of length");
}

TEST(DesignBadInput, MixedStepUnits) {
  const std::string other =
      "#3=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.CENTI.,.METRE.));\n"
      "#4=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#3))REPRESENTATION_CONTEXT('',''));\n";
  expect_message(message_of("a.stp", replaced(good_step(), "#1=", other + "#1=")), "mixes units of length");
}

TEST(DesignBadInput, DamagedStepEntities) {
  expect_message(message_of("a.stp", replaced(good_step(), "(#100,", "(#999999,")), "#");
  expect_message(message_of("a.stp", replaced(good_step(), "(#100,", "(#2,")), "#");
  expect_message(message_of("a.stp", replaced(good_step(), "B_SPLINE_SURFACE(3,2", "B_SPLINE_SURFACE(30,2")), "degree");
  expect_message(message_of("a.stp", replaced(good_step(), "B_SPLINE_SURFACE(3,2", "B_SPLINE_SURFACE(2,2")),
                 "multiplicity");
  expect_message(message_of("a.stp", replaced(good_step(), "WITH_KNOTS((4,1", "WITH_KNOTS((4,2")), "knots in u");
  expect_message(message_of("a.stp", replaced(good_step(), "WITH_KNOTS((4,1", "WITH_KNOTS((4,2000000000")),
                 "multiplicity");
}

TEST(DesignBadInput, ForeignFiles) {
  for (const char* name : {"a.igs", "a.stp"}) {
    expect_message(message_of(name, ""), "the file is empty");
    expect_message(message_of(name, "x,y,z\n1,2,3\n"), name[2] == 'i' ? "not an IGES file" : "not a STEP file");
    expect_message(message_of(name, std::string(5000, '\0')), "file");
  }
  expect_message(message_of("a.igs", good_step()), "not an IGES file");
  expect_message(message_of("a.stp", good_iges()), "not a STEP file");
  expect_message(message_of("a.sldprt", "x"), "cannot read designs of kind \".sldprt\"; export the blade");
  expect_message(message_of("a.xyz", "x"), "unknown kind of design \".xyz\"");
  expect_message(message_of("a.stp", "\x1F\x8B\x08"), "damaged or cut off");
}

TEST(DesignBadInput, MissingFileAndFolder) {
  EXPECT_THROW(read_design("/nonexistent/a.igs"), ToolError);
  EXPECT_THROW(load_design("/nonexistent/a.bfd", OutwardOption::plus), ToolError);
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path() / "a.stp");
  EXPECT_THROW(read_design(folder.path() / "a.stp"), ToolError);
}

TEST(DesignBadInput, DamagedImages) {
  const ScratchFolder folder;
  const auto message = [&](const std::string& content) {
    try {
      load_design(folder.write("a.bfd", content), OutwardOption::plus);
    } catch (const ToolError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const LoadedDesign design = load_design(folder.write("a.igs", good_iges()), OutwardOption::plus);
  const std::string bytes(reinterpret_cast<const char*>(design.image.data()), design.image.size());
  EXPECT_EQ(message(bytes), "accepted");
  expect_message(message(""), "the file is empty");
  expect_message(message(good_iges()), "not a usable design image");
  for (std::size_t size = 1; size < bytes.size(); size += 97) {
    expect_message(message(bytes.substr(0, size)), "not a usable design image");
  }
  std::string flipped = bytes;
  flipped[bytes.size() - 3] ^= 1;
  expect_message(message(flipped), "not a usable design image");
}

TEST(DesignBadInput, TruncatedFilesAreRefusedAtEveryLength) {
  const std::string iges = good_iges();
  for (std::size_t size = 0; size + 82 < iges.size(); size += 41) {
    EXPECT_NE(message_of("a.igs", iges.substr(0, size)), "accepted") << size;
  }
  // The counts of the terminate record are needed, its own number is not.
  expect_message(message_of("a.igs", iges.substr(0, iges.size() - 60)), "line ");
  const std::string step = good_step();
  for (std::size_t size = 0; size + 2 < step.size(); size += 37) {
    EXPECT_NE(message_of("a.stp", step.substr(0, size)), "accepted") << size;
  }
  expect_message(message_of("a.stp", step.substr(0, step.size() / 2)), "truncated");
  expect_message(message_of("a.igs", iges.substr(0, 81 * (iges.size() / 162))), "truncated");
}

TEST(DesignBadInput, LostIgesLineIsNoticed) {
  const std::string iges = good_iges();
  for (std::size_t line = 0; line < iges.size() / 81; line += 3) {
    std::string shorter = iges;
    shorter.erase(81 * line, 81);
    EXPECT_NE(message_of("a.igs", shorter), "accepted") << line;
  }
}

/// Damage anywhere may be noticed or not, but must not crash.
RC_GTEST_PROP(DesignBadInput, DamageNeverCrashes, ()) {
  const bool iges = *rc::gen::arbitrary<bool>();
  std::string text = iges ? good_iges() : good_step();
  const auto hits = *rc::gen::inRange(1, 6);
  for (int k = 0; k < hits; ++k) {
    const auto place = *rc::gen::inRange<std::size_t>(0, text.size());
    text[place] = *rc::gen::elementOf(std::string("0123456789.,;()#'*$-+ED \nX\0", 27));
  }
  message_of(iges ? "a.igs" : "a.stp", text);
  RC_ASSERT(!::testing::Test::HasFailure());
}

}  // namespace
}  // namespace bladefit

// Bad input of every kind that users bring: each row names the input, the exit code and what the one line says. The
// whole table is run by one test, so that a row that fails does not hide the others.

#include <sys/stat.h>

#include "tests/golden/bad_input.hpp"

namespace bladefit::testing {
namespace {

const std::string kSheetPoints = "x,y,z\n10,10,0\n40,10,0\n40,40,0\n10,40,0.1\n25,25,0\n30,15,0\n15,30,0\n20,20,0\n";

std::vector<std::string> localize(const std::string& points, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"localize", "--design", "DESIGN", "--points", points};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// A row for a points file of this content.
BadInput points(const std::string& kind, const std::string& content, const std::string& pattern,
                const std::vector<std::string>& more = {}, int exit_code = 2) {
  return {kind, {{"p.csv", content}}, localize("DIR/p.csv", more), exit_code, pattern};
}

/// A row for an option with points that are good.
BadInput option(const std::string& kind, const std::vector<std::string>& more, const std::string& pattern,
                int exit_code = 2) {
  return {kind, {{"p.csv", kSheetPoints}}, localize("DIR/p.csv", more), exit_code, pattern};
}

BadInput settings(const std::string& kind, const std::string& toml, const std::string& pattern) {
  return {kind,
          {{"p.csv", kSheetPoints}, {"fit.toml", toml}},
          localize("DIR/p.csv", {"--config", "DIR/fit.toml"}),
          2,
          pattern};
}

BadInput device(const std::string& kind, const std::string& toml, const std::string& pattern) {
  return {kind,
          {{"p.csv", kSheetPoints}, {"d.toml", toml}, {"s.toml", "design = \"DESIGN\"\ndevice = \"d.toml\"\n"}},
          {"run", "--headless", "--panel", "127.0.0.1:0", "--config", "DIR/s.toml", "--session", "DIR/s"},
          2,
          pattern};
}

const std::vector<BadInput>& bad_points() {
  static const std::vector<BadInput> rows = {
      points("no names", "1,2,3\n4,5,6\n", "p.csv:1: a number, '1', .*--columns"),
      points("decimal commas between commas", "x,y,z\n1,5,2,5,3,5\n", "p.csv:2: 6 columns where 3 .*';'"),
      points("commas that may be either", "x;y;z\n1,234;5,678;9,012\n", "p.csv:2: .*decimal comma"),
      points("separators of thousands", "x,y,z\n\"1,234.5\",2,3\n", "p.csv:2: column x: .*thousands"),
      points("both decimal marks", "x;y;z\n1,5;2.5;3\n", "p.csv:2: column y: .*decimal"),
      points("other unit than --units", "x [in],y [in],z [in]\n1,2,3\n", "p.csv: .*in, but --units says mm",
             {"--units", "mm"}),
      points("units that contradict each other", "x [mm],y [in],z [mm]\n1,2,3\n", "p.csv:1: the unit in contradicts"),
      points("an unknown unit", "x [ft],y [ft],z [ft]\n1,2,3\n", "p.csv:1: column 'x \\[ft\\]': .*mm, cm, m or in"),
      points("UTF-16", std::string("\xFF\xFEx\0,\0y\0", 9), "p.csv: .*UTF-16; save it as"),
      points("a workbook", "PK\x03\x04", "p.csv: a workbook"),
      points("an open quotation mark", "x,y,z\n\"1,2,3\n", "p.csv:2: a quotation mark is not closed"),
      points("a line cut short", "x,y,z\n1,2,3\n4,5\n", "p.csv:3: 2 columns where 3 are named"),
      points("a last number cut short", "x,y,z\n" + repeated("1.25,2.25,3.25\n", 6) + "1.25,2.25,3.2",
             "p.csv:8: the last line has no end"),
      points("a coordinate left out", "x,y,z\n1,,3\n", "p.csv:2: column y: it is empty"),
      points("no number", "x,y,z\n1,2,#REF!\n", "p.csv:2: column z: '#REF!'"),
      points("not a number", "x,y,z\n1,nan,3\n", "p.csv:2: column y: 'nan'"),
      points("a coordinate beyond reason", "x,y,z\n1,2,1e300\n", "p.csv:2: column z: '1e300'"),
      points("a weight beyond reason", "x,y,z,weight\n1,2,3,1e99\n", "p.csv:2: column weight: '1e99'"),
      points("a weight of 0", "x,y,z,weight\n1,2,3,0\n", "p.csv:2: column weight: '0'.*--subset"),
      points("a path beyond reason", "x,y,z,path\n1,2,3,99999999999\n", "p.csv:2: column path"),
      points("a direction of another length", "x,y,z,i,j,k\n1,2,3,5,0,0\n", "p.csv:2: columns i,j,k"),
      points("text behind the end-of-file mark", "x,y,z\n1,2,3\x1A\n4,5,6\n", "p.csv:2: a control character"),
      points("a line without end", "x,y,z\n" + std::string(100000, '1'), "p.csv:2: the line is longer"),
      points("names only", "x,y,z\n", "p.csv: the list of points is empty"),
      points("nothing", "", "p.csv: the file is empty"),
      points("a column named twice", "X,Y,Z,x\n1,2,3,4\n", "p.csv:1: column 'x' is named twice"),
      points("names that are no columns", "Xnom,Ynom,Znom\n1,2,3\n", "p.csv:1: column 'x' is missing among 'Xnom'"),
      points("more columns than are named", "1,2,3,4\n", "p.csv:1: the line has 4 columns, but 3 are named",
             {"--columns", "x,y,z"}),
      points("columns without z", kSheetPoints, "--columns: column 'z' is missing", {"--columns", "x,y"}),
      {"a folder of points", {}, localize("DIR/"), 2, "is a folder"},
      {"no points file", {}, localize("DIR/none.csv"), 2, "none.csv: no such file; check the name"},
      {"an endless device", {}, localize("/dev/zero"), 2, "/dev/zero: is a device"},
  };
  return rows;
}

const std::vector<BadInput>& bad_settings() {
  static const std::vector<BadInput> rows = {
      option("a word for a number", {"--tolerance", "abc"}, "--tolerance: 'abc' is not a number"),
      option("a tolerance beyond reason", {"--tolerance", "1e300"}, "--tolerance: .*out of range"),
      option("a tolerance larger than the blade", {"--tolerance", "5000"},
             "--tolerance: 5000 mm is more than the blade"),
      option("a probe larger than the blade", {"--probe-radius", "1e6"}, "--probe-radius: a ball of radius"),
      option("a ratio beyond reason", {"--ratio", "1e99"}, "--ratio: .*out of range"),
      option("an unknown unit", {"--units", "ft"}, "--units: 'ft' is none of: mm, in, cm, m"),
      option("an unknown option of any length", {"--" + std::string(900, 'a')}, "is not an option of localize"),
      option("a file of any name", {"--config", std::string(200, 'b') + "/" + std::string(200, 'c')}, "no such file"),
      settings("a tolerance beyond reason in a file", "[fit]\ntolerance = 1e300\n", "fit.toml:2: key 'fit.tolerance'"),
      settings("an unknown key", "[fit]\ntolerances = 1\n", "fit.toml:2: .*did you mean"),
      settings("keys nested without end", repeated("a.", 100000) + "a = 1\n", "fit.toml:1: a key of 32 parts or more"),
      settings("tables nested without end", "[" + repeated("a.", 100000) + "a]\n", "fit.toml:1: a key of 32 parts"),
      settings("lists nested without end", "a = " + repeated("[", 100000), "fit.toml:1: "),
      settings("a settings file that is too large", repeated("# more\n", 200000), "fit.toml: is larger than the 1 MiB"),
      device("an unknown unit in a device file", "kind = \"replay\"\n[replay]\nfile = \"p.csv\"\nunits = \"ft\"\n",
             "d.toml:4: key 'replay.units': 'ft' is none of"),
      device("columns without z in a device file", "kind = \"replay\"\n[replay]\nfile = \"p.csv\"\ncolumns = \"x,y\"\n",
             "d.toml:4: key 'replay.columns'"),
      {"a unit that the recording contradicts",
       {{"u.csv", "x [in],y [in],z [in]\n1,2,3\n"},
        {"d.toml", "kind = \"replay\"\n[replay]\nfile = \"u.csv\"\nunits = \"mm\"\n"},
        {"s.toml", "design = \"DESIGN\"\ndevice = \"d.toml\"\n"}},
       {"run", "--headless", "--panel", "127.0.0.1:0", "--config", "DIR/s.toml", "--session", "DIR/s"},
       2,
       "u.csv: the file gives its lengths in in, but .* mm"},
      option("a result on a full disk", {"--json", "/dev/full"}, "/dev/full: cannot be written: No space", 3),
      option("a result in a folder that is not there", {"--json", "DIR/none/r.json"}, "cannot be written", 3),
      {"points of a design on a full disk",
       {},
       {"sample", "DESIGN", "-o", "/dev/full", "--grid", "3x3"},
       3,
       "/dev/full: cannot be written"},
      {"an image on a full disk", {}, {"compile", "DESIGN", "-o", "/dev/full"}, 3, "cannot be written"},
      {"a subset that names no row",
       {{"p.csv", kSheetPoints}, {"s.txt", "99999999999999999999999\n"}},
       localize("DIR/p.csv", {"--subset", "DIR/s.txt"}),
       2,
       "s.txt:1: "},
      {"sections in another unit than --units",
       {{"c.csv", "section,x [mm],y [mm],z [mm]\n0,1,2,3\n"}},
       {"loft", "DIR/c.csv", "-o", "DIR/o.igs", "--units", "in"},
       2,
       "c.csv: the file gives its lengths in mm, but --units says in"},
  };
  return rows;
}

const std::vector<BadInput>& bad_start_pairs() {
  static const std::vector<BadInput> rows = {
      {"start pairs without a column",
       {{"p.csv", kSheetPoints}, {"a.csv", "x,y,z\n1,2,3\n"}},
       localize("DIR/p.csv", {"--start", "DIR/a.csv"}),
       2,
       "a.csv:1: column 'design_x' is missing"},
      {"start pairs beyond any machine",
       {{"p.csv", kSheetPoints},
        {"a.csv", "x,y,z,design_x,design_y,design_z\n0,0,0,1e300,0,0\n1,0,0,1e300,1,0\n0,1,0,1e300,0,1\n"}},
       localize("DIR/p.csv", {"--start", "DIR/a.csv"}),
       2,
       "a.csv:2: column design_x: '1e300' is beyond"},
      {"start pairs with endless names",
       {{"p.csv", kSheetPoints},
        {"a.csv", "name,x,y,z,design_x,design_y,design_z\n" + std::string(4000, 'n') +
                      ",0,0,0,0,0,0\nhub,9,0,0,1,0,0\ntip,0,1,0,0,1,0\n"}},
       localize("DIR/p.csv", {"--start", "DIR/a.csv"}),
       2,
       "what remains: line 2 .*, hub .*, tip "},
  };
  return rows;
}

TEST_F(BadInputs, OfPointsAreRefusedInOneLineEach) { expect_refused(bad_points()); }

TEST_F(BadInputs, OfSettingsAndOutputsAreRefusedInOneLineEach) { expect_refused(bad_settings()); }

TEST_F(BadInputs, OfStartPairsAreRefusedInOneLineEach) { expect_refused(bad_start_pairs()); }

/// Of a size that is never read: the file has a hole in place of its content.
TEST_F(BadInputs, FilesOfAGigabyteAreRefusedByTheirSize) {
  const std::string large = scratch("large");
  std::ofstream(large) << "x,y,z\n";
  std::filesystem::resize_file(large, (std::uintmax_t{1} << 30U) + 1);
  for (const std::string extension : {"csv", "igs", "stp", "toml"}) {
    const std::string path = scratch("large." + extension);
    std::filesystem::rename(extension == "csv" ? large : scratch("last"), path);
    const std::string design = extension == "igs" || extension == "stp" ? path : filled("DESIGN");
    std::vector<std::string> arguments = {
        "timeout",  "60",   BLADEFIT_COMMAND, "localize",
        "--design", design, "--points",       extension == "csv" ? path : filled("DESIGN")};
    if (extension == "toml") arguments.insert(arguments.end(), {"--config", path});
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_NE(outcome.output.find(path.substr(path.size() - 9) + ": is larger than the"), std::string::npos)
        << outcome.output;
    std::filesystem::rename(path, scratch("last"));
  }
}

TEST_F(BadInputs, APipeThatNobodyWritesToIsGivenUp) {
  const std::string pipe = scratch("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const Outcome outcome =
      run({"timeout", "60", BLADEFIT_COMMAND, "localize", "--design", filled("DESIGN"), "--points", pipe});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_NE(outcome.output.find("is a pipe to which nobody wrote"), std::string::npos) << outcome.output;
}

TEST_F(BadInputs, AFullStandardOutputIsADeviceFailure) {
  for (const std::string json : {"", "--json -"}) {
    const std::string command = std::string(BLADEFIT_COMMAND) + " localize --design " + filled("DESIGN") +
                                " --points " BLADEFIT_TEST_DATA "/dtmb4119/points.csv " + json + " > /dev/full";
    const Outcome outcome = run({"sh", "-c", command});
    EXPECT_EQ(outcome.exit_code, 3) << outcome.output;
    EXPECT_NE(outcome.output.find("bladefit: standard output: cannot be written"), std::string::npos) << outcome.output;
  }
}

TEST_F(BadInputs, PointsOnStandardInputAreReadAsThoseOfAFile) {
  const std::string command = std::string("cat " BLADEFIT_TEST_DATA "/dtmb4119/points.csv | ") + BLADEFIT_COMMAND +
                              " localize --design " + filled("DESIGN") + " --points -";
  const Outcome outcome = run({"sh", "-c", command});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("Fit converged: 2000 of 2000 points"), std::string::npos) << outcome.output;
}

}  // namespace
}  // namespace bladefit::testing

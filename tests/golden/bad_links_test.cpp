// Designs, machines and numbers that cannot be read safely, as rows of a table that is run whole: see bad_input.hpp.

#include "tests/golden/bad_input.hpp"
#include "tests/support/scratch_folder.hpp"

namespace bladefit::testing {
namespace {

const std::string kStep = read_whole(BLADEFIT_TEST_DATA "/arl_fan/design.stp");
const std::string kIges = read_whole(BLADEFIT_TEST_DATA "/arl_fan/design.igs");
const std::string kFirstPoint = "#17=CARTESIAN_POINT('',(0.,0.,0.));";

/// The text with something else in one place.
std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  if (place == std::string::npos) throw std::logic_error("the file does not hold " + from);
  return text.replace(place, from.size(), to);
}

/// The IGES file with the columns from `column` on, from 1, of a line replaced.
std::string iges_with(std::size_t line, std::size_t column, const std::string& by) {
  std::string text = kIges;
  std::size_t begin = 0;
  for (std::size_t k = 1; k < line; ++k) begin = text.find('\n', begin) + 1;
  return text.replace(begin + column - 1, by.size(), by);
}

BadInput design(const std::string& kind, const std::string& name, const std::string& content,
                const std::string& pattern) {
  return {kind, {{name, content}}, {"compile", "DIR/" + name, "-o", "DIR/o.bfd"}, 2, name + ": " + pattern};
}

const std::vector<BadInput>& bad_designs() {
  static const std::vector<BadInput> rows = {
      design("a reference that is not there", "a.stp", with(kStep, kFirstPoint, ""), "line 27: #17 is referred to but"),
      design("a number given twice", "a.stp", with(kStep, kFirstPoint, kFirstPoint + kFirstPoint),
             "line 24: #17 is given a second time"),
      design("an instance of itself", "a.stp", with(kStep, "B_SPLINE_SURFACE(3,3,((#21", "B_SPLINE_SURFACE(3,3,((#805"),
             "line 812: #805 refers to itself"),
      design("an exponent of FORTRAN", "a.stp", with(kStep, "(0.,0.,0.)", "(1.5D1,0.,0.)"),
             "line 24: \"1.5D1\" is not a finite number"),
      design("a hexadecimal number", "a.stp", with(kStep, "(0.,0.,0.)", "(0x10,0.,0.)"), "line 24: \"0x10\" is not a"),
      design("a number beyond all", "a.stp", with(kStep, "(0.,0.,0.)", "(1.E999,0.,0.)"),
             "line 24: \"1.E999\" is not a"),
      design("no number", "a.stp", with(kStep, "(0.,0.,0.)", "(NAN,0.,0.)"), ".*not a finite number"),
      design("an instance beyond all numbers", "a.stp", with(kStep, "#17=", "#99999999999999999999="),
             "line 24: #99999999999999999999 is not a number"),
      design("a decimal comma in STEP", "a.stp", with(kStep, "(0.,0.,0.)", "(0,5,0.,0.)"),
             "line 24: CARTESIAN_POINT has 4 numbers where 3 belong; is it a decimal comma"),
      design("a unit that there is none of", "a.stp", with(kStep, ".MILLI.,.METRE.", ".FURLONG.,.METRE."),
             "line .*'.FURLONG.' is not a prefix of a unit"),
      design("a weight beyond reason", "a.stp",
             with(kStep, "RATIONAL_B_SPLINE_SURFACE(((1.0", "RATIONAL_B_SPLINE_SURFACE(((1.E30"),
             "surface #805: its weights differ beyond reason, from 0.8.* to 1e\\+30"),
      design("parentheses without end", "a.stp", with(kStep, "(0.,0.,0.)", repeated("(", 200000)),
             "line 24: more than 100 parentheses"),
      design("a text that does not end", "a.stp", with(kStep, "''", "'"), "line .*export the design again"),
      design("half a STEP file", "a.stp", kStep.substr(0, kStep.size() / 2), "line .*the file is truncated"),
      design("half an IGES file", "a.igs", kIges.substr(0, kIges.size() / 2), "line .* is truncated"),
      design("a word for a number in IGES", "a.igs", iges_with(12, 1, "abc,"),
             ".*\"abc\", which is not a finite number"),
      design("a number beyond all in IGES", "a.igs", iges_with(12, 1, "1.E999,"),
             ".*\"1.E999\", which is not a finite"),
      design("a byte of 0 in IGES", "a.igs", iges_with(12, 5, std::string(1, '\0')),
             ".*not a finite number \\(line 12\\)"),
      design("a record that is missing", "a.igs", iges_with(12, 74, "      7"),
             "line 12: record 6 of section P is missing"),
      design("an entry that points nowhere", "a.igs", iges_with(5, 9, "  999999"),
             "line 5: the directory entry points"),
      design("columns beyond those of a record", "a.igs", with(kIges, "P      6\n", "P      6junk\n"),
             "line 12: 84 columns where"),
      design("a drawing of another kind", "a.igs", "%PDF-1.7\n", "not an IGES file"),
      design("a compiled design that was cut", "a.bfd", "BLDEFIT\n", ".*"),
      {"a design of no kind", {{"a.xyz", "1"}}, {"compile", "DIR/a.xyz", "-o", "DIR/o.bfd"}, 2, "a.xyz: .*\\.igs"},
      {"an endless device", {}, {"compile", "/dev/zero", "-o", "DIR/o.bfd"}, 2, "/dev/zero: "},
  };
  return rows;
}

BadInput run_with(const std::string& kind, const std::vector<std::string>& more, const std::string& pattern,
                  int exit_code = 2) {
  std::vector<std::string> arguments = {"run", "--design", "DESIGN", "--headless", "--until-idle", "2"};
  arguments.insert(arguments.end(), {"--session", "DIR/s"});
  arguments.insert(arguments.end(), more.begin(), more.end());
  if (std::ranges::find(more, "--panel") == more.end()) arguments.insert(arguments.end(), {"--panel", "127.0.0.1:0"});
  return {kind, {}, arguments, exit_code, pattern};
}

BadInput device_file(const std::string& kind, const std::string& toml, const std::string& pattern) {
  BadInput row = run_with(kind, {"--config", "DIR/s.toml"}, pattern);
  row.files = {{"d.toml", toml}, {"s.toml", "device = \"d.toml\"\n"}};
  return row;
}

const std::vector<BadInput>& bad_machines() {
  const std::string modbus = "kind = \"modbus-tcp\"\n[tcp]\nhost = \"127.0.0.1\"\n";
  static const std::vector<BadInput> rows = {
      run_with("no source", {}, "no source is given; name one with --source"),
      run_with("port 0", {"--source", "modbus-tcp://127.0.0.1:0"}, "the port is not a whole number 1..65535"),
      run_with("a port beyond all", {"--source", "modbus-tcp://127.0.0.1:99999"}, "the port is not a whole number"),
      run_with("no host", {"--source", "modbus-tcp://:502"}, "the host is missing; write modbus-tcp://HOST:PORT"),
      run_with("a host that nobody knows", {"--source", "modbus-tcp://no.such.host.invalid:502"},
               "the host is not known", 3),
      run_with("a machine that is not there", {"--source", "modbus-tcp://127.0.0.1:1"}, "127.0.0.1:1", 3),
      run_with("an unknown transport", {"--source", "tcp://x"}, "unknown transport; write modbus-tcp://HOST:PORT"),
      run_with("no serial port", {"--source", "serial:/dev/null"}, "/dev/null: this is not a serial port", 3),
      run_with("a file for a serial port", {"--source", "modbus-rtu:/etc/passwd"}, "this is not a serial port", 3),
      run_with("an endless recording", {"--source", "replay:/dev/zero"}, "/dev/zero: is a device, no file"),
      run_with("a panel without a port", {"--source", "replay:a.csv", "--panel", "127.0.0.1"}, "a.csv: no such file"),
      run_with("a plan that is not a count", {"--source", "replay:a.csv", "--plan", "1e3"},
               "--plan '1e3': give a number"),
      run_with("standard input for two", {"--source", "replay:-", "--plan", "-"},
               "--plan -: the recording is read from standard input too"),
      run_with("an option given twice", {"--source", "replay:a.csv", "--panel", "a:1", "--panel", "b:1"},
               "--panel: is given more than once; give it once"),
      device_file("no host in a device file", "kind = \"modbus-tcp\"\n",
                  "d.toml: it does not say where the machine is"),
      device_file("no port in a device file", "kind = \"serial\"\n", "d.toml: it does not say where the machine is"),
      device_file("a unit beyond all", modbus + "[modbus]\nunit = 300\n", "d.toml:5: key 'modbus.unit': 300 is out of"),
      device_file("an unknown base of addresses", modbus + "[map]\naddress_base = 2\n",
                  "d.toml:5: key 'map.address_base'"),
      device_file("address 0 in a map that counts from 1",
                  modbus + "[map]\naddress_base = 1\nnewest = { address = 0 }\n",
                  "d.toml:6: key 'map.newest.address': 0 is out of range; it must be a whole number from 1"),
      device_file("an unknown order of bytes", modbus + "[map]\nbyte_order = \"odd\"\n",
                  "d.toml:5: key 'map.byte_order'"),
      device_file("an unknown order of words", modbus + "[map]\nword_order = \"odd\"\n",
                  "d.toml:5: key 'map.word_order'"),
      device_file("a register beyond all", modbus + "[map.record]\naddress = 70000\n",
                  "d.toml:5: key 'map.record.addr"),
      device_file("an unknown key of a map", modbus + "[map]\nq = 1\n",
                  "d.toml:5: unknown key 'map.q'; known keys: .* more"),
      device_file("a scale of 0 of a read-out", "kind = \"dro\"\n[dro]\nscale = 0\n",
                  "d.toml:3: key 'dro.scale': 0 is out"),
      device_file("a text for the scale", "kind = \"dro\"\n[dro]\nscale = \"0.001\"\n",
                  "d.toml:3: key 'dro.scale'.*not a text"),
      device_file("a digit as decimal mark", "kind = \"dro\"\n[dro]\ndecimal_mark = \"1\"\n",
                  "d.toml:3: key 'dro.decimal_mark'"),
      device_file("an axis named twice", "kind = \"dro\"\n[dro]\norder = \"xxy\"\n",
                  "d.toml:3: key 'dro.order': 'xxy'"),
      device_file("a byte of 0", "kind = \"dro\"" + std::string(1, '\0') + "\n", "d.toml:1: a control character"),
  };
  return rows;
}

/// Numbers of the command line that another program would read otherwise.
const std::vector<BadInput>& bad_numbers() {
  const auto option = [](const std::string& kind, const std::vector<std::string>& more, const std::string& pattern) {
    std::vector<std::string> arguments = {"localize", "--design", "DESIGN", "--points",
                                          BLADEFIT_TEST_DATA "/dtmb4119/points.csv"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return BadInput{kind, {}, arguments, 2, pattern};
  };
  static const std::vector<BadInput> rows = {
      option("a decimal comma", {"--tolerance", "0,1"}, "--tolerance: '0,1' is not a number"),
      option("a hexadecimal number", {"--tolerance", "0x10"}, "--tolerance: '0x10' is not a number"),
      option("a hexadecimal exponent", {"--probe-radius", "0x1p3"}, "--probe-radius: '0x1p3' is not a number"),
      option("nothing", {"--tolerance", ""}, "--tolerance: '' is not a number"),
      option("a number with a unit that is none", {"--tolerance", "0.1km"},
             "--tolerance: '0.1km' is not a number, nor one with its unit"),
      option("a binary number", {"--least-points", "0b11"}, "--least-points: '0b11' is not a number"),
      option("more points than any", {"--least-points", "1e99"}, "--least-points: 1e\\+99 is out of range"),
      option("a coverage beyond reason", {"--coverage-factor", "1e9"}, "--coverage-factor: .*out of range"),
      option("a permissible error without K", {"--mpe", "1+L"}, "--mpe: '1\\+L' is not a largest permissible error"),
      option("an axis without a direction", {"--axis", "0,0,0,0,0,0"}, "--axis: '0,0,0,0,0,0' has no direction"),
      option("a window that ends before it begins", {"--window", "0.9:0.1"}, "--window: '0.9:0.1' is not a window"),
      option("a zone without length", {"--leading-edge", "auto:0mm"}, "--leading-edge: 'auto:0mm' is not a zone"),
      option("a patch that is not there", {"--leading-edge", "7:u:0:1"}, "--leading-edge: patch 7 is not there"),
      option("nothing free", {"--lock", "tx,ty,tz,rx,ry,rz"}, "--lock: all six degrees of freedom are locked"),
  };
  return rows;
}

TEST_F(BadInputs, OfDesignsAreRefusedInOneLineEach) { expect_refused(bad_designs()); }

TEST_F(BadInputs, OfMachinesAreRefusedInOneLineEach) { expect_refused(bad_machines()); }

TEST_F(BadInputs, OfNumbersAreRefusedInOneLineEach) { expect_refused(bad_numbers()); }

/// Zeros in front make no number octal.
TEST_F(BadInputs, ZerosInFrontOfANumberChangeNothing) {
  const auto points_of = [this](const std::string& seed) {
    const std::string out = scratch("out" + seed);
    const Outcome outcome = run(
        {BLADEFIT_COMMAND, "sample", filled("DESIGN"), "-o", out, "--grid", "3x3", "--noise", "00.1", "--seed", seed});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return read_whole(out);
  };
  EXPECT_EQ(points_of("010"), points_of("10"));
  EXPECT_NE(points_of("010"), points_of("8"));
}

}  // namespace
}  // namespace bladefit::testing

// An output never takes the place of what it is made from: exit code 2, one line with the fix, every file as it was.

#include <algorithm>
#include <fstream>
#include <iterator>

#include "tests/golden/command_fixture.hpp"

namespace bladefit::testing {
namespace {

const std::filesystem::path kData(BLADEFIT_TEST_DATA "/arl_fan");

class Overwriting : public CommandTest {
 protected:
  Overwriting() {
    std::filesystem::copy_file(kData / "design.igs", design_);
    std::filesystem::copy_file(kData / "subsets/061.csv", points_);
    write(subset_, "0\n1\n2\n3\n4\n5\n6\n");
    write(settings_, "[fit]\ntolerance = 0.1\n");
    write(pairs_, "x,y,z,design_x,design_y,design_z\n0,0,0,0,0,0\n1,0,0,1,0,0\n0,1,0,0,1,0\n");
    write(device_, "kind = \"replay\"\n[replay]\nfile = \"points.csv\"\n");
    write(session_file_, "device = \"device.toml\"\n[fit]\nstart = \"pairs.csv\"\n");
  }

  static void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

  static std::string content(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }

  /// The command must refuse to write over `kept`, and say that it is `what`.
  static void expect_kept(std::vector<std::string> arguments, const std::string& kept, const std::string& what) {
    const std::string before = content(kept);
    // A simulated machine that is not refused would serve for ever.
    arguments.insert(arguments.begin(), {"timeout", "30", BLADEFIT_COMMAND});
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_NE(outcome.output.find("would overwrite the " + what + "; give another name"), std::string::npos)
        << outcome.output;
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
    EXPECT_EQ(content(kept), before);
  }

  [[nodiscard]] std::vector<std::string> session(const std::string& folder, const std::string& json) const {
    return {"run",      "--headless",        "--panel",   "127.0.0.1:0", "--design", design_,
            "--source", "replay:" + points_, "--session", folder,        "--json",   json};
  }

  const std::string design_ = scratch("design.igs"), points_ = scratch("points.csv"), subset_ = scratch("subset.txt"),
                    settings_ = scratch("fit.toml"), pairs_ = scratch("pairs.csv"), device_ = scratch("device.toml"),
                    session_file_ = scratch("session.toml");
};

TEST_F(Overwriting, LocalizeKeepsWhatItReads) {
  const std::vector<std::pair<std::string, std::string>> inputs = {
      {design_, "design"}, {points_, "points"}, {subset_, "subset"}, {settings_, "settings"}, {pairs_, "start pairs"}};
  for (const auto& [path, what] : inputs) {
    expect_kept({"localize", "--design", design_, "--points", points_, "--subset", subset_, "--config", settings_,
                 "--start", pairs_, "--json", path},
                path, what);
  }
  std::filesystem::create_symlink(points_, scratch("link"));
  expect_kept({"localize", "--design", design_, "--points", points_, "--json", scratch("link")}, points_, "points");
}

TEST_F(Overwriting, RunKeepsWhatItReads) {
  const std::vector<std::pair<std::string, std::string>> inputs = {{design_, "design"},
                                                                   {points_, "recording"},
                                                                   {device_, "device file"},
                                                                   {session_file_, "session file"},
                                                                   {pairs_, "start pairs"}};
  for (const auto& [path, what] : inputs) {
    expect_kept({"run", "--headless", "--panel", "127.0.0.1:0", "--design", design_, "--config", session_file_,
                 "--session", scratch("s"), "--json", path},
                path, what);
  }
  EXPECT_FALSE(std::filesystem::exists(scratch("s")));
}

TEST_F(Overwriting, RunKeepsTheFilesOfTheSession) {
  const std::string folder = scratch("s");
  // Also where the folder is yet to be made.
  expect_kept(session(folder, scratch("./s/journal.bin")), folder + "/journal.bin", "journal of the session");
  EXPECT_FALSE(std::filesystem::exists(folder));
  const Outcome first = run([&] {
    std::vector<std::string> arguments = session(folder, folder + "/result.json");
    arguments.insert(arguments.begin(), BLADEFIT_COMMAND);
    return arguments;
  }());
  ASSERT_EQ(first.exit_code, 0) << first.output;
  EXPECT_NE(content(folder + "/result.json").find("converged"), std::string::npos);
  expect_kept(session(folder, folder + "/journal.bin"), folder + "/journal.bin", "journal of the session");
  expect_kept(session(folder, folder + "/verdicts.csv"), folder + "/verdicts.csv", "verdicts of the session");
}

/// The points lie where the session would put its verdicts.
TEST_F(Overwriting, TheSessionKeepsWhatItReads) {
  const std::string recording = scratch("verdicts.csv");
  std::filesystem::copy_file(points_, recording);
  expect_kept({"run", "--headless", "--panel", "127.0.0.1:0", "--design", design_, "--source", "replay:" + recording,
               "--session", scratch(".")},
              recording, "recording");
}

TEST_F(Overwriting, TheOtherCommandsKeepWhatTheyRead) {
  expect_kept({"split", design_, "-o", points_, "--at", "u:0.5", "--points", points_, "--subset", scratch("new.txt")},
              points_, "points");
  expect_kept({"simulate", "--points", points_, "--transport", "modbus-tcp", "--port", "0", "--stamp", points_},
              points_, "points");
  for (const std::string name : {"arl_fan", "arl_3patch", "pnsy_sub", "pnsy_3patch"}) {
    std::filesystem::create_directories(scratch("data/" + name));
    std::filesystem::copy_file(kData / ".." / name / "case.json", scratch("data/" + name + "/case.json"));
  }
  const std::string data = scratch("data/pnsy_sub/case.json");
  expect_kept({"reproduce", "--data", scratch("data"), "--table", "I", "--json", data}, data, "data");
}

}  // namespace
}  // namespace bladefit::testing

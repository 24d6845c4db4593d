// The memory of a session at its end does not grow with points that have no place in the fit.

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <fstream>
#include <sstream>

#include "tests/golden/command_fixture.hpp"

extern char** environ;

namespace bladefit::testing {
namespace {

/// The most memory that a command had at once [kB]; 0 where it could not be run.
double peak_kb_of(std::vector<std::string> arguments) {
  std::vector<char*> words;
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  posix_spawn_file_actions_t quiet{};
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&quiet, 2, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const bool begun = posix_spawn(&child, words[0], &quiet, nullptr, words.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&quiet);
  int status = 0;
  rusage usage{};
  if (!begun || wait4(child, &status, 0, &usage) != child || !WIFEXITED(status)) return 0;
  return static_cast<double>(usage.ru_maxrss);
}

/// The measured points of the blade, over and over until there are so many.
void write_points(const std::string& path, std::size_t count) {
  std::ifstream measured(BLADEFIT_TEST_DATA "/dtmb4119/points.csv");
  std::string line;
  std::getline(measured, line);
  std::ofstream file(path);
  file << line << '\n';
  std::vector<std::string> lines;
  while (std::getline(measured, line)) lines.push_back(line);
  for (std::size_t k = 0; k < count; ++k) file << lines[k % lines.size()] << '\n';
}

class SessionMemory : public CommandTest {};

TEST_F(SessionMemory, GrowsByLittleMoreThanTheRecordingThatIsReplayed) {
  const std::string config = scratch("session.toml");
  std::ofstream(config) << "capacity = 256\n";
  const auto peak_kb = [&](std::size_t count) {
    const std::string points = scratch("points.csv");
    write_points(points, count);
    const double peak =
        peak_kb_of({BLADEFIT_COMMAND, "run", "--config", config, "--design", BLADEFIT_TEST_DATA "/dtmb4119/design.igs",
                    "--source", "replay:" + points, "--tolerance", "0.05", "--session",
                    scratch("s" + std::to_string(count)), "--panel", "127.0.0.1:0", "--headless"});
    EXPECT_TRUE(std::filesystem::exists(scratch("s" + std::to_string(count)) + "/result.json")) << count;
    return peak;
  };
  constexpr std::size_t kSome = 20000, kMany = 60000;
  const double some = peak_kb(kSome), many = peak_kb(kMany);
  const double bytes_a_point = 1024 * (many - some) / (kMany - kSome);
  std::printf("%zu points %.0f kB, %zu points %.0f kB: %.0f bytes a point\n", kSome, some, kMany, many, bytes_a_point);
  EXPECT_GT(some, 0);
  // Up to kMostLookedAt points the fit itself grows. The recording is in memory, with its text while it is read. Rows
  // of the result were 760 bytes a point more.
  EXPECT_LT(bytes_a_point, 400);
}

}  // namespace
}  // namespace bladefit::testing

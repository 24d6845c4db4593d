#include "tools/files/run_program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <thread>

namespace bladefit {
namespace {

constexpr std::chrono::milliseconds kLook{20};
constexpr int kSignalled = 128;

/// What a program is started with.
class Start {
 public:
  Start() {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);  // so that its children are killed with it
  }
  ~Start() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  Start(const Start&) = delete;
  Start& operator=(const Start&) = delete;

  [[nodiscard]] std::optional<pid_t> go(const std::string& path, const std::vector<std::string>& arguments) {
    std::vector<char*> words = {const_cast<char*>(path.c_str())};
    for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    pid_t process = 0;
    if (posix_spawn(&process, path.c_str(), &actions_, &attributes_, words.data(), environ) != 0) return std::nullopt;
    return process;
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

std::optional<std::string> find_program(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "";
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    const std::string_view folder = rest.substr(0, colon);
    rest.remove_prefix(colon == std::string_view::npos ? rest.size() : colon + 1);
    std::string program = std::string(folder) + "/" + name;
    if (!folder.empty() && access(program.c_str(), X_OK) == 0) return program;
  }
  return std::nullopt;
}

std::optional<int> run_program(const std::string& path, const std::vector<std::string>& arguments,
                               std::chrono::seconds longest) {
  const std::optional<pid_t> process = Start().go(path, arguments);
  if (!process) return std::nullopt;
  const auto until = std::chrono::steady_clock::now() + longest;
  int status = 0;
  while (true) {
    const pid_t ended = waitpid(*process, &status, WNOHANG);
    if (ended == *process) return WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
    if (ended < 0 && errno != EINTR) return std::nullopt;
    if (std::chrono::steady_clock::now() > until) break;
    std::this_thread::sleep_for(kLook);
  }
  kill(-*process, SIGKILL);
  waitpid(*process, &status, 0);
  return std::nullopt;
}

}  // namespace bladefit

#pragma once
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace bladefit::hil {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

inline constexpr auto kPatience = 60s;  ///< after this a test fails instead of hanging

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Asks `condition` every two milliseconds until it holds or `patience` is over. Returns whether it held.
template <typename Condition>
bool eventually(Condition condition, std::chrono::milliseconds patience = kPatience) {
  const Clock::time_point until = Clock::now() + patience;
  while (!condition()) {
    if (Clock::now() >= until) return false;
    std::this_thread::sleep_for(2ms);
  }
  return true;
}

/// A folder of its own for a test, removed with it.
class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "bladefit-hil-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a folder for the test");
    folder_ = name;
  }
  ~Scratch() {
    std::error_code error;
    std::filesystem::remove_all(folder_, error);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  [[nodiscard]] std::string operator/(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

/// A real process whose two outputs go to files. It is killed when this object ends, or the test dies.
class Process {
 public:
  explicit Process(std::vector<std::string> arguments) : arguments_(std::move(arguments)) {
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("cannot start a process");
    if (pid_ == 0) become_child();
  }
  ~Process() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  [[nodiscard]] std::string out() const { return read_file(scratch_ / "out"); }
  [[nodiscard]] std::string err() const { return read_file(scratch_ / "err"); }
  void signal(int number) const {
    if (pid_ > 0) kill(pid_, number);
  }

  /// Kills it as a power cut would, and waits until it is gone.
  void power_off() {
    signal(SIGKILL);
    (void)exit_code();
  }

  /// Waits for the end. The exit code, or 128 + the signal that ended it; nothing when patience is over.
  [[nodiscard]] std::optional<int> exit_code(std::chrono::milliseconds patience = kPatience) {
    int status = 0;
    if (pid_ <= 0 || !eventually([&] { return waitpid(pid_, &status, WNOHANG) == pid_; }, patience))
      return std::nullopt;
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  /// True while it has not ended.
  [[nodiscard]] bool running() const { return pid_ > 0 && kill(pid_, 0) == 0 && !is_zombie(); }

  /// Waits until standard output holds `text`. Returns the rest of the line behind it; nothing when patience is over or
  /// the process has ended without it.
  [[nodiscard]] std::optional<std::string> wait_for(const std::string& text,
                                                    std::chrono::milliseconds patience = kPatience) const {
    std::string rest;
    const auto found = [&] {
      const std::string all = out();
      const std::size_t begin = all.find(text);
      const std::size_t end = begin == std::string::npos ? begin : all.find('\n', begin);
      if (end == std::string::npos) return false;
      rest = all.substr(begin + text.size(), end - begin - text.size());
      return true;
    };
    (void)eventually([&] { return found() || !running(); }, patience);
    return found() ? std::optional(rest) : std::nullopt;
  }

 private:
  [[noreturn]] void become_child() const {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(scratch_ / "out", O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    redirect(scratch_ / "err", O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
    std::vector<char*> pointers;
    for (const std::string& argument : arguments_) pointers.push_back(const_cast<char*>(argument.c_str()));
    pointers.push_back(nullptr);
    execvp(pointers[0], pointers.data());
    _exit(127);
  }

  static void redirect(const std::string& path, int flags, int descriptor) {
    const int file = open(path.c_str(), flags, 0600);
    if (file < 0 || dup2(file, descriptor) < 0) _exit(126);
    close(file);
  }

  [[nodiscard]] bool is_zombie() const {
    siginfo_t information{};
    return waitid(P_PID, static_cast<id_t>(pid_), &information, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           information.si_pid == pid_;
  }

  Scratch scratch_;
  std::vector<std::string> arguments_;
  pid_t pid_ = -1;
};

inline std::vector<std::string> operator+(std::vector<std::string> left, const std::vector<std::string>& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

inline std::string data_file(const std::string& name) { return std::string(BLADEFIT_TEST_DATA) + "/" + name; }

/// `bladefit simulate` with these options, up and serving.
class SimulatedMachine {
 public:
  explicit SimulatedMachine(const std::vector<std::string>& options)
      : process_(std::vector<std::string>{BLADEFIT_COMMAND, "simulate"} + options) {
    const std::optional<std::string> ready = process_.wait_for("simulate: serving ", 10s);
    if (!ready) throw std::runtime_error("the simulated machine did not start: " + process_.err());
    const std::size_t place = ready->find(" on ") + 4;
    address_ = ready->substr(place, ready->find(' ', place) - place);
  }

  /// HOST:PORT, or the path of the terminal.
  [[nodiscard]] const std::string& address() const { return address_; }
  [[nodiscard]] int port() const { return std::stoi(address_.substr(address_.find(':') + 1)); }
  [[nodiscard]] Process& process() { return process_; }

 private:
  Process process_;
  std::string address_;
};

}  // namespace bladefit::hil

#include "tests/support/process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>

namespace bladefit::hil {
namespace {

void redirect(const std::string& path, int flags, int descriptor) {
  const int file = open(path.c_str(), flags, 0600);
  if (file < 0 || dup2(file, descriptor) < 0) _exit(126);
  close(file);
}

bool is_zombie(pid_t pid) {
  siginfo_t information{};
  return waitid(P_PID, static_cast<id_t>(pid), &information, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         information.si_pid == pid;
}

}  // namespace

Process::Process(std::vector<std::string> arguments) : arguments_(std::move(arguments)) {
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("cannot start a process");
  if (pid_ == 0) become_child();
}

Process::~Process() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
}

void Process::signal(int number) const {
  if (pid_ > 0) kill(pid_, number);
}

void Process::power_off() {
  signal(SIGKILL);
  (void)exit_code();
}

std::optional<int> Process::exit_code(std::chrono::milliseconds patience) {
  int status = 0;
  if (pid_ <= 0 || !eventually([&] { return waitpid(pid_, &status, WNOHANG) == pid_; }, patience)) return std::nullopt;
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool Process::running() const { return pid_ > 0 && kill(pid_, 0) == 0 && !is_zombie(pid_); }

std::optional<std::string> Process::wait_for(const std::string& text, std::chrono::milliseconds patience) const {
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

void Process::become_child() const {
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

std::vector<std::string> operator+(std::vector<std::string> left, const std::vector<std::string>& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

std::string data_file(const std::string& name) { return std::string(BLADEFIT_TEST_DATA) + "/" + name; }

}  // namespace bladefit::hil

#include "bench/shell_command.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <thread>

extern char** environ;

namespace etendue::bench {
namespace {

// A file without a name that receives the standard error of a program.
class ErrorOutput {
 public:
  ErrorOutput() {
    char name[] = "/tmp/etendue-XXXXXX";
    descriptor_ = ::mkostemp(name, O_CLOEXEC);
    if (descriptor_ >= 0) ::unlink(name);
  }
  ~ErrorOutput() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  ErrorOutput(const ErrorOutput&) = delete;
  ErrorOutput& operator=(const ErrorOutput&) = delete;

  int descriptor() const { return descriptor_; }

  std::string last_line() const {
    constexpr off_t kMaxLength = 400;
    char text[kMaxLength];
    const off_t size = ::lseek(descriptor_, 0, SEEK_END);
    const ssize_t length = ::pread(descriptor_, text, sizeof text, std::max<off_t>(size - kMaxLength, 0));
    std::string line(text, static_cast<size_t>(std::max<ssize_t>(length, 0)));
    while (!line.empty() && line.back() == '\n') line.pop_back();
    return line.substr(line.rfind('\n') + 1);
  }

 private:
  int descriptor_ = -1;
};

// Starts a shell in a process group of its own; 0 if that fails.
pid_t start_shell(const std::string& command, int error_output) {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&files);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, error_output, STDERR_FILENO);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  const char* arguments[] = {"sh", "-c", command.c_str(), nullptr};
  pid_t child = 0;
  const int error = ::posix_spawn(&child, "/bin/sh", &files, &attributes, const_cast<char* const*>(arguments), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  return error == 0 ? child : 0;
}

}  // namespace

Result<double> run_shell_command(const std::string& command, const std::function<bool()>& keep_going) {
  constexpr auto kPollInterval = std::chrono::milliseconds(5);
  const ErrorOutput error_output;
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const pid_t child = start_shell(command, error_output.descriptor());
  if (child == 0) return output_error("cannot start a shell: " + std::string(std::strerror(errno)));
  int state = 0;
  while (::waitpid(child, &state, WNOHANG) == 0) {
    if (!keep_going()) {
      ::kill(-child, SIGKILL);
      ::waitpid(child, &state, 0);
      return Error{Fault::interrupted, "interrupted"};
    }
    std::this_thread::sleep_for(kPollInterval);
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (WIFEXITED(state) && WEXITSTATUS(state) == 0) return seconds;
  const std::string reason = WIFEXITED(state) ? "ended with exit code " + std::to_string(WEXITSTATUS(state))
                                              : "was ended by signal " + std::to_string(WTERMSIG(state));
  const std::string line = error_output.last_line();
  return output_error("the program " + reason + (line.empty() ? "" : ": " + line));
}

std::string shell_quoted(const std::string& text) {
  const bool is_plain = !text.empty() && text.find_first_not_of(
                                             "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                             "0123456789_-+=:,./@%") == std::string::npos;
  if (is_plain) return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

}  // namespace etendue::bench

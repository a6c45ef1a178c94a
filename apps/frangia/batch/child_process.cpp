#include "batch/child_process.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Starts the program; its standard input is empty.
pid_t start(const std::vector<std::string>& command,
            const std::filesystem::path& output,
            const std::filesystem::path& messages,
            int lock) {
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  for (std::string& word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW;
  constexpr mode_t kMode = 0666;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), kWrite, kMode);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, messages.c_str(), kWrite, kMode);
  // On itself, it is open in the child, too.
  if (lock >= 0) posix_spawn_file_actions_adddup2(&actions, lock, lock);
  // This program blocks the signals that stop it; the child does not. It has a process group of its
  // own, so that Ctrl-C reaches it through this program alone.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  pid_t child = -1;
  const int error =
      ::posix_spawnp(&child, arguments.front(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    throw Error(ErrorKind::File,
                fmt::format("{} cannot be started with its output in {}: {}",
                            command.front(),
                            output.string(),
                            std::system_category().message(error)));
  }
  return child;
}

}  // namespace

ChildResult run_child(const std::vector<std::string>& command,
                      const std::filesystem::path& output,
                      const std::filesystem::path& messages,
                      const std::stop_token& stop,
                      int lock) {
  using std::chrono::milliseconds;
  constexpr std::chrono::seconds kPatience{5};
  const Clock::time_point begin = Clock::now();
  const pid_t child = start(command, output, messages, lock);
  Clock::time_point asked{};
  for (;;) {
    int status = 0;
    rusage usage{};
    const pid_t ended = ::wait4(child, &status, WNOHANG, &usage);
    if (ended == child) {
      ChildResult result;
      result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
      result.processor_s = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
      result.memory_mb = static_cast<double>(usage.ru_maxrss) / 1024.0;
      return result;
    }
    if (ended < 0 && errno != EINTR)
      throw Error(ErrorKind::File, fmt::format("{} cannot be waited for", command.front()));
    if (stop.stop_requested()) {
      if (asked == Clock::time_point{}) {
        asked = Clock::now();
        ::kill(child, SIGTERM);
      } else if (Clock::now() - asked > kPatience) {
        ::kill(child, SIGKILL);
      }
    }
    std::this_thread::sleep_for(milliseconds(20));
  }
}

}  // namespace frangia

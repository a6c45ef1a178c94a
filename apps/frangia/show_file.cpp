#include "show_file.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <string>
#include <thread>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace frangia {
namespace {

bool run_xdg_open(const std::string& what, const std::stop_token& stop) {
  std::string program = "xdg-open";
  std::string argument = what;
  const std::array<char*, 3> arguments = {program.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
  // This program blocks the signals that stop it; the viewer does not.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  pid_t child = -1;
  const int error =
      ::posix_spawnp(&child, program.c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return false;
  for (;;) {
    constexpr std::chrono::milliseconds kInterval(20);
    int status = 0;
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child) return WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (ended < 0 && errno != EINTR) return false;
    if (stop.stop_requested()) return true;  // it shows it still
    std::this_thread::sleep_for(kInterval);
  }
}

}  // namespace

bool show_file(const std::filesystem::path& path, const std::stop_token& stop) {
  // Absolute, so that a name that begins with a dash is no option of xdg-open.
  return run_xdg_open(std::filesystem::absolute(path).string(), stop);
}

}  // namespace frangia

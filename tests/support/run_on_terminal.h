#pragma once

#include <array>
#include <string>

#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/run_program.h"

namespace frangia::testing {

/// The program with a pseudo-terminal as its input and output: it shows its progress and reads
/// `typed`.
inline Answer run_on_terminal(const std::string& arguments, const std::string& typed = {}) {
  const std::string command = std::string("exec ") + FRANGIA_PROGRAM + " " + arguments;
  Answer answer;
  int terminal = -1;
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child < 0) return answer;
  if (child == 0) {
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);  // NOLINT(*-vararg)
    ::_exit(127);
  }
  if (!typed.empty() && ::write(terminal, typed.data(), typed.size()) < 0) return answer;
  std::array<char, 4096> buffer{};
  for (ssize_t got = 0; (got = ::read(terminal, buffer.data(), buffer.size())) > 0;)
    answer.output.append(buffer.data(), static_cast<std::size_t>(got));
  int status = 0;
  ::waitpid(child, &status, 0);
  ::close(terminal);
  answer.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return answer;
}

}  // namespace frangia::testing

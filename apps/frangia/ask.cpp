#include "ask.h"

#include <cstdio>

#include <poll.h>
#include <unistd.h>

#include "terminal_text.h"

namespace frangia {

bool can_ask() {
  return ::isatty(STDIN_FILENO) != 0 && ::isatty(STDERR_FILENO) != 0;
}

bool ask(const std::string& question, const Run& run) {
  constexpr int kCheck_ms = 100;  // between checks for Ctrl-C
  static_cast<void>(
      std::fprintf(stderr, "%s [y/N] ", terminal_text(question).c_str()));  // NOLINT(*-vararg)
  static_cast<void>(std::fflush(stderr));
  std::string line;
  for (;;) {
    run.check();
    ::pollfd input{STDIN_FILENO, POLLIN, 0};
    if (::poll(&input, 1, kCheck_ms) <= 0) continue;
    char letter = 0;
    if (::read(STDIN_FILENO, &letter, 1) != 1 || letter == '\n') break;
    line += letter;
  }
  return line == "y" || line == "Y" || line == "yes";
}

}  // namespace frangia

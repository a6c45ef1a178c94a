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
  const std::string line = read_answer(question + " [y/N]", run).value_or("");
  return line == "y" || line == "Y" || line == "yes";
}

std::optional<std::string> read_answer(const std::string& prompt, const Run& run) {
  constexpr int kCheck_ms = 100;  // between checks for Ctrl-C
  static_cast<void>(
      std::fprintf(stderr, "%s ", terminal_text(prompt).c_str()));  // NOLINT(*-vararg)
  static_cast<void>(std::fflush(stderr));
  std::string line;
  for (;;) {
    run.check();
    ::pollfd input{STDIN_FILENO, POLLIN, 0};
    if (::poll(&input, 1, kCheck_ms) <= 0) continue;
    char letter = 0;
    if (::read(STDIN_FILENO, &letter, 1) != 1) {
      if (line.empty()) return std::nullopt;
      break;
    }
    if (letter == '\n') break;
    line += letter;
  }
  return line;
}

}  // namespace frangia

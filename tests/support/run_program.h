#pragma once

#include <array>
#include <cstdio>
#include <string>

#include <fmt/format.h>
#include <sys/wait.h>

namespace frangia::testing {

/// What a program said, and how it ended.
struct Answer {
  int exit_code = -1;
  std::string output;  ///< standard output and error
};

inline Answer run_shell(const std::string& script) {
  Answer answer;
  std::FILE* pipe = ::popen(("{ " + script + "; } 2>&1").c_str(), "r");  // NOLINT(cert-env33-c)
  std::array<char, 4096> buffer{};
  while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe))
    answer.output.append(buffer.data(), got);
  answer.exit_code = WEXITSTATUS(::pclose(pipe));
  return answer;
}

/// The program that was built with the tests.
inline Answer run_program(const std::string& arguments) {
  return run_shell(fmt::format("{} {}", FRANGIA_PROGRAM, arguments));
}

}  // namespace frangia::testing

#pragma once

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "frangia/core/image.h"

#include "support/run_program.h"

namespace frangia::testing {

/// An X server without a screen of its own, for this process while it lives; read back by xwd.
class TestScreen {
 public:
  /// `command` is the server's, without its display; a free one is chosen.
  explicit TestScreen(std::vector<std::string> command) {
    std::array<int, 2> pipe{};
    if (::pipe(pipe.data()) != 0) return;
    command.insert(command.end(),
                   {"-displayfd", std::to_string(pipe[1]), "-noreset", "-nolisten", "tcp"});
    process_ = ::fork();
    if (process_ == 0) run(command);
    ::close(pipe[1]);
    std::string number;
    for (char digit = 0; ::read(pipe[0], &digit, 1) == 1 && digit != '\n';)
      number += digit;
    ::close(pipe[0]);
    if (number.empty()) return;
    display_ = ":" + number;
    ::setenv("DISPLAY", display_.c_str(), 1);  // NOLINT(concurrency-mt-unsafe): no other thread
  }
  TestScreen(const TestScreen&) = delete;
  TestScreen& operator=(const TestScreen&) = delete;
  TestScreen(TestScreen&&) = delete;
  TestScreen& operator=(TestScreen&&) = delete;
  ~TestScreen() {
    ::unsetenv("DISPLAY");  // NOLINT(concurrency-mt-unsafe)
    if (process_ <= 0) return;
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
  }

  [[nodiscard]] bool runs() const { return !display_.empty(); }

  /// The green of all pixels of all its monitors, as they hang side by side.
  [[nodiscard]] Image<std::uint8_t> read_back(const std::filesystem::path& folder) const {
    const auto file = folder / "screen.xwd";
    const std::string command = "xwd -silent -root -display " + display_ + " -out " + file.string();
    if (run_shell(command).exit_code != 0) return {};
    std::ifstream in(file, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    const auto word = [&](std::size_t index) {  // the header is big-endian
      std::size_t value = 0;
      for (std::size_t i = 0; i < 4; ++i)
        value = 256 * value + static_cast<std::uint8_t>(bytes.at(4 * index + i));
      return value;
    };
    const std::size_t begin = word(0) + 12 * word(19);
    const std::size_t step = word(11) / 8;
    Image<std::uint8_t> green(static_cast<int>(word(4)), static_cast<int>(word(5)));
    for (int y = 0; y < green.height(); ++y) {
      for (int x = 0; x < green.width(); ++x) {
        const std::size_t place =
            begin + static_cast<std::size_t>(y) * word(12) + static_cast<std::size_t>(x) * step + 1;
        green(x, y) = static_cast<std::uint8_t>(bytes.at(place));
      }
    }
    return green;
  }

 private:
  [[noreturn]] static void run(const std::vector<std::string>& command) {
    std::vector<char*> words;
    words.reserve(command.size() + 1);
    for (const std::string& word : command)
      words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);  // NOLINT(*-vararg)
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
    ::execvp(words.front(), words.data());
    ::_exit(127);
  }

  ::pid_t process_ = -1;
  std::string display_;
};

}  // namespace frangia::testing

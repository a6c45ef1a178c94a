// Gives every seed and finding to its reader, without a fuzzer: `fuzz_replay fuzz/seeds
// fuzz/findings`. Each input may take 5 s and the program 2 GB; a crash, a hang or another
// exception than Error ends the program with the name of the input.
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

#include "readers.h"

namespace {

std::array<char, 4096> current{};  // read by the signal handler

void report_and_end(int signal) {
  const auto say = [](const char* text) {
    static_cast<void>(::write(STDERR_FILENO, text, std::strlen(text)));
  };
  say(signal == SIGALRM ? "more than 5 s: " : "crash: ");
  say(current.data());
  say("\n");
  ::_exit(1);
}

bool replay(const frangia::FuzzFolder& folder,
            const frangia::FuzzReader& reader,
            const std::filesystem::path& path) {
  constexpr unsigned kMaxSeconds = 5;
  std::ifstream stream(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  std::strncpy(current.data(), path.c_str(), current.size() - 1);
  ::alarm(kMaxSeconds);
  try {
    folder.run(reader, bytes);
  } catch (const std::exception& error) {
    static_cast<void>(
        std::fprintf(stderr, "%s: %s\n", path.c_str(), error.what()));  // NOLINT(*-vararg)
    return false;
  }
  ::alarm(0);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  for (const int signal : {SIGALRM, SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL})
    std::signal(signal, report_and_end);
#if !defined(__SANITIZE_ADDRESS__)
  constexpr ::rlim_t kMaxBytes = 2'000'000'000;
  const ::rlimit limit{kMaxBytes, kMaxBytes};
  static_cast<void>(::setrlimit(RLIMIT_DATA, &limit));
#endif
  const frangia::FuzzFolder folder;
  std::size_t inputs = 0;
  bool good = true;
  for (int i = 1; i < argc; ++i) {
    for (const frangia::FuzzReader& reader : frangia::fuzz_readers()) {
      const std::filesystem::path inputs_of = std::filesystem::path(argv[i]) / reader.name;
      if (!std::filesystem::is_directory(inputs_of)) continue;
      for (const auto& entry : std::filesystem::directory_iterator(inputs_of)) {
        good = replay(folder, reader, entry.path()) && good;
        ++inputs;
      }
    }
  }
  static_cast<void>(std::printf("%zu inputs\n", inputs));  // NOLINT(*-vararg)
  return good && inputs > 0 ? 0 : 1;
}

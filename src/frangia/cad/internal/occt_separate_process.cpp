#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <new>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "frangia/cad/internal/separate_process.h"

namespace frangia {
namespace {

constexpr char kUnitLine = 'u';
constexpr char kWarningLine = 'w';
constexpr char kErrorLine = 'e';
constexpr char kShapeFollows = 's';
constexpr std::string_view kComplete = "complete";

bool send(int pipe, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::write(pipe, bytes.data(), bytes.size());
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

/// Limits the memory beside what the process already maps.
void limit_memory([[maybe_unused]] double bytes) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  std::ifstream file("/proc/self/statm");
  double pages = 0.0;
  file >> pages;
  const double all = pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) + bytes;
  const rlimit limit{static_cast<rlim_t>(all), static_cast<rlim_t>(all)};
  ::setrlimit(RLIMIT_AS, &limit);
#endif
}

/// What the second process does; it never returns.
[[noreturn]] void answer(int pipe,
                         const std::filesystem::path& path,
                         const std::optional<double>& unit_mm,
                         double limit_bytes) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGSEGV, SIGABRT, SIGFPE, SIGBUS})
    ::signal(signal, SIG_DFL);
  const int nothing = ::open("/dev/null", O_RDWR);
  for (const int stream : {0, 1, 2})
    ::dup2(nothing, stream);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  limit_memory(limit_bytes);
  int code = 1;
  try {
    std::ostringstream shape;
    const CadTranslation said = translate_cad(path, unit_mm, shape);
    std::string head = fmt::format("{}{}\n", kUnitLine, said.unit);
    for (const std::string& warning : said.warnings)
      head += fmt::format("{}{}\n", kWarningLine, warning);
    head += said.error.empty() ? fmt::format("{}\n", kShapeFollows)
                               : fmt::format("{}{}\n", kErrorLine, said.error);
    if (send(pipe, head) && (!said.error.empty() || send(pipe, shape.view())) &&
        send(pipe, kComplete))
      code = 0;
  } catch (...) {  // the first process says what it means
  }
  ::_exit(code);
}

/// Ends the second process when the first one leaves it.
class Child {
 public:
  Child(pid_t process, int pipe) : process_(process), pipe_(pipe) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    ::close(pipe_);
    ::kill(process_, SIGKILL);
    while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }

  /// Everything that it says.
  [[nodiscard]] std::string heard(const MemoryBudget& budget, const Run& run) const {
    std::string all;
    std::array<char, 1U << 16U> part{};
    constexpr int kWaitMs = 100;
    for (;;) {
      run.check();
      pollfd ready{pipe_, POLLIN, 0};
      if (::poll(&ready, 1, kWaitMs) <= 0) continue;
      const ssize_t count = ::read(pipe_, part.data(), part.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return all;
      all.append(part.data(), static_cast<std::size_t>(count));
      budget.check(static_cast<double>(all.size()));
    }
  }

 private:
  pid_t process_;
  int pipe_;
};

TranslatedCad parsed(const std::string& all, const MemoryBudget& budget) {
  TranslatedCad found;
  if (!all.ends_with(kComplete)) {
    found.said.error = fmt::format(
        "it is damaged, or needs more than {} to read; export it again, or raise `allow_memory`",
        size_text(budget.limit_bytes()));
    return found;
  }
  std::size_t at = 0;
  for (;;) {
    const std::size_t end = all.find('\n', at);
    const char kind = all[at];
    const std::string text = all.substr(at + 1, end - at - 1);
    at = end + 1;
    if (kind == kUnitLine) found.said.unit = text;
    if (kind == kWarningLine) found.said.warnings.push_back(text);
    if (kind == kErrorLine) found.said.error = text;
    if (kind == kErrorLine || kind == kShapeFollows) break;
  }
  found.shape.str(all.substr(at, all.size() - at - kComplete.size()));
  return found;
}

}  // namespace

TranslatedCad translate_in_process(const std::filesystem::path& path,
                                   const std::optional<double>& unit_mm,
                                   const MemoryBudget& budget,
                                   const Run& run) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw Error(ErrorKind::File, "no second process can read the CAD file: no pipe is left");
  const pid_t process = ::fork();
  if (process < 0) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw Error(ErrorKind::File, "no second process can be started to read the CAD file");
  }
  if (process == 0) {
    ::close(ends[0]);
    answer(ends[1], path, unit_mm, budget.limit_bytes());
  }
  ::close(ends[1]);
  const Child child(process, ends[0]);
  return parsed(child.heard(budget, run), budget);
}

}  // namespace frangia

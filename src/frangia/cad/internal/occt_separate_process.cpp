#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <new>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "frangia/cad/internal/cad_answer.h"
#include "frangia/cad/internal/faces.h"
#include "frangia/cad/internal/occt_translate.h"
#include "frangia/cad/internal/separate_process.h"

namespace frangia {
namespace {

using Clock = std::chrono::steady_clock;

enum ExitCode : int { kAnswered = 0, kNoMemory = 3, kNoAnswer = 4 };

constexpr double kClockOverProcessor = 4.0;  // beside other work of the machine

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

/// Ends this process by SIGPROF after a processor time; the limit of the system, in whole seconds,
/// cannot be undone.
void limit_time(double seconds) {
  sigset_t timers;
  ::sigemptyset(&timers);
  for (const int signal : {SIGPROF, SIGXCPU}) {
    ::signal(signal, SIG_DFL);
    ::sigaddset(&timers, signal);
  }
  ::sigprocmask(SIG_UNBLOCK, &timers, nullptr);
  const double whole = std::floor(seconds);
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(whole);
  timer.it_value.tv_usec = static_cast<suseconds_t>(std::max(1.0, 1e6 * (seconds - whole)));
  ::setitimer(ITIMER_PROF, &timer, nullptr);
  const auto most = static_cast<rlim_t>(whole) + 2;
  const rlimit limit{most, most};
  ::setrlimit(RLIMIT_CPU, &limit);
}

/// What the second process does; it never returns.
[[noreturn]] void answer(int pipe,
                         const std::filesystem::path& path,
                         const CadRequest& asked,
                         const ProcessLimits& limits) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGSEGV, SIGABRT, SIGFPE, SIGBUS})
    ::signal(signal, SIG_DFL);
  const int nothing = ::open("/dev/null", O_RDWR);
  for (const int stream : {0, 1, 2})
    ::dup2(nothing, stream);
  // Files of the first process, such as locks and connections, end with it and not with this one.
  constexpr int kPipe = 3;
  if (pipe != kPipe) ::dup2(pipe, kPipe);
  ::close_range(kPipe + 1, ~0U, 0);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  limit_memory(limits.memory.limit_bytes());
  limit_time(limits.processor_s);
  int code = kNoAnswer;
  try {
    std::stringstream shape;
    CadTranslation said = translate_cad(path, asked, shape);
    try {
      if (said.error.empty()) rehearse_faces(shape);
    } catch (const Error& error) {
      said.error = error.what();
    }
    const auto to_pipe = [](std::string_view bytes) { return send(kPipe, bytes); };
    if (send_answer(said, shape.view(), to_pipe)) code = kAnswered;
  } catch (const std::bad_alloc&) {
    code = kNoMemory;
  } catch (...) {  // the first process says what it means
  }
  ::_exit(code);
}

/// How the second process ended.
struct ChildEnd {
  std::string heard;     ///< everything that it said
  int status = 0;        ///< as of waitpid
  bool is_late = false;  ///< it was ended on the clock
};

/// Ends the second process when the first one leaves it.
class Child {
 public:
  Child(pid_t process, int pipe) : process_(process), pipe_(pipe) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  Child(Child&&) = delete;
  Child& operator=(Child&&) = delete;
  ~Child() {
    ::close(pipe_);
    if (process_ > 0) static_cast<void>(end());
  }

  [[nodiscard]] ChildEnd listen(const ProcessLimits& limits, const Run& run) {
    ChildEnd found;
    const auto end_by =
        Clock::now() + std::chrono::duration<double>(kClockOverProcessor * limits.processor_s);
    std::array<char, 1U << 16U> part{};
    constexpr int kWaitMs = 100;
    for (;;) {
      run.check();
      found.is_late = Clock::now() > end_by;
      if (found.is_late) break;
      pollfd ready{pipe_, POLLIN, 0};
      if (::poll(&ready, 1, kWaitMs) <= 0) continue;
      const ssize_t count = ::read(pipe_, part.data(), part.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) break;
      found.heard.append(part.data(), static_cast<std::size_t>(count));
      // The shape is held twice when it is loaded.
      limits.memory.check(2.0 * static_cast<double>(found.heard.size()));
    }
    found.status = ended();
    return found;
  }

 private:
  /// The status of a process that has said everything; a moment later it is ended.
  int ended() {
    constexpr std::chrono::milliseconds kStep{5};
    constexpr int kSteps = 400;
    for (int i = 0; i < kSteps; ++i) {
      int status = 0;
      if (::waitpid(process_, &status, WNOHANG) == process_) {
        process_ = 0;
        return status;
      }
      std::this_thread::sleep_for(kStep);
    }
    return end();
  }

  int end() {
    ::kill(process_, SIGKILL);
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = 0;
    return status;
  }

  pid_t process_;  ///< 0: it has ended
  int pipe_;
};

/// Why there is no answer.
std::string cause_of(const ChildEnd& end, const ProcessLimits& limits) {
  const int signal = WIFSIGNALED(end.status) ? WTERMSIG(end.status) : 0;
  if (end.is_late || signal == SIGPROF || signal == SIGXCPU) {
    return fmt::format(
        "it takes more than {:.3g} s of processor time to read; export it again, or raise "
        "`allow_time_s`",
        limits.processor_s);
  }
  if (WIFEXITED(end.status) && WEXITSTATUS(end.status) == kNoMemory) {
    return fmt::format("it needs more than {} to read; export it again, or raise `allow_memory`",
                       size_text(limits.memory.limit_bytes()));
  }
  return fmt::format(
      "it is damaged, or needs more than {} to read; export it again, or raise `allow_memory`",
      size_text(limits.memory.limit_bytes()));
}

}  // namespace

TranslatedCad translate_in_process(const std::filesystem::path& path,
                                   const CadRequest& asked,
                                   const ProcessLimits& limits,
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
  if (process == 0) answer(ends[1], path, asked, limits);
  ::close(ends[1]);
  Child child(process, ends[0]);
  ChildEnd end = child.listen(limits, run);
  if (std::optional<TranslatedCad> found = parsed_answer(std::move(end.heard)))
    return std::move(*found);
  TranslatedCad refused;
  refused.said.error = cause_of(end, limits);
  return refused;
}

}  // namespace frangia

#include "interrupt.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <unistd.h>

namespace frangia {
namespace {

constexpr std::array kStopSignals = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};
/// Longer than all devices of a rig take to be made safe in parallel.
constexpr auto kMakeSafe = std::chrono::seconds(3);

volatile std::sig_atomic_t write_end = -1;  // of the pipe that wakes the signal thread
std::atomic<int> device_scopes = 0;

sigset_t set_of_stop_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : kStopSignals)
    sigaddset(&set, signal);
  return set;
}

/// Calls only write, which is async-signal-safe (signal-safety(7)). A library may have started
/// threads before `main` that do not block the signals, so a handler is needed besides the mask.
extern "C" void on_stop_signal(int signal) {
  const int saved_errno = errno;
  const char byte = static_cast<char>(signal);
  static_cast<void>(!::write(write_end, &byte, 1));
  errno = saved_errno;
}

void handle_all(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : kStopSignals)
    sigaction(signal, &action, nullptr);
}

/// Ends the program as the signal does by default. The guardian then makes the devices safe.
[[noreturn]] void end_by(int signal) {
  std::signal(signal, SIG_DFL);
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, signal);
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
  std::raise(signal);
  constexpr int kShellCode = 128;
  std::_Exit(kShellCode + signal);
}

void wait_until_safe() {
  const auto begin = std::chrono::steady_clock::now();
  while (device_scopes > 0 && std::chrono::steady_clock::now() - begin < kMakeSafe)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

/// The thread that receives the signals, requests the stop, and ends the program on a second one.
class SignalThread {
 public:
  SignalThread() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "cannot watch for Ctrl-C");
    read_end_ = ends[0];
    write_end = ends[1];
    handle_all(on_stop_signal);
    sigset_t blocked = set_of_stop_signals();
    sigaddset(&blocked, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &blocked, nullptr);
    thread_ = std::thread([this] { serve(); });
  }
  SignalThread(const SignalThread&) = delete;
  SignalThread& operator=(const SignalThread&) = delete;
  SignalThread(SignalThread&&) = delete;
  SignalThread& operator=(SignalThread&&) = delete;
  ~SignalThread() {
    handle_all(SIG_DFL);
    const char end = 0;
    static_cast<void>(!::write(write_end, &end, 1));
    thread_.join();
  }
  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

 private:
  void serve() {
    const sigset_t set = set_of_stop_signals();
    pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
    for (;;) {
      char signal = 0;
      const ssize_t count = ::read(read_end_, &signal, 1);
      if (count < 0 && errno == EINTR) continue;
      if (count != 1 || signal == 0) return;
      if (!source_.stop_requested()) {
        source_.request_stop();
        continue;
      }
      if (device_scopes > 0) {
        wait_until_safe();
        if (device_scopes == 0) continue;  // the program ends by itself
      }
      end_by(signal);
    }
  }

  std::stop_source source_;
  int read_end_ = -1;
  std::thread thread_;
};

const SignalThread& signal_thread() {
  static const SignalThread thread;
  return thread;
}

}  // namespace

void handle_signals() {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like a full disk
  static_cast<void>(signal_thread());
}

std::stop_token stop_on_signals() {
  return signal_thread().token();
}

DeviceScope::DeviceScope() {
  if (device_scopes++ == 0) std::signal(SIGTSTP, SIG_IGN);
}

DeviceScope::~DeviceScope() {
  if (--device_scopes == 0) std::signal(SIGTSTP, SIG_DFL);
}

bool reader_has_ended() {
  sigset_t pending;
  return sigpending(&pending) == 0 && sigismember(&pending, SIGPIPE) == 1;
}

void end_by_sigpipe() {
  end_by(SIGPIPE);
}

}  // namespace frangia

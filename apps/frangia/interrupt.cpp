#include "interrupt.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <unistd.h>

namespace frangia {
namespace {

constexpr std::array kStopSignals = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t write_end = -1;  // of the pipe that wakes the waiting thread

void handle_all(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : kStopSignals)
    sigaction(signal, &action, nullptr);
}

/// Calls only functions that are async-signal-safe (signal-safety(7)): sigaction and write.
/// Requesting a stop locks a mutex and runs callbacks, so a thread does it.
extern "C" void on_stop_signal(int /*signal*/) {
  const int saved_errno = errno;
  handle_all(SIG_DFL);
  const char byte = 0;
  static_cast<void>(!::write(write_end, &byte, 1));
  errno = saved_errno;
}

/// Waits on the other end of the pipe and requests the stop.
class SignalWatcher {
 public:
  SignalWatcher() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "cannot watch for Ctrl-C");
    read_end_ = ends[0];
    write_end = ends[1];
    thread_ = std::thread([this] {
      char byte = 0;
      if (::read(read_end_, &byte, 1) == 1) source_.request_stop();
    });
    handle_all(on_stop_signal);
  }
  SignalWatcher(const SignalWatcher&) = delete;
  SignalWatcher& operator=(const SignalWatcher&) = delete;
  SignalWatcher(SignalWatcher&&) = delete;
  SignalWatcher& operator=(SignalWatcher&&) = delete;
  ~SignalWatcher() {
    handle_all(SIG_DFL);
    ::close(write_end);  // ends the read
    thread_.join();
    ::close(read_end_);
  }
  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  int read_end_ = -1;
  std::thread thread_;
};

}  // namespace

std::stop_token stop_on_signals() {
  static const SignalWatcher watcher;
  return watcher.token();
}

}  // namespace frangia

#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

#include "frangia/devices/device.h"

namespace frangia {

/// A program that calls `run_guardian` with its file descriptor `kGuardianSocket`.
struct GuardianProgram {
  std::filesystem::path path;          ///< of the executable file
  std::vector<std::string> arguments;  ///< the first one is the name of the program
};

/// File descriptor on which a guardian process talks to the program that started it.
inline constexpr int kGuardianSocket = 3;

/// A process that switches devices off when this program dies for any reason, SIGKILL included.
///
/// The process holds duplicates of the open lines of the devices. It acts when its connection to
/// this program breaks without a farewell, and ends after that. It has its own session and blocks
/// all signals, so Ctrl-C and a hangup of the terminal do not reach it. A guardian must outlive the
/// devices that it watches. All functions may be called from any thread.
class Guardian {
 public:
  /// Starts no process until the first call of `watch`.
  explicit Guardian(GuardianProgram program) : program_(std::move(program)) {}
  Guardian(const Guardian&) = delete;
  Guardian& operator=(const Guardian&) = delete;
  Guardian(Guardian&&) = delete;
  Guardian& operator=(Guardian&&) = delete;
  /// Ends the process, which switches nothing off.
  ~Guardian();

  /// A line that the guardian holds. Releases it on destruction.
  class Watch {
   public:
    /// A watch of no line.
    Watch() = default;
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
    Watch(Watch&& other) noexcept;             ///< takes the line over
    Watch& operator=(Watch&& other) noexcept;  ///< releases its line and takes the other one over
    ~Watch();

   private:
    friend class Guardian;
    Watch(Guardian* guardian, int file) : guardian_(guardian), file_(file) {}
    Guardian* guardian_ = nullptr;
    int file_ = -1;
  };

  /// Makes the guardian hold a line. A second watch of the same line replaces its bytes.
  ///
  /// @errors   Error(Device) when the process does not start or has ended
  [[nodiscard]] Watch watch(const SafeOff& how);

 private:
  void start();
  void release(int file) noexcept;

  GuardianProgram program_;
  std::mutex mutex_;
  std::map<int, int> watches_;  ///< number of watches by file descriptor
  int socket_ = -1;
  pid_t process_ = -1;
};

/// The work of a guardian process: holds the lines that `Guardian` sends over `socket`, and
/// switches their devices off in parallel when the connection breaks.
///
/// @return   exit code of the process: 0 after a farewell or after it has acted, 2 when `socket` is
///           not the connection of a guardian
[[nodiscard]] int run_guardian(int socket = kGuardianSocket);

}  // namespace frangia

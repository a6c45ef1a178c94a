#pragma once

#include <cstddef>
#include <memory>

namespace frangia {

/// The system calls of the V4L2 camera; tests substitute a fake camera. Each returns as the system
/// call of its name: negative or null with errno on failure.
class V4l2System {
 public:
  V4l2System() = default;
  V4l2System(const V4l2System&) = delete;
  V4l2System& operator=(const V4l2System&) = delete;
  V4l2System(V4l2System&&) = delete;
  V4l2System& operator=(V4l2System&&) = delete;
  virtual ~V4l2System() = default;

  [[nodiscard]] virtual int open(const char* path) = 0;
  virtual void close(int file) = 0;
  [[nodiscard]] virtual int ioctl(int file, unsigned long request, void* argument) = 0;
  /// Null on failure.
  [[nodiscard]] virtual void* map(std::size_t length, int file, std::size_t offset) = 0;
  virtual void unmap(void* memory, std::size_t length) = 0;
  /// Positive when a frame is available; 0 when none arrived in time.
  [[nodiscard]] virtual int wait_readable(int file, int milliseconds) = 0;
  /// The clock of the frame time stamps.
  [[nodiscard]] virtual double now_s() = 0;
};

/// The system calls of the kernel.
[[nodiscard]] std::shared_ptr<V4l2System> kernel_v4l2();

}  // namespace frangia

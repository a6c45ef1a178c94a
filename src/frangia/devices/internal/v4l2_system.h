#pragma once

#include <cstddef>
#include <memory>

namespace frangia {

/// What the V4L2 camera asks of the operating system; a test stands in for a camera here. Each
/// answers as the system call of its name: below 0, or null, with errno set, when it failed.
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
  /// Null when it failed.
  [[nodiscard]] virtual void* map(std::size_t length, int file, std::size_t offset) = 0;
  virtual void unmap(void* memory, std::size_t length) = 0;
  /// Whether a frame can be had; 0 when none came within the time.
  [[nodiscard]] virtual int wait_readable(int file, int milliseconds) = 0;
  /// Of the clock that stamps the frames.
  [[nodiscard]] virtual double now_s() = 0;
};

/// The one of the kernel.
[[nodiscard]] std::shared_ptr<V4l2System> kernel_v4l2();

}  // namespace frangia

#include "frangia/devices/internal/v4l2_system.h"

#include <chrono>

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace frangia {
namespace {

class KernelV4l2 final : public V4l2System {
 public:
  [[nodiscard]] int open(const char* path) override {
    return ::open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC);  // NOLINT(*-vararg)
  }
  void close(int file) override { ::close(file); }
  [[nodiscard]] int ioctl(int file, unsigned long request, void* argument) override {
    return ::ioctl(file, request, argument);  // NOLINT(*-vararg)
  }
  [[nodiscard]] void* map(std::size_t length, int file, std::size_t offset) override {
    void* memory = ::mmap(
        nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, file, static_cast<::off_t>(offset));
    return memory == MAP_FAILED ? nullptr : memory;  // NOLINT: cast in the macro
  }
  void unmap(void* memory, std::size_t length) override { ::munmap(memory, length); }
  [[nodiscard]] int wait_readable(int file, int milliseconds) override {
    ::pollfd wanted{file, POLLIN, 0};
    return ::poll(&wanted, 1, milliseconds);
  }
  [[nodiscard]] double now_s() override {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
};

}  // namespace

std::shared_ptr<V4l2System> kernel_v4l2() {
  return std::make_shared<KernelV4l2>();
}

}  // namespace frangia

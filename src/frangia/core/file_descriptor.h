#pragma once

#include <utility>

#include <unistd.h>

namespace frangia {

/// A file descriptor that is closed at the end of its life.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  /// Takes a descriptor as open(2) returns it; negative: none.
  explicit FileDescriptor(int number) : number_(number) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  /// Leaves `other` without a descriptor.
  FileDescriptor(FileDescriptor&& other) noexcept : number_(other.release()) {}
  /// Closes the present descriptor and leaves `other` without one.
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~FileDescriptor() {
    if (number_ >= 0) ::close(number_);
  }

  [[nodiscard]] bool is_open() const { return number_ >= 0; }  ///< whether there is one
  [[nodiscard]] int number() const { return number_; }         ///< for calls of the system
  /// Gives the descriptor away, which the caller closes.
  [[nodiscard]] int release() { return std::exchange(number_, -1); }

 private:
  int number_ = -1;
};

}  // namespace frangia

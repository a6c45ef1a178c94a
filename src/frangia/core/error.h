#pragma once

#include <stdexcept>
#include <string>

namespace frangia {

/// The reader of an error wants to know whose turn it is: theirs, the disk's, the device's.
enum class ErrorKind { Input, File, Device, Numeric, Cancelled };

/// The one exception type of the library. `what()` is one sentence that names the file, key or
/// value and says what to do.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  [[nodiscard]] ErrorKind kind() const noexcept { return kind_; }

 private:
  ErrorKind kind_;
};

/// Throws Error(Input) unless `condition`. Use at the door of public functions.
inline void require(bool condition, const char* message) {
  if (!condition) throw Error(ErrorKind::Input, message);
}

}  // namespace frangia

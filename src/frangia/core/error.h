#pragma once

#include <stdexcept>
#include <string>

/// The public types and functions of all libraries.
namespace frangia {

/// The cause of an error, which decides the exit code of the program.
enum class ErrorKind {
  Input,     ///< a file, value or option that the user gave is wrong
  File,      ///< a file cannot be read or written
  Device,    ///< a device fails or does not answer in time
  Numeric,   ///< a computation has no trustworthy result
  Cancelled  ///< the user stopped the task
};

/// The only exception type of the library. `what()` is one sentence that names the file, key or
/// value and states what to do.
class Error : public std::runtime_error {
 public:
  /// `message` is returned by `what()`.
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  [[nodiscard]] ErrorKind kind() const noexcept { return kind_; }  ///< cause of the error

 private:
  ErrorKind kind_;
};

/// Throws Error(Input) unless `condition` holds. Public functions validate their arguments with it.
inline void require(bool condition, const char* message) {
  if (!condition) throw Error(ErrorKind::Input, message);
}

}  // namespace frangia

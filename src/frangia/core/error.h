#pragma once

#include <stdexcept>
#include <string>

namespace frangia {

/// The cause of an error, which decides the exit code of the program.
enum class ErrorKind { Input, File, Device, Numeric, Cancelled };

/// The only exception type of the library. `what()` is one sentence that names the file, key or
/// value and states what to do.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  [[nodiscard]] ErrorKind kind() const noexcept { return kind_; }

 private:
  ErrorKind kind_;
};

/// Throws Error(Input) unless `condition` holds. Public functions validate their arguments with it.
inline void require(bool condition, const char* message) {
  if (!condition) throw Error(ErrorKind::Input, message);
}

}  // namespace frangia

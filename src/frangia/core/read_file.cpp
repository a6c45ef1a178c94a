#include "frangia/core/read_file.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "frangia/core/error.h"
#include "frangia/core/file_descriptor.h"

namespace frangia {
namespace {

const char* kind_of(::mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a named pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

}  // namespace

std::vector<char> read_regular_file(const std::filesystem::path& path, std::size_t max_bytes) {
  const auto fail = [&](const std::string& what) {
    throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), what));
  };
  if (path.native().find('\0') != std::string::npos)
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: the name continues after a NUL character; rename the file", path.c_str()));
  struct ::stat state {};
  const FileDescriptor descriptor(
      ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));  // NOLINT(*-vararg)
  const int error = errno;
  const bool known = descriptor.is_open() ? ::fstat(descriptor.number(), &state) == 0
                                          : ::stat(path.c_str(), &state) == 0;
  if (known && !S_ISREG(state.st_mode))
    fail(fmt::format("is {}, not a file; replace it", kind_of(state.st_mode)));
  if (!known && (error == ENOENT || error == ENOTDIR)) fail("does not exist; check the path");
  if (!descriptor.is_open() || !known)
    fail(fmt::format("cannot be read: {}", std::generic_category().message(error)));
  const auto size = static_cast<std::size_t>(state.st_size);
  if (size > max_bytes)
    fail(fmt::format("has {} bytes, more than the {} bytes that it can need", size, max_bytes));
  std::vector<char> bytes(size);
  std::size_t done = 0;
  while (done < size) {
    const ::ssize_t got = ::read(descriptor.number(), bytes.data() + done, size - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("cannot be read; check the disk");
    if (got == 0) break;  // another process shortened the file
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return bytes;
}

std::string read_text_file(const std::filesystem::path& file, std::uint64_t max_bytes) {
  const auto fail = [&](const std::string& why) {
    throw Error(ErrorKind::Input, fmt::format("{}: {}", file.string(), why));
  };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) fail("there is no such file; check its name");
  if (!std::filesystem::is_regular_file(status)) fail("this is not a regular file; name a file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail("it cannot be opened; check its read permission");
  const std::uint64_t size = std::filesystem::file_size(file, error);
  if (error) fail("it cannot be read; check the disk");
  if (size > max_bytes) {
    fail(
        fmt::format("it has {} bytes, more than the {} of the largest file of its kind; check "
                    "that it is the right file",
                    size,
                    max_bytes));
  }
  std::string text(static_cast<std::size_t>(size), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream)
    fail("it cannot be read completely; check the disk, and whether another program is writing it");
  return text;
}

}  // namespace frangia

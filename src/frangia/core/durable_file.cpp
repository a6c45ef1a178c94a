#include "frangia/core/durable_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw Error(ErrorKind::File,
              fmt::format("{}: cannot be written: {}; free some space or check the disk",
                          path.string(),
                          std::generic_category().message(error)));
}

/// A descriptor that closes itself.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags)
      : value_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {  // NOLINT(*-vararg)
    if (value_ < 0) fail(path, errno);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() { ::close(value_); }
  [[nodiscard]] int get() const { return value_; }

 private:
  int value_;
};

void write_all(int file, const std::filesystem::path& path, std::span<const char> bytes) {
  while (!bytes.empty()) {
    const ::ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void sync_folder(const std::filesystem::path& path) {
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const Descriptor descriptor(folder, O_RDONLY | O_DIRECTORY);
  if (::fsync(descriptor.get()) != 0) fail(folder, errno);
}

}  // namespace

void write_durably(const std::filesystem::path& path, std::span<const char> bytes) {
  // One name for all attempts: a remnant of a killed program is written over.
  const auto temporary = path.parent_path() / fmt::format(".{}.tmp", path.filename().string());
  try {
    const Descriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
    write_all(file.get(), path, bytes);
    if (::fsync(file.get()) != 0) fail(path, errno);
    if (std::rename(temporary.c_str(), path.c_str()) != 0) fail(path, errno);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
  sync_folder(path);
}

DurableLog::DurableLog(std::filesystem::path path) : path_(std::move(path)) {
  std::ifstream in(path_, std::ios::binary);
  text_.assign(std::istreambuf_iterator<char>(in), {});
  const std::size_t end = text_.rfind('\n');
  text_.resize(end == std::string::npos ? 0 : end + 1);
  file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);  // NOLINT(*-vararg)
  if (file_ < 0) fail(path_, errno);
  const auto size = static_cast<::off_t>(text_.size());
  if (::ftruncate(file_, size) != 0 || ::lseek(file_, size, SEEK_SET) != size) {
    const int error = errno;
    ::close(file_);
    fail(path_, error);
  }
  sync_folder(path_);
}

DurableLog::~DurableLog() {
  ::close(file_);
}

void DurableLog::append(const std::string& line) {
  const std::string whole = line + "\n";
  write_all(file_, path_, whole);
  if (::fdatasync(file_) != 0) fail(path_, errno);
}

}  // namespace frangia

#include "frangia/core/durable_log.h"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/internal/parse_log.h"

namespace frangia {

DurableLog::DurableLog(std::filesystem::path path)
    : path_(std::move(path)),
      file_(::open(path_.c_str(),
                   O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC,  // NOLINT(*-vararg)
                   0644)) {
  if (file_ < 0) fail(errno);
  try {
    std::ifstream in(path_, std::ios::binary);
    ParsedLog log = parse_log(std::string(std::istreambuf_iterator<char>(in), {}));
    const auto size = static_cast<::off_t>(log.size);
    if (::ftruncate(file_, size) != 0 || ::lseek(file_, size, SEEK_SET) != size) fail(errno);
    if (log.lacks_newline) write("\n");
    lines_ = std::move(log.lines);
    sync_to_disk(folder_of(path_));
  } catch (...) {
    ::close(file_);
    throw;
  }
}

DurableLog::~DurableLog() {
  ::close(file_);
}

void DurableLog::append(const std::string& line) {
  const std::scoped_lock lock(mutex_);
  write(with_checksum(line) + "\n");
}

void DurableLog::write(const std::string& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ::ssize_t written = ::write(file_, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    done += static_cast<std::size_t>(written);
  }
  if (::fdatasync(file_) != 0) fail(errno);
}

void DurableLog::fail(int error) const {
  throw Error(ErrorKind::File,
              fmt::format("{}: cannot be written ({}); free some space or check the disk",
                          path_.string(),
                          std::generic_category().message(error)));
}

}  // namespace frangia

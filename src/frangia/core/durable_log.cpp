#include "frangia/core/durable_log.h"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "frangia/core/error.h"
#include "frangia/core/sync_to_disk.h"

namespace frangia {

DurableLog::DurableLog(std::filesystem::path path)
    : path_(std::move(path)),
      file_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644)) {  // NOLINT(*-vararg)
  if (file_ < 0) fail(errno);
  std::ifstream in(path_, std::ios::binary);
  text_.assign(std::istreambuf_iterator<char>(in), {});
  const std::size_t end = text_.rfind('\n');
  text_.resize(end == std::string::npos ? 0 : end + 1);
  const auto size = static_cast<::off_t>(text_.size());
  if (::ftruncate(file_, size) != 0 || ::lseek(file_, size, SEEK_SET) != size) {
    const int error = errno;
    ::close(file_);
    fail(error);
  }
  sync_to_disk(folder_of(path_));
}

DurableLog::~DurableLog() {
  ::close(file_);
}

void DurableLog::append(const std::string& line) {
  const std::string whole = line + "\n";
  std::size_t done = 0;
  while (done < whole.size()) {
    const ::ssize_t written = ::write(file_, whole.data() + done, whole.size() - done);
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

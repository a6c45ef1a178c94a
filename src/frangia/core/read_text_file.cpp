#include "frangia/core/read_text_file.h"

#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {

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

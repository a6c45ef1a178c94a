#include "frangia/files/internal/read_bytes.h"

#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {

std::string read_bytes(const std::filesystem::path& path) {
  const auto fail = [&](const char* why) {
    throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), why));
  };
  std::error_code error;
  if (!std::filesystem::exists(path, error)) fail("there is no such file; check its name");
  if (!std::filesystem::is_regular_file(path, error))
    fail("this is not a regular file; name a file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail("it cannot be opened; check its read permission");
  std::string bytes(static_cast<std::size_t>(std::filesystem::file_size(path)), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream)
    fail("it cannot be read completely; check the disk, and whether another program is writing it");
  return bytes;
}

}  // namespace frangia

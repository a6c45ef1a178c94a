#include "frangia/core/checksums.h"

#include <array>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sodium.h>
#include <zlib.h>

#include "frangia/core/error.h"

namespace frangia {

std::uint32_t crc32(std::span<const char> bytes) {
  const auto* data = reinterpret_cast<const Bytef*>(bytes.data());  // NOLINT: bytes are bytes
  return static_cast<std::uint32_t>(::crc32_z(0, data, bytes.size()));
}

namespace {

/// The state of a hash.
class Sha256 {
 public:
  Sha256() { crypto_hash_sha256_init(&state_); }

  void add(std::string_view bytes) {
    crypto_hash_sha256_update(
        &state_,
        reinterpret_cast<const unsigned char*>(bytes.data()),  // NOLINT(*-reinterpret-cast)
        bytes.size());
  }

  [[nodiscard]] std::string digits() {
    std::array<unsigned char, crypto_hash_sha256_BYTES> hash{};
    crypto_hash_sha256_final(&state_, hash.data());
    return fmt::format("{:02x}", fmt::join(hash, ""));
  }

 private:
  crypto_hash_sha256_state state_{};
};

}  // namespace

std::string sha256(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes);
  return hash.digits();
}

std::string sha256_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  Sha256 hash;
  std::string buffer(std::size_t{1} << 20U, '\0');
  while (file) {
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    hash.add(std::string_view(buffer).substr(0, static_cast<std::size_t>(file.gcount())));
  }
  if (!file.eof()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: it cannot be read to compute its checksum", path.string()));
  }
  return hash.digits();
}

}  // namespace frangia

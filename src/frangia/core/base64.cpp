#include "frangia/core/base64.h"

#include <sodium.h>

namespace frangia {

std::string encode_base64(std::string_view bytes) {
  // The length counts the zero at the end of a C string.
  std::string letters(sodium_base64_ENCODED_LEN(bytes.size(), sodium_base64_VARIANT_ORIGINAL),
                      '\0');
  sodium_bin2base64(
      letters.data(),
      letters.size(),
      reinterpret_cast<const unsigned char*>(bytes.data()),  // NOLINT(*-reinterpret-cast)
      bytes.size(),
      sodium_base64_VARIANT_ORIGINAL);
  letters.pop_back();
  return letters;
}

std::optional<std::string> decode_base64(std::string_view letters) {
  while (letters.ends_with('='))
    letters.remove_suffix(1);
  std::string bytes(letters.size() / 4 * 3 + 3, '\0');
  std::size_t length = 0;
  const int failed =
      sodium_base642bin(reinterpret_cast<unsigned char*>(bytes.data()),  // NOLINT(*-cast)
                        bytes.size(),
                        letters.data(),
                        letters.size(),
                        nullptr,
                        &length,
                        nullptr,
                        sodium_base64_VARIANT_ORIGINAL_NO_PADDING);
  if (failed != 0) return std::nullopt;
  bytes.resize(length);
  return bytes;
}

}  // namespace frangia

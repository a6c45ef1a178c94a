#include "frangia/service/internal/array_packer.h"

#include <bit>
#include <cstdint>

namespace frangia {

static_assert(std::endian::native == std::endian::little, "arrays are packed as they are stored");

std::string ArrayPacker::pack() const {
  constexpr std::size_t kOffsetDigits = 12;  // more than any offset has
  nlohmann::ordered_json header = header_;
  const std::size_t space = header.dump().size() + header_["arrays"].size() * kOffsetDigits;
  const std::size_t head =
      (sizeof(std::uint32_t) + space + kAlignment - 1) / kAlignment * kAlignment;
  for (auto& array : header["arrays"])
    array["offset"] = array["offset"].get<std::size_t>() + head;
  std::string text = header.dump();
  text.resize(head - sizeof(std::uint32_t), ' ');
  const auto length = static_cast<std::uint32_t>(text.size());
  std::string all(sizeof length, '\0');
  std::memcpy(all.data(), &length, sizeof length);
  return all + text + body_;
}

}  // namespace frangia

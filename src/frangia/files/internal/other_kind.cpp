#include "frangia/files/internal/other_kind.h"

#include <array>
#include <fstream>

namespace frangia {
namespace {

struct Kind {
  std::string_view begin;
  const char* sentence;
};

constexpr std::array<Kind, 10> kKinds{{
    {"\x1F\x8B", "it is compressed by gzip; unpack it with gunzip"},
    {"PK\x03\x04", "it is a zip archive; unpack it, and name the file inside"},
    {"BZh", "it is compressed by bzip2; unpack it with bunzip2"},
    {std::string_view("\xFD\x37zXZ\0", 6), "it is compressed by xz; unpack it with unxz"},
    {"\x28\xB5\x2F\xFD", "it is compressed by zstd; unpack it with unzstd"},
    {"7z\xBC\xAF\x27\x1C", "it is a 7z archive; unpack it, and name the file inside"},
    {"Rar!\x1A", "it is a RAR archive; unpack it, and name the file inside"},
    {"AC10", "it is a DWG drawing; save it as a text (ASCII) DXF"},
    {"ISO-10303-21", "it is a STEP file; name it .step, and use it as a reference"},
    {"%PDF", "it is a PDF; export the mesh itself"},
}};

}  // namespace

std::string other_kind_of(std::string_view head) {
  for (const Kind& kind : kKinds)
    if (head.starts_with(kind.begin)) return kind.sentence;
  return {};
}

std::string other_kind_of_file(const std::filesystem::path& path) {
  std::array<char, 16> head{};
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), head.size());
  return other_kind_of({head.data(), static_cast<std::size_t>(file.gcount())});
}

}  // namespace frangia

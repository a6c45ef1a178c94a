#include "frangia/files/internal/ply_header.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "frangia/files/internal/text_reader.h"

namespace frangia {
namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes{{
    {"char", PlyType::Int8},
    {"int8", PlyType::Int8},
    {"uchar", PlyType::Uint8},
    {"uint8", PlyType::Uint8},
    {"short", PlyType::Int16},
    {"int16", PlyType::Int16},
    {"ushort", PlyType::Uint16},
    {"uint16", PlyType::Uint16},
    {"int", PlyType::Int32},
    {"int32", PlyType::Int32},
    {"uint", PlyType::Uint32},
    {"uint32", PlyType::Uint32},
    {"float", PlyType::Float32},
    {"float32", PlyType::Float32},
    {"double", PlyType::Float64},
    {"float64", PlyType::Float64},
}};

PlyType read_type(TextReader& reader) {
  const std::string_view word = reader.word_on_line();
  const auto* const found = std::find_if(
      kTypes.begin(), kTypes.end(), [&](const auto& entry) { return entry.first == word; });
  if (found == kTypes.end())
    reader.fail(fmt::format("{} is not a number type of PLY", in_quotes(word)));
  return found->second;
}

PlyFormat read_format(TextReader& reader) {
  const std::string_view word = reader.word_on_line();
  if (word == "ascii") return PlyFormat::Ascii;
  if (word == "binary_little_endian") return PlyFormat::LittleEndian;
  if (word != "binary_big_endian") {
    reader.fail(
        fmt::format("the format is {}; it must be ascii, binary_little_endian or binary_big_endian",
                    in_quotes(word)));
  }
  return PlyFormat::BigEndian;
}

PlyElement read_element(TextReader& reader) {
  PlyElement element;
  element.name = reader.word_on_line();
  const std::int64_t count = reader.integer();
  if (count < 0)
    reader.fail(fmt::format("{} is not a valid count of {}", count, in_quotes(element.name)));
  element.count = static_cast<std::uint64_t>(count);
  return element;
}

PlyProperty read_property(TextReader& reader) {
  PlyProperty property;
  TextReader ahead = reader;
  if (ahead.word_on_line() == "list") {
    reader = ahead;
    property.count_type = read_type(reader);
  }
  property.type = read_type(reader);
  property.name = reader.word_on_line();
  return property;
}

bool is_type(std::string_view word) {
  return word == "list" || std::any_of(kTypes.begin(), kTypes.end(), [&](const auto& entry) {
           return entry.first == word;
         });
}

/// Whether a line without a keyword may be passed over: a blank one, or text as comments of several
/// lines leave it. Behind an element, a misspelt property or element has a type or a count in its
/// place, which a remark has not.
bool is_remark(TextReader reader, const PlyHeader& header, std::string_view keyword) {
  if (reader.bytes_left() == 0 || keyword == "property") return false;
  if (keyword.empty() || header.elements.empty()) return true;
  const std::string_view second = reader.word_on_line();
  const std::string_view third = reader.word_on_line();
  return !second.empty() && !is_type(second) && !parse_integer(third);
}

/// The header as lines that end with LF: old Macs end them with CR, also before binary data.
std::string header_of(std::string_view bytes) {
  constexpr std::string_view kEnd = "end_header";
  const std::size_t end = bytes.find(kEnd);
  std::string header(bytes.substr(0, end == std::string_view::npos ? end : end + kEnd.size() + 1));
  if (header.find('\n') == std::string::npos)
    std::replace(header.begin(), header.end(), '\r', '\n');
  return header;
}

}  // namespace

std::size_t bytes_of(PlyType type) {
  constexpr std::array<std::size_t, 8> kBytes{1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes.at(static_cast<std::size_t>(type));
}

PlyHeader parse_ply_header(const std::filesystem::path& path, std::string_view bytes) {
  const std::size_t mark = bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  const std::string lines = header_of(bytes.substr(mark));
  const bool old_mac = lines.find('\n') != std::string::npos && bytes.find('\n') > lines.size();
  TextReader reader(path, old_mac ? std::string_view(lines) : bytes.substr(mark));
  if (reader.word_on_line() != "ply")
    reader.fail("not a PLY file: it does not begin with the word ply");
  PlyHeader header;
  bool has_format = false;
  for (;;) {
    reader.skip_line();
    const std::string_view keyword = reader.word_on_line();
    if (keyword == "end_header") break;
    if (keyword == "format") {
      header.format = read_format(reader);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(read_element(reader));
    } else if (keyword == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(read_property(reader));
    } else if (keyword != "comment" && keyword != "obj_info" &&
               !is_remark(reader, header, keyword)) {
      reader.fail(fmt::format("{} is not a keyword of a PLY header", in_quotes(keyword)));
    }
  }
  if (!has_format) reader.fail("the header states no format");
  reader.skip_line();
  header.body = mark + reader.position();
  return header;
}

}  // namespace frangia

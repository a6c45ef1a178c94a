#include "frangia/dataset/stored_frames.h"

#include <charconv>
#include <span>
#include <sstream>
#include <string_view>

#include "frangia/core/crc32.h"
#include "frangia/core/read_text_file.h"

namespace frangia {
namespace {

bool parse_hex(std::string_view text, std::uint32_t& number) {
  constexpr int kBase = 16;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, kBase);
  return error == std::errc() && end == text.data() + text.size();
}

/// @missing  NaN for what is no number
double number_of(const std::string& text) {
  std::istringstream in(text);
  double number = 0.0;
  return in >> number ? number : kMissing;
}

/// Whether the checksum at the end of a line is right; it is then cut off.
bool take_checksum(std::string_view& line) {
  constexpr std::string_view kMark = " crc=";
  const std::size_t at = line.rfind(kMark);
  std::uint32_t stated = 0;
  if (at == std::string_view::npos || !parse_hex(line.substr(at + kMark.size()), stated))
    return false;
  line = line.substr(0, at);
  return crc32(std::span(line.data(), line.size())) == stated;
}

constexpr std::uint64_t kMostBytes = 200'000'000;  // a line has about 80

}  // namespace

double read_began_s(const std::filesystem::path& scan) {
  const auto file = scan / "capture" / kManifestName;
  if (!std::filesystem::exists(file)) return kMissing;
  constexpr std::string_view kBegan = "began ";
  std::istringstream lines(read_text_file(file, kMostBytes));
  for (std::string line; std::getline(lines, line);) {
    std::string_view text = line;
    if (text.starts_with(kBegan) && take_checksum(text))
      return number_of(std::string(text.substr(kBegan.size())));
  }
  return kMissing;
}

std::map<std::string, StoredFrame> read_stored_frames(const std::filesystem::path& scan) {
  const auto file = scan / "capture" / kManifestName;
  std::map<std::string, StoredFrame> frames;
  if (!std::filesystem::exists(file)) return frames;
  constexpr std::string_view kAt = "at=";
  std::istringstream lines(read_text_file(file, kMostBytes));
  for (std::string line; std::getline(lines, line);) {
    std::string_view text = line;
    if (!text.starts_with("frame ") || !take_checksum(text)) continue;
    std::istringstream words{std::string(text)};
    std::string kind;
    std::string name;
    std::string checksum;
    StoredFrame frame;
    if (!(words >> kind >> name >> checksum) || !parse_hex(checksum, frame.checksum)) continue;
    for (std::string word; words >> word;)
      if (word.starts_with(kAt)) frame.at_s = number_of(word.substr(kAt.size()));
    frames[name] = frame;  // a set that was captured again has a later line
  }
  return frames;
}

}  // namespace frangia

#include "frangia/files/internal/file_writer.h"

#include <array>
#include <charconv>

namespace frangia {
namespace {

template <typename Number>
std::string_view digits_of(Number value, std::array<char, 32>& space) {
  const auto end = std::to_chars(space.data(), space.data() + space.size(), value).ptr;
  return {space.data(), static_cast<std::size_t>(end - space.data())};
}

}  // namespace

FileWriter::FileWriter(const std::filesystem::path& path) : file_(path) {
  buffer_.reserve(kBlock + kBlock / 8);
}

void FileWriter::number(float value) {
  std::array<char, 32> space{};
  text(digits_of(value, space));
}

void FileWriter::number(std::size_t value) {
  std::array<char, 32> space{};
  text(digits_of(value, space));
}

void FileWriter::line(std::string_view keyword, const Eigen::Vector3f& vector) {
  text(keyword);
  for (const float coordinate : vector) {
    text(" ");
    number(coordinate);
  }
  text("\n");
}

void FileWriter::flush() {
  file_.stream().write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  buffer_.clear();
}

void FileWriter::commit() {
  flush();
  file_.commit();
}

}  // namespace frangia

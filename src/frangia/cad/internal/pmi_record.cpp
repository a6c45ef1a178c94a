#include "frangia/cad/internal/pmi_record.h"

#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace frangia {
namespace {

constexpr std::size_t kFields = 8;
constexpr std::size_t kMostFacesOfOne = 30;
constexpr std::size_t kMostFaceNumber = 1'000'000;
constexpr std::size_t kMostName = 40;

std::string word(std::string_view text) {
  std::string out(text.substr(0, kMostName));
  for (char& letter : out)
    if (letter < ' ' || letter > '~' || letter == ',') letter = '_';
  return out;
}

std::string number_text(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "";
}

std::string faces_text(std::vector<std::size_t> faces) {
  if (faces.size() > kMostFacesOfOne) faces.resize(kMostFacesOfOne);
  return fmt::format("{}", fmt::join(faces, ","));
}

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  if (text.empty()) return parts;
  for (;;) {
    const std::size_t end = text.find(at);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

template <typename Number>
bool read(std::string_view text, Number& value) {
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ec == std::errc() && result.ptr == text.data() + text.size();
}

/// A number, or none for an empty text.
bool read_number(std::string_view text, double& value) {
  return text.empty() || (read(text, value) && std::isfinite(value));
}

bool read_faces(std::string_view text, std::vector<std::size_t>& faces) {
  for (const std::string_view part : split(text, ',')) {
    std::size_t face = 0;
    if (!read(part, face) || face == 0 || face > kMostFaceNumber || faces.size() == kMostFacesOfOne)
      return false;
    faces.push_back(face);
  }
  return true;
}

}  // namespace

std::string pmi_record(const CadRequirement& requirement) {
  std::vector<std::string> datums;
  for (const std::string& name : requirement.datums)
    if (datums.size() < 3) datums.push_back(word(name));
  return fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}",
                     static_cast<unsigned>(requirement.kind),
                     word(requirement.name),
                     number_text(requirement.value),
                     number_text(requirement.lower),
                     number_text(requirement.upper),
                     faces_text(requirement.faces),
                     faces_text(requirement.other_faces),
                     fmt::join(datums, ","));
}

std::optional<CadRequirement> parsed_pmi_record(std::string_view line) {
  const auto fields = split(line, '\t');
  if (fields.size() != kFields) return std::nullopt;
  unsigned kind = 0;
  CadRequirement found;
  if (!read(fields[0], kind) || kind >= names_of(CadRequirementKind{}).size()) return std::nullopt;
  found.kind = static_cast<CadRequirementKind>(kind);
  found.name = word(fields[1]);
  if (!read_number(fields[2], found.value) || !read_number(fields[3], found.lower) ||
      !read_number(fields[4], found.upper) || !read_faces(fields[5], found.faces) ||
      !read_faces(fields[6], found.other_faces))
    return std::nullopt;
  for (const std::string_view datum : split(fields[7], ','))
    found.datums.push_back(word(datum));
  return found;
}

}  // namespace frangia

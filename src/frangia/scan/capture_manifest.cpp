#include "frangia/scan/capture_manifest.h"

#include <fstream>
#include <iterator>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

std::uint32_t checksum_of(std::span<const char> bytes) {
  return static_cast<std::uint32_t>(
      ::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));  // NOLINT
}

}  // namespace

CaptureManifest::CaptureManifest(const std::filesystem::path& folder)
    : folder_(folder), log_(folder / "capture-manifest.txt") {
  std::istringstream lines(log_.text());
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);)
    read_line(line, ++number);
}

void CaptureManifest::read_line(const std::string& line, std::size_t number) {
  std::istringstream words(line);
  std::string kind;
  std::string name;
  words >> kind;
  if (kind == "frame") {
    ManifestFrame frame;
    std::string scale;
    words >> name >> std::hex >> frame.checksum >> std::dec >> frame.bytes >> scale;
    if (words && scale.rfind("scale=", 0) == 0) {
      frame.drive_scale = std::stod(scale.substr(6));
      frames_[name] = frame;
      return;
    }
  } else if (kind == "retake") {
    int attempt = 0;
    if (words >> name >> attempt) {
      drop_set(name);
      attempts_[name] = attempt;
      return;
    }
  } else if (kind == "exposure") {
    double exposure_ms = 0.0;
    if (words >> exposure_ms) {
      exposure_ms_ = exposure_ms;
      return;
    }
  }
  throw Error(ErrorKind::Input,
              fmt::format("{}: line {} makes no sense; begin the scan in a new folder",
                          (folder_ / "capture-manifest.txt").string(),
                          number));
}

void CaptureManifest::drop_set(const std::string& set) {
  const std::string begin = set + "-";
  std::erase_if(frames_, [&](const auto& entry) { return entry.first.rfind(begin, 0) == 0; });
}

void CaptureManifest::store(const std::string& file,
                            std::span<const char> bytes,
                            double drive_scale) {
  const ManifestFrame frame{checksum_of(bytes), bytes.size(), drive_scale};
  write_durably(folder_ / file, bytes);
  log_.append(fmt::format(
      "frame {} {:08x} {} scale={}", file, frame.checksum, frame.bytes, frame.drive_scale));
  frames_[file] = frame;
}

void CaptureManifest::retake(const std::string& set, int attempt) {
  log_.append(fmt::format("retake {} {}", set, attempt));
  drop_set(set);
  attempts_[set] = attempt;
}

void CaptureManifest::choose_exposure(double exposure_ms) {
  log_.append(fmt::format("exposure {}", exposure_ms));
  exposure_ms_ = exposure_ms;
}

const ManifestFrame* CaptureManifest::find(const std::string& file) const {
  const auto found = frames_.find(file);
  return found == frames_.end() ? nullptr : &found->second;
}

int CaptureManifest::attempt_of(const std::string& set) const {
  const auto found = attempts_.find(set);
  return found == attempts_.end() ? 0 : found->second;
}

std::size_t CaptureManifest::forget_damaged() {
  return std::erase_if(frames_, [&](const auto& entry) {
    std::ifstream in(folder_ / entry.first, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    return bytes.size() != entry.second.bytes || checksum_of(bytes) != entry.second.checksum;
  });
}

}  // namespace frangia

#include "frangia/acquisition/internal/capture_manifest.h"

#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/atomic_file.h"
#include "frangia/core/crc32.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

/// A stream of the value of "key=12"; an empty stream for another key.
std::istringstream value_of(const std::string& word, const std::string& key) {
  const bool is_it = word.rfind(key + "=", 0) == 0;
  return std::istringstream(is_it ? word.substr(key.size() + 1) : std::string());
}

}  // namespace

CaptureManifest::CaptureManifest(std::filesystem::path folder)
    : folder_(std::move(folder)), log_(folder_ / "capture" / "manifest.txt") {
  std::istringstream lines(log_.text());
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);)
    read_line(line, ++number);
}

void CaptureManifest::read_line(const std::string& line, std::size_t number) {
  std::istringstream words(line);
  std::string kind;
  std::string name;
  std::string attempts;
  std::string last;
  words >> kind;
  if (kind == "frame") {
    ManifestFrame frame;
    words >> name >> std::hex >> frame.checksum >> std::dec >> frame.bytes >> attempts >> last;
    if (words && value_of(attempts, "attempts") >> frame.attempts &&
        value_of(last, "scale") >> frame.scale) {
      frames_[name] = frame;
      return;
    }
  } else if (kind == "set") {
    ManifestSet set;
    std::string outcome;
    words >> name >> set.attempt >> outcome >> last;
    set.moved = outcome == "moved";
    if (words && value_of(last, "scale") >> set.scale) return add(name, set);
  } else if (kind == "exposures") {
    exposures_ms_.assign(std::istream_iterator<double>(words), {});
    if (!exposures_ms_.empty()) return;
  }
  throw Error(ErrorKind::Input,
              fmt::format("{}: line {} cannot be read; start the scan in a new folder",
                          (folder_ / "capture" / "manifest.txt").string(),
                          number));
}

void CaptureManifest::add(const std::string& set, const ManifestSet& outcome) {
  sets_[set] = outcome;
  scale_ = outcome.scale;
  if (!outcome.moved) return;
  ++retakes_;
  const std::string begin = set + "-";
  std::erase_if(frames_, [&](const auto& entry) { return entry.first.rfind(begin, 0) == 0; });
}

void CaptureManifest::store(const std::string& file,
                            std::span<const char> bytes,
                            ManifestFrame frame) {
  frame.checksum = crc32(bytes);
  frame.bytes = bytes.size();
  AtomicFile out(folder_ / file, Durability::Synced);
  out.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.commit();
  log_.append(fmt::format("frame {} {:08x} {} attempts={} scale={}",
                          file,
                          frame.checksum,
                          frame.bytes,
                          frame.attempts,
                          frame.scale));
}

const ManifestFrame* CaptureManifest::find(const std::string& file) const {
  const auto found = frames_.find(file);
  return found == frames_.end() ? nullptr : &found->second;
}

void CaptureManifest::store(const std::string& set, const ManifestSet& outcome) {
  log_.append(fmt::format("set {} {} {} scale={}",
                          set,
                          outcome.attempt,
                          outcome.moved ? "moved" : "good",
                          outcome.scale));
}

void CaptureManifest::add_exposures(const std::vector<double>& exposures_ms) {
  log_.append(fmt::format("exposures {}", fmt::join(exposures_ms, " ")));
  exposures_ms_ = exposures_ms;
}

bool CaptureManifest::is_good(const std::string& set) const {
  const auto found = sets_.find(set);
  return found != sets_.end() && !found->second.moved;
}

int CaptureManifest::attempt_of(const std::string& set) const {
  const auto found = sets_.find(set);
  if (found == sets_.end()) return 0;
  return found->second.moved ? found->second.attempt + 1 : found->second.attempt;
}

std::size_t CaptureManifest::retries() const {
  std::size_t retries = 0;
  for (const auto& [file, frame] : frames_)
    retries += static_cast<std::size_t>(frame.attempts - 1);
  return retries;
}

std::size_t CaptureManifest::forget_damaged() {
  return std::erase_if(frames_, [&](const auto& entry) {
    std::ifstream in(folder_ / entry.first, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    return bytes.size() != entry.second.bytes || crc32(bytes) != entry.second.checksum;
  });
}

}  // namespace frangia

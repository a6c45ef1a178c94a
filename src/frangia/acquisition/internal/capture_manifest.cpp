#include "frangia/acquisition/internal/capture_manifest.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/checksums.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/open_below.h"
#include "frangia/core/read_file.h"

namespace frangia {
namespace {

/// A stream of the value of "key=12"; an empty stream for another key.
std::istringstream value_of(const std::string& word, const std::string& key) {
  const bool is_it = word.rfind(key + "=", 0) == 0;
  return std::istringstream(is_it ? word.substr(key.size() + 1) : std::string());
}

double seconds_since_1970() {
  const std::chrono::duration<double> time = std::chrono::system_clock::now().time_since_epoch();
  return time.count();
}

std::string plan_line(const std::string& name, std::uint32_t checksum) {
  return fmt::format("plan {} {:08x}", name, checksum);
}

}  // namespace

void CaptureManifest::begin(const std::filesystem::path& file, const PlanChecksums& plan) {
  DurableLog log(file);
  for (const auto& [name, checksum] : plan)
    log.append(plan_line(name, checksum));
  log.append(fmt::format("began {:.3f}", seconds_since_1970()));
}

double CaptureManifest::seconds_since_begin() const {
  const std::chrono::duration<double> open = Clock::now() - opened_at_;
  return std::max(0.0, opened_s_ - began_s_) + open.count();
}

CaptureManifest::CaptureManifest(std::filesystem::path folder)
    : folder_(std::move(folder)),
      log_(path_below(folder_, std::filesystem::path("capture") / kFileName)),
      opened_s_(seconds_since_1970()) {
  std::size_t number = 0;
  for (const LogLine& line : log_.lines()) {
    ++number;
    if (line.damaged) {
      ++damaged_lines_;
      last_damaged_ = number;
    } else {
      read_line(line.text, number);
    }
  }
}

void CaptureManifest::read_line(const std::string& line, std::size_t number) {
  std::istringstream words(line);
  std::string kind;
  words >> kind;
  bool known = false;
  if (kind == "frame") {
    known = read_frame(words);
  } else if (kind == "set") {
    known = read_set(words, number);
  } else if (kind == "table") {
    known = read_table(words);
  } else if (kind == "exposures") {
    exposures_ms_.assign(std::istream_iterator<double>(words), {});
    known = !exposures_ms_.empty();
  } else if (kind == "began") {
    known = static_cast<bool>(words >> began_s_);
  } else if (kind == "plan") {
    std::string name;
    std::uint32_t checksum = 0;
    known = static_cast<bool>(words >> name >> std::hex >> checksum);
    plan_[name] = checksum;
  }
  if (known) return;
  throw Error(ErrorKind::Input,
              fmt::format("{}: line {} is of a newer version of the program; update it, or start "
                          "the scan in a new folder",
                          (folder_ / "capture" / kFileName).string(),
                          number));
}

bool CaptureManifest::read_frame(std::istream& words) {
  ManifestFrame frame;
  std::string name;
  std::string attempts;
  std::string scale;
  words >> name >> std::hex >> frame.checksum >> std::dec >> frame.bytes >> attempts >> scale;
  if (!words || !(value_of(attempts, "attempts") >> frame.attempts) ||
      !(value_of(scale, "scale") >> frame.scale))
    return false;
  if (std::string at; words >> at) value_of(at, "at") >> frame.at_s;
  frames_[name] = frame;
  return true;
}

bool CaptureManifest::read_set(std::istream& words, std::size_t number) {
  ManifestSet set;
  std::string name;
  std::string outcome;
  std::string scale;
  words >> name >> set.attempt >> outcome >> scale;
  if (!words || !(value_of(scale, "scale") >> set.scale)) return false;
  set.moved = outcome == "moved";
  if (set.moved) rejected_at_[name] = number;
  add(name, set);
  return true;
}

bool CaptureManifest::read_table(std::istream& words) {
  std::string state;
  double angle_deg = 0.0;
  if (!(words >> state >> angle_deg)) return false;
  if (state == "moving") {
    table_.intended_deg = angle_deg;
  } else {
    table_ = {.reached_deg = angle_deg, .intended_deg = std::nullopt};
  }
  return true;
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
  write_text_file(path_below(folder_, file), {bytes.data(), bytes.size()}, Durability::Synced);
  append(file, frame);
}

void CaptureManifest::append(const std::string& file, const ManifestFrame& frame) {
  log_.append(fmt::format("frame {} {:08x} {} attempts={} scale={}{}",
                          file,
                          frame.checksum,
                          frame.bytes,
                          frame.attempts,
                          frame.scale,
                          std::isnan(frame.at_s) ? "" : fmt::format(" at={:.3f}", frame.at_s)));
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
  // The frames can replace any other line, but not this one. A wrong line end damages two lines.
  constexpr int kCopies = 3;
  for (int copy = 0; copy < kCopies; ++copy)
    log_.append(fmt::format("exposures {}", fmt::join(exposures_ms, " ")));
  exposures_ms_ = exposures_ms;
}

void CaptureManifest::add_recovered(const std::string& file, std::span<const char> bytes) {
  const ManifestFrame frame{.checksum = crc32(bytes), .bytes = bytes.size()};
  append(file, frame);
  frames_[file] = frame;
}

void CaptureManifest::change_plan(const std::string& name, std::uint32_t checksum) {
  log_.append(plan_line(name, checksum));
  plan_[name] = checksum;
}

void CaptureManifest::add_table_move(double target_deg) {
  log_.append(fmt::format("table moving {}", target_deg));
  table_.intended_deg = target_deg;
}

void CaptureManifest::add_table_at(double angle_deg) {
  log_.append(fmt::format("table at {}", angle_deg));
  table_ = {.reached_deg = angle_deg, .intended_deg = std::nullopt};
}

bool CaptureManifest::may_lack_frames_of(const std::string& set) const {
  const auto rejected = rejected_at_.find(set);
  return damaged_lines_ > 0 && (rejected == rejected_at_.end() || last_damaged_ > rejected->second);
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
    try {
      const std::vector<char> bytes = read_regular_file(path_below(folder_, entry.first));
      return bytes.size() != entry.second.bytes || crc32(bytes) != entry.second.checksum;
    } catch (const Error&) {
      return true;
    }
  });
}

}  // namespace frangia

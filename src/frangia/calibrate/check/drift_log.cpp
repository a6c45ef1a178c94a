#include "frangia/calibrate/check/drift_log.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/durable_log.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

constexpr const char* kMark = "drift";  // the first word of a line, for later kinds

/// A text that a tab or a line end does not split.
std::string flat(std::string text) {
  for (char& one : text) {
    if (static_cast<unsigned char>(one) < ' ') one = ' ';
  }
  return text;
}

/// The fields of a line; empty unless it is one of figures.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, '\t');)
    fields.push_back(field);
  constexpr std::size_t kFields = 8;
  if (fields.size() != kFields || fields.front() != kMark) return {};
  return fields;
}

bool to_number(const std::string& text, double& number) {
  std::istringstream in(text);
  return static_cast<bool>(in >> number);
}

/// Adds the figure of a line to the entry of its scan.
bool add_line(std::vector<DriftEntry>& entries, const std::string& line) {
  const std::vector<std::string> fields = fields_of(line);
  if (fields.empty()) return false;
  double time_s = 0.0;
  RigCheckItem item;
  item.name = fields[4];
  if (!to_number(fields[1], time_s) || !to_number(fields[5], item.deviation_mm) ||
      !to_number(fields[6], item.sigma_mm) || !to_number(fields[7], item.limit_mm))
    return false;
  const auto same = std::find_if(entries.begin(), entries.end(), [&](const DriftEntry& entry) {
    return entry.time_s == time_s && entry.scan == fields[2];
  });
  DriftEntry& entry = same == entries.end() ? entries.emplace_back() : *same;
  entry.time_s = time_s;
  entry.scan = fields[2];
  entry.kind = fields[3];
  const auto known = std::find_if(entry.items.begin(), entry.items.end(), [&](const auto& other) {
    return other.name == item.name;
  });
  if (known == entry.items.end()) entry.items.push_back(std::move(item));
  return true;
}

}  // namespace

std::filesystem::path drift_log_path(const std::filesystem::path& rig) {
  std::filesystem::path log = rig;
  return log.replace_extension(".drift.txt");
}

std::vector<DriftEntry> read_drift_log(const std::filesystem::path& log, const Run& run) {
  std::vector<DriftEntry> entries;
  if (!std::filesystem::exists(log)) return entries;
  std::size_t damaged = 0;
  const DurableLog file(log);
  for (const LogLine& line : file.lines()) {
    if (line.damaged || !add_line(entries, line.text)) ++damaged;
  }
  if (damaged > 0) {
    run.warn(fmt::format(
        "{}: {} of {} lines are damaged and not used", log.string(), damaged, file.lines().size()));
  }
  std::stable_sort(entries.begin(), entries.end(), [](const auto& one, const auto& other) {
    return one.time_s < other.time_s;
  });
  return entries;
}

void append_drift(const std::filesystem::path& log, const DriftEntry& entry) {
  DurableLog file(log);
  // In milliseconds, as it reads them back.
  const std::string time = fmt::format("{:.3f}", entry.time_s);
  std::vector<DriftEntry> before;
  for (const LogLine& line : file.lines()) {
    if (!line.damaged) add_line(before, line.text);
  }
  double written_s = 0.0;
  to_number(time, written_s);
  const bool known = std::any_of(before.begin(), before.end(), [&](const DriftEntry& other) {
    return other.time_s == written_s && other.scan == flat(entry.scan);
  });
  if (known) return;
  for (const RigCheckItem& item : entry.items) {
    file.append(fmt::format("{}\t{}\t{}\t{}\t{}\t{:.6f}\t{:.6f}\t{:.6f}",
                            kMark,
                            time,
                            flat(entry.scan),
                            flat(entry.kind),
                            flat(item.name),
                            item.deviation_mm,
                            item.sigma_mm,
                            item.limit_mm));
  }
}

std::string utc_text(double seconds_since_1970) {
  const auto whole = static_cast<std::time_t>(std::floor(seconds_since_1970));
  std::tm parts{};
  gmtime_r(&whole, &parts);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z",
                     parts.tm_year + 1900,
                     parts.tm_mon + 1,
                     parts.tm_mday,
                     parts.tm_hour,
                     parts.tm_min,
                     parts.tm_sec);
}

}  // namespace frangia

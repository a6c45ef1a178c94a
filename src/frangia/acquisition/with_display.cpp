#include "frangia/acquisition/with_display.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/rig/write_rig.h"

namespace frangia {
namespace {

constexpr const char* kBlank = " \t\r";

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

/// Lines of a TOML file by table; the values that are set have no quotes and no lists.
class TomlLines {
 public:
  explicit TomlLines(const std::string& text) : lines_(lines_of(text)) {}

  [[nodiscard]] bool has(const std::string& table, const std::string& key) const {
    return line_of(begin_of(table), key) < lines_.size();
  }
  /// A comment behind the value stays.
  void set(const std::string& table, const std::string& key, const std::string& value) {
    const std::size_t begin = begin_of(table);
    const std::size_t line = line_of(begin, key);
    const std::string text = fmt::format("{} = {}", key, value);
    if (line == lines_.size()) {
      lines_.insert(lines_.begin() + static_cast<std::ptrdiff_t>(begin), text);
      return;
    }
    const std::size_t comment = lines_[line].find('#');
    lines_[line] = comment == std::string::npos ? text : text + "  " + lines_[line].substr(comment);
  }
  [[nodiscard]] std::string text() const {
    std::string text;
    for (const std::string& line : lines_)
      text += line + '\n';
    return text;
  }

 private:
  /// The line after the head of a table.
  [[nodiscard]] std::size_t begin_of(const std::string& table) const {
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (trimmed(lines_[i]).starts_with("[" + table + "]")) return i + 1;
    throw Error(
        ErrorKind::Input,
        fmt::format("the rig has no line [{}]; write this table on lines of its own", table));
  }
  [[nodiscard]] std::size_t line_of(std::size_t begin, const std::string& key) const {
    for (std::size_t i = begin; i < lines_.size() && !trimmed(lines_[i]).starts_with('['); ++i) {
      const std::size_t equals = lines_[i].find('=');
      if (equals != std::string::npos && trimmed(lines_[i].substr(0, equals)) == key) return i;
    }
    return lines_.size();
  }

  std::vector<std::string> lines_;
};

}  // namespace

std::string with_display(const std::string& rig_toml,
                         const Rig& rig,
                         const DisplayMeasurement& measured) {
  TomlLines lines(rig_toml);
  lines.set("camera", "white_level", fmt::format("{}", measured.white_level));
  lines.set("devices.fringes", "delay_s", fmt::format("{}", measured.delay_s));
  const std::string camera = "devices.camera";
  if (measured.exposure_step_ms > 0.0 || lines.has(camera, "exposure_step_ms"))
    lines.set(camera, "exposure_step_ms", fmt::format("{:.6g}", measured.exposure_step_ms));
  if (measured.skip_frames)
    lines.set(camera, "skip_frames", fmt::format("{}", *measured.skip_frames));
  if (!measured.response) return lines.text();
  Projector projector = rig.projector;
  projector.response = measured.response;
  return with_response(lines.text(), projector);
}

}  // namespace frangia

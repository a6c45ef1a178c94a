#include "frangia/dataset/internal/import_patterns.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <variant>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/check_nesting.h"
#include "frangia/core/read_file.h"
#include "frangia/dataset/internal/read_pattern.h"
#include "frangia/rig/toml_reader.h"

namespace frangia {
namespace {

[[noreturn]] void refuse_option(const std::string& sentence) {
  throw Error(ErrorKind::Input, sentence);
}

/// The shifts of a pattern of `count` frames.
std::vector<double> shifts_of(const ImportOptions& options,
                              const std::string& name,
                              std::size_t count) {
  constexpr std::size_t kMinShifts = 3;
  if (count < kMinShifts) {
    refuse_option(fmt::format("pattern \"{}\" has {} frame{}; a phase needs at least {}",
                              name,
                              count,
                              count == 1 ? "" : "s",
                              kMinShifts));
  }
  std::vector<double> shifts = options.shifts_rad;
  if (shifts.empty()) {
    for (std::size_t k = 0; k < count; ++k)
      shifts.push_back(kTwoPi * static_cast<double>(k) / static_cast<double>(count));
  }
  if (shifts.size() != count) {
    refuse_option(fmt::format("pattern \"{}\" has {} frames, but `shifts` lists {}; correct it",
                              name,
                              count,
                              shifts.size()));
  }
  for (double& shift : shifts)
    shift = (options.reverse_shifts ? -shift : shift) + options.origin_rad;
  return shifts;
}

/// The side of the projector over which the phase varies.
int field_px(const ImportOptions& options, const Rig& rig, bool rig_has_projector) {
  const auto* const model = std::get_if<PinholeModel>(&rig.projector.model);
  if (!rig_has_projector || model == nullptr) {
    refuse_option(
        "the period of `fringes` follows from the size of the projector; set `projector`, such as "
        "1280x800");
  }
  return options.horizontal ? model->height_px : model->width_px;
}

/// The period of the pattern `name`, the `at`-th without a value of its own.
double period_of(const std::vector<PatternValue>& values,
                 const std::string& name,
                 std::size_t& at,
                 const char* option) {
  for (const PatternValue& value : values) {
    if (!value.pattern.empty() && value.pattern == name) return value.value;
  }
  while (at < values.size() && !values[at].pattern.empty())
    ++at;
  if (at == values.size()) {
    refuse_option(
        fmt::format("`{}` has no value for the pattern \"{}\"; list one for each", option, name));
  }
  return values[at++].value;
}

/// Whether a pattern of one frame is white or ambient by its name; sets the kind.
bool has_name_of_kind(std::string name, PatternKind& kind) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  if (name == "white" || name == "texture" || name == "color" || name == "colour") {
    kind = PatternKind::White;
    return true;
  }
  if (name == "ambient" || name == "black" || name == "dark") {
    kind = PatternKind::Ambient;
    return true;
  }
  return false;
}

}  // namespace

bool is_light_alone(const std::string& pattern, const std::vector<Pattern>& described) {
  PatternKind kind = PatternKind::Fringe;
  const auto found = std::find_if(described.begin(), described.end(), [&](const Pattern& known) {
    return known.name == pattern;
  });
  if (found == described.end()) return described.empty() && has_name_of_kind(pattern, kind);
  return found->kind == PatternKind::White || found->kind == PatternKind::Ambient;
}

DescribedFrames read_patterns_file(const std::filesystem::path& path,
                                   const Rig& rig,
                                   const Run& run) {
  const std::string text = read_text_file(path);
  check_toml_nesting(text, path);
  toml::table table;
  try {
    table = toml::parse(text, path.string());
  } catch (const toml::parse_error& error) {
    refuse_option(fmt::format("{}: line {}: {}",
                              path.string(),
                              error.source().begin.line,
                              std::string(error.description())));
  }
  TomlReader reader(path, "", table);
  for (const auto* known : {"format", "version", "name", "view", "setup", "frames"})
    reader.ignore(known);  // a whole scan.toml serves, too
  DescribedFrames out;
  if (reader.has("board")) out.board = read_board(reader.table("board"), run);
  std::vector<Pattern>& patterns = out.patterns;
  for (const TomlReader& pattern : reader.tables("pattern"))
    patterns.push_back(read_pattern(pattern, rig, run));
  if (patterns.empty()) reader.fail("[[pattern]]", "is missing; list the patterns of the frames");
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    if (patterns[i].exposure_count() > 1)
      reader.fail("exposures_ms", "is not supported by an import; import each exposure as a scan");
    for (std::size_t j = 0; j < i; ++j) {
      if (patterns[i].name == patterns[j].name)
        reader.fail("[[pattern]]",
                    fmt::format("has the name \"{}\" twice; rename one", patterns[i].name));
    }
  }
  reader.warn_of_unused_keys(run);
  return out;
}

std::vector<Pattern> patterns_from_options(const ImportOptions& options,
                                           const std::vector<std::string>& names,
                                           const std::vector<std::size_t>& frames,
                                           const Rig& rig,
                                           bool rig_has_projector) {
  const bool by_count = !options.fringes.empty();
  const auto& values = by_count ? options.fringes : options.period_px;
  if (values.empty()) {
    refuse_option(
        "the patterns are not described; set `fringes` to the number of fringes over the "
        "projector's width (or `period` to their period in projector pixels) of each pattern, "
        "`patterns` to a file of [[pattern]] tables, or `layout`");
  }
  if (by_count && !options.period_px.empty())
    refuse_option("`fringes` and `period` describe the same; set one of them");
  for (const PatternValue& value : values) {
    const bool known = value.pattern.empty() || names.empty() ||
                       std::find(names.begin(), names.end(), value.pattern) != names.end();
    if (!(value.value > 0.0) || !std::isfinite(value.value))
      refuse_option(fmt::format("the periods of fringes must be above 0, not {}", value.value));
    if (!known)
      refuse_option(
          fmt::format("no file shows the pattern \"{}\"; correct its name", value.pattern));
  }
  std::vector<Pattern> patterns;
  std::size_t at = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    Pattern pattern;
    if (!names.empty() && frames[i] == 1 && has_name_of_kind(names[i], pattern.kind)) {
      pattern.name = names[i];
      patterns.push_back(std::move(pattern));
      continue;
    }
    const PatternValue* const own = names.empty() ? &values[i] : nullptr;
    pattern.name = own == nullptr         ? names[i]
                   : own->pattern.empty() ? fmt::format("fringes-{}", i + 1)
                                          : own->pattern;
    const double value = own != nullptr
                             ? own->value
                             : period_of(values, pattern.name, at, by_count ? "fringes" : "period");
    pattern.period_px = by_count ? field_px(options, rig, rig_has_projector) / value : value;
    if (options.horizontal) pattern.direction = FringeDirection::Horizontal;
    pattern.shifts_rad = shifts_of(options, pattern.name, frames[i]);
    patterns.push_back(std::move(pattern));
  }
  return patterns;
}

}  // namespace frangia

#include "frangia/exchange/read_calibration_file.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/error.h"
#include "frangia/core/text.h"
#include "frangia/exchange/internal/interpret_values.h"
#include "frangia/exchange/internal/named_values.h"
#include "frangia/exchange/internal/read_colmap_cameras.h"

namespace frangia {
namespace {

NamedValues values_of(const std::filesystem::path& file, const Run& run) {
  const std::string ending = lowercase_extension(file);
  if (ending == ".yml" || ending == ".yaml" || ending == ".xml") return read_opencv_values(file);
  if (ending == ".mat") return read_mat_values(file, run);
  if (ending == ".json") return read_json_values(file);
  throw Error(ErrorKind::Input,
              fmt::format("{}: a calibration ends in .yml, .yaml, .xml, .mat, .json or .txt; save "
                          "the arrays of a .npz as lists in a .json",
                          file.string()));
}

/// The names in front of which `interpret_opencv_values` looks.
std::string name_of_map(const std::string& name) {
  return "=" + name;
}

ForeignCalibration interpret(const std::filesystem::path& file,
                             NamedValues values,
                             const CalibrationNames& names) {
  bool named = false;
  for (const auto& [name, in_file] : names) {
    const auto found = values.matrices.find(in_file);
    if (found == values.matrices.end()) continue;
    values.matrices[name_of_map(name)] = found->second;
    named = true;
  }
  try {
    const std::string ending = lowercase_extension(file);
    if (!named && (ending == ".mat" || ending == ".json")) {
      ForeignCalibration found = interpret_matlab_values(values);
      if (!found.camera.empty() || found.rotation || found.translation) return found;
    }
    return interpret_opencv_values(values);
  } catch (const Error& fault) {
    throw Error(fault.kind(), fmt::format("{}: {}", file.string(), fault.what()));
  }
}

ForeignCalibration read_one(const std::filesystem::path& file,
                            const Run& run,
                            CalibrationNames& missing,
                            const CalibrationNames& names) {
  if (lowercase_extension(file) == ".txt") return read_colmap_cameras(file);
  const NamedValues values = values_of(file, run);
  std::erase_if(missing, [&](const auto& name) { return values.matrices.contains(name.second); });
  return interpret(file, values, names);
}

bool states_nothing(const ForeignCalibration& one) {
  return one.camera.empty() && one.projector.empty() && !one.rotation && !one.translation;
}

void check_names(const CalibrationNames& names) {
  for (const auto& [name, in_file] : names) {
    constexpr std::array kNames{"K1", "D1", "K2", "D2", "R", "T"};
    if (std::find(kNames.begin(), kNames.end(), name) != kNames.end() && !in_file.empty()) continue;
    throw Error(ErrorKind::Input,
                fmt::format("`map` has {}={}; write K1, D1, K2, D2, R or T, an equals sign and the "
                            "name in the file, such as K1=mtx",
                            name,
                            in_file));
  }
}

/// What the earlier files state, completed by what a further one states and they do not.
struct Completed {
  ForeignCalibration all;
  bool adds = false;  ///< whether the further file adds anything
};

Completed complete(ForeignCalibration all, const ForeignCalibration& more) {
  bool adds = false;
  const auto complete_lens = [&](ForeignLens& lens, const ForeignLens& from) {
    adds = adds || (!lens.matrix && from.matrix) ||
           (lens.distortion.empty() && !from.distortion.empty());
    if (!lens.matrix) lens.matrix = from.matrix;
    if (lens.distortion.empty()) lens.distortion = from.distortion;
    if (!lens.size_px) lens.size_px = from.size_px;
  };
  complete_lens(all.camera, more.camera);
  complete_lens(all.projector, more.projector);
  adds = adds || (!all.rotation && more.rotation) || (!all.translation && more.translation);
  if (!all.rotation) all.rotation = more.rotation;
  if (!all.translation) {
    all.translation = more.translation;
    all.mm_per_unit = more.mm_per_unit;
  }
  all.unknown.insert(all.unknown.end(), more.unknown.begin(), more.unknown.end());
  return {std::move(all), adds};
}

}  // namespace

ForeignCalibration read_calibration_files(std::span<const std::filesystem::path> files,
                                          const Run& run,
                                          const CalibrationNames& names) {
  require(!files.empty(), "there is no calibration file to read; name at least one");
  check_names(names);
  ForeignCalibration all;
  CalibrationNames missing = names;
  for (const std::filesystem::path& file : files) {
    run.check();
    const ForeignCalibration one = read_one(file, run, missing, names);
    if (states_nothing(one) && missing.empty()) {
      throw Error(ErrorKind::Input,
                  fmt::format("{}: it states no calibration under a name that is known here{}; "
                              "docs/calibration.md lists the names of each program",
                              file.string(),
                              one.unknown.empty()
                                  ? std::string()
                                  : fmt::format(". It holds {}: say which one is what by `map`, "
                                                "such as K1=NAME",
                                                fmt::join(one.unknown, ", "))));
    }
    if (all.program.empty()) all.program = one.program;
    Completed completed = complete(std::move(all), one);
    all = std::move(completed.all);
    if (!completed.adds) {
      run.warn(fmt::format("{} is ignored: the files before it state all that it states",
                           file.string()));
    }
  }
  if (!missing.empty()) {
    const std::string holds =
        all.unknown.empty() ? "" : fmt::format("; they hold {}", fmt::join(all.unknown, ", "));
    throw Error(ErrorKind::Input,
                fmt::format("no file has the name {} of `map`{}", missing.begin()->second, holds));
  }
  return all;
}

}  // namespace frangia

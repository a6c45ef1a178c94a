#include "frangia/exchange/read_calibration_file.h"

#include <string>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/lowercase_extension.h"
#include "frangia/exchange/internal/interpret_values.h"
#include "frangia/exchange/internal/named_values.h"
#include "frangia/exchange/internal/read_colmap_cameras.h"

namespace frangia {
namespace {

ForeignCalibration read_one(const std::filesystem::path& file, const Run& run) {
  const std::string ending = lowercase_extension(file);
  if (ending == ".yml" || ending == ".yaml" || ending == ".xml")
    return interpret_opencv_values(read_opencv_values(file));
  if (ending == ".mat") return interpret_matlab_values(read_mat_values(file, run));
  if (ending == ".txt") return read_colmap_cameras(file);
  if (ending == ".json") {
    const NamedValues values = read_json_values(file);
    ForeignCalibration found = interpret_matlab_values(values);
    const bool matlab = !found.camera.empty() || found.rotation || found.translation;
    return matlab ? found : interpret_opencv_values(values);
  }
  throw Error(ErrorKind::Input,
              fmt::format("{}: a calibration ends in .yml, .yaml, .xml, .mat, .json or .txt",
                          file.string()));
}

/// Adds what a further file states and the earlier ones do not.
void complete(ForeignCalibration& all, const ForeignCalibration& more) {
  const auto complete_lens = [](ForeignLens& lens, const ForeignLens& from) {
    if (!lens.matrix) lens.matrix = from.matrix;
    if (lens.distortion.empty()) lens.distortion = from.distortion;
    if (!lens.size_px) lens.size_px = from.size_px;
  };
  complete_lens(all.camera, more.camera);
  complete_lens(all.projector, more.projector);
  if (!all.rotation) all.rotation = more.rotation;
  if (!all.translation) {
    all.translation = more.translation;
    all.mm_per_unit = more.mm_per_unit;
  }
}

}  // namespace

ForeignCalibration read_calibration_files(std::span<const std::filesystem::path> files,
                                          const Run& run) {
  require(!files.empty(), "there is no calibration file to read; name at least one");
  ForeignCalibration all;
  for (const std::filesystem::path& file : files) {
    run.check();
    const ForeignCalibration one = read_one(file, run);
    if (one.camera.empty() && one.projector.empty() && !one.rotation && !one.translation) {
      throw Error(
          ErrorKind::Input,
          fmt::format("{}: it states no calibration that is known here; docs/calibration.md "
                      "lists the names of each program",
                      file.string()));
    }
    if (all.program.empty()) all.program = one.program;
    complete(all, one);
  }
  return all;
}

}  // namespace frangia

#include "frangia/decode/phase_files.h"

#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/frames/image_file.h"
#include "frangia/phase/wrap/wrap_phase.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;

/// The path of a map with the extension that is there; that of a TIFF when none is.
fs::path map_path(const PhaseFiles& files,
                  std::size_t view,
                  const std::string& pattern,
                  const char* what) {
  const fs::path stem = files.folder / fmt::format("{:03}", view) / (pattern + "-" + what);
  for (const char* extension : {".tiff", ".tif", ".npy"}) {
    const fs::path path = stem.string() + extension;
    if (fs::exists(path)) return path;
  }
  return stem.string() + ".tiff";
}

/// Reads a map of the size of `like`.
Image<float> read_map(const fs::path& path, const Image<float>& like) {
  const ImageFile file(path);
  const ImageInfo& info = file.info();
  RasterImage raster = file.read();
  auto* values = std::get_if<Image<float>>(&raster.samples);
  if (values == nullptr || info.channels != 1) {
    throw Error(ErrorKind::Input,
                fmt::format("{} holds {} channels of {} bits; write one of 32-bit floating point",
                            path.string(),
                            info.channels,
                            info.bits));
  }
  if (!same_size(*values, like)) {
    throw Error(ErrorKind::Input,
                fmt::format("{} has {} x {} pixels and the frames have {} x {}",
                            path.string(),
                            values->width(),
                            values->height(),
                            like.width(),
                            like.height()));
  }
  return std::move(*values);
}

/// Takes phase and sigma of a map from its files.
template <typename Map>
void replace_phase(const PhaseFiles& files, std::size_t view, Map& map) {
  Image<float> phase = read_map(map_path(files, view, map.pattern.name, "phase"), map.phase_rad);
  const fs::path sigma_path = map_path(files, view, map.pattern.name, "sigma");
  Image<float> sigma = read_map(sigma_path, map.phase_rad);
  for (std::size_t i = 0; i < phase.pixels().size(); ++i) {
    float& value = phase.pixels()[i];
    float& noise = sigma.pixels()[i];
    const bool measured = std::isfinite(value) && std::isfinite(noise);
    if (measured && !(noise > 0.0F)) {
      throw Error(
          ErrorKind::Input,
          fmt::format("{} holds a standard deviation of {}; it must be above 0, or NaN where "
                      "nothing was measured",
                      sigma_path.string(),
                      noise));
    }
    if (!measured) value = noise = kMissing;
    map.status.pixels()[i] = measured ? PixelStatus::Measured : PixelStatus::Unmodulated;
  }
  map.phase_rad = std::move(phase);
  map.sigma_rad = std::move(sigma);
}

}  // namespace

OwnStages stages_from_files(const PhaseFiles& files, std::size_t view) {
  OwnStages own;
  if (files.kind == PhaseKind::Wrapped) {
    own.wrap = [files, view](const FrameStack& stack,
                             const FittedAlgorithm& fitted,
                             const NoiseModel& noise) {
      WrappedPhase map = wrap_phase(stack, fitted.algorithm, noise);  // modulation and mean
      replace_phase(files, view, map);
      return map;
    };
  } else {
    own.unwrap = [files, view](std::span<const WrappedPhase> maps) {
      const WrappedPhase& finest = maps.back();
      AbsolutePhase phase{
          finest.pattern, finest.phase_rad, finest.sigma_rad, finest.status, finest.systematic_rad};
      replace_phase(files, view, phase);
      return phase;
    };
  }
  return own;
}

void check_phase_files(const PhaseFiles& files, const Scan& scan) {
  std::string wanted;
  for (const Pattern& pattern : scan.patterns) {
    if (pattern.kind != PatternKind::Fringe) continue;
    const fs::path path = map_path(files, 0, pattern.name, "phase");
    if (fs::exists(path)) return;
    wanted = path.string();
  }
  throw Error(ErrorKind::Input,
              wanted.empty()
                  ? "the scan has no fringe patterns, so phase maps cannot replace them"
                  : fmt::format("{} is missing; the maps of a view are in a folder of its "
                                "number, 000 for the first",
                                wanted));
}

}  // namespace frangia

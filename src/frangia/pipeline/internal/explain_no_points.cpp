#include "frangia/pipeline/internal/explain_no_points.h"

#include <algorithm>

#include <fmt/format.h>

#include "frangia/dataset/read_frames.h"

namespace frangia {

std::string explain_no_points(const Scan& scan,
                              const Image<Eigen::Vector2f>& rays,
                              const DecodeOptions& options,
                              const Run& run) {
  DecodeOptions default_limit = options;
  default_limit.wrap = {};
  if (options.wrap.max_sigma_rad < default_limit.wrap.max_sigma_rad) {
    Run silent;
    silent.stop = run.stop;
    const auto decoded =
        decode_view(read_frames(scan, 0, silent), scan.rig, rays, default_limit, silent);
    const auto status = decoded.phase.status.pixels();
    if (std::find(status.begin(), status.end(), PixelStatus::Measured) != status.end()) {
      return fmt::format(
          "{}: the phase of every pixel is less certain than `max_sigma`, {:g} rad; "
          "set a larger one, such as the default of {:g} rad",
          scan.folder.string(),
          options.wrap.max_sigma_rad,
          default_limit.wrap.max_sigma_rad);
    }
  }
  return fmt::format("{}: no view has a measured pixel; check light, exposure and white_level",
                     scan.folder.string());
}

}  // namespace frangia

#include "frangia/reconstruct/internal/explain_no_surface.h"

#include <algorithm>

#include <fmt/format.h>

#include "frangia/dataset/read_frames.h"
#include "frangia/decode/explain_no_phase.h"

namespace frangia {
namespace {

/// Statuses of the pixels of the first view, decoded with the default limit of sigma.
class FirstView {
 public:
  FirstView(const Scan& scan,
            const Image<Eigen::Vector2f>& rays,
            const DecodeOptions& options,
            const Run& run)
      : status_(decoded(scan, rays, options, run)) {}
  /// Why no pixel has a phase, if none has one.
  [[nodiscard]] const std::string& reason() const { return reason_; }
  [[nodiscard]] std::ptrdiff_t count(PixelStatus status) const {
    const auto pixels = status_.pixels();
    return std::count(pixels.begin(), pixels.end(), status);
  }
  /// Number of pixels with a phase, whether or not their fringe order is certain.
  [[nodiscard]] std::ptrdiff_t lit() const {
    return count(PixelStatus::UncertainOrder) + count(PixelStatus::Measured);
  }

 private:
  [[nodiscard]] Image<PixelStatus> decoded(const Scan& scan,
                                           const Image<Eigen::Vector2f>& rays,
                                           DecodeOptions options,
                                           const Run& run) {
    options.wrap = {};
    Run silent;
    silent.stop = run.stop;
    const auto stacks = read_frames(scan, 0, silent);
    auto status =
        decode_view(stacks, scan.rig, rays, options, silent).directions.front().phase.status;
    reason_ = explain_no_phase(stacks, status);
    return status;
  }

  std::string reason_;  // set by `decoded`
  Image<PixelStatus> status_;
};

}  // namespace

std::string explain_no_surface(const Scan& scan,
                               const Image<Eigen::Vector2f>& rays,
                               const DecodeOptions& options,
                               PointCounts counts,
                               const Run& run) {
  constexpr double kMostly = 0.5;
  const std::size_t points = counts.measured;
  if (counts.unresolved > points) {
    return fmt::format(
        "{}: the fringe order of {} of {} points is unknown; capture a laser sheet, a coarse or "
        "Gray-code pattern, or more views that see the same surface",
        scan.folder.string(),
        counts.unresolved,
        points + counts.unresolved);
  }
  const FirstView view(scan, rays, options, run);
  const WrapOptions usual;
  if (options.wrap.max_sigma_rad < usual.max_sigma_rad && view.count(PixelStatus::Measured) > 0) {
    return fmt::format(
        "{}: the phase of {} pixel is less certain than `max_sigma`, {:g} rad; "
        "set a larger one, such as the default of {:g} rad",
        scan.folder.string(),
        points == 0 ? "every" : "nearly every",
        options.wrap.max_sigma_rad,
        usual.max_sigma_rad);
  }
  const std::string what = points == 0 ? std::string("no view has a measured pixel")
                                       : fmt::format("its {} points do not form a surface", points);
  // Points are discarded where neighbouring pixels contradict each other.
  const double lit = static_cast<double>(view.lit()) * static_cast<double>(scan.views.size());
  if (lit > 0.0 && static_cast<double>(points) < kMostly * lit) {
    return fmt::format(
        "{}: {}: the fringe orders of most lit pixels are uncertain or jump from pixel to pixel; "
        "see the warnings about the patterns, or capture more frames or coarser fringes",
        scan.folder.string(),
        what);
  }
  if (points == 0 && !view.reason().empty())
    return fmt::format("{}: {}; in the first view {}", scan.folder.string(), what, view.reason());
  return fmt::format("{}: {}; check light, exposure and white_level", scan.folder.string(), what);
}

}  // namespace frangia

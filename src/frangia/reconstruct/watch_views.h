#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "frangia/core/missing.h"
#include "frangia/core/run.h"
#include "frangia/decode/decode_view.h"
#include "frangia/pattern/pattern.h"
#include "frangia/range/range_grid.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// A view of a scan that is being captured, compared with those before it.
struct WatchedView {
  /// Why it contradicts those before it, as one clause with what to do; empty where it does not.
  std::string finding;
  double moved_mm = kMissing;        ///< way of the part before the view; NaN: it did not move
  double moved_sigma_mm = kMissing;  ///< its standard deviation
};

/// Compares each view of a scan with those before it while the part still stands there: whether the
/// part moved, or the table turned by another angle. Every k-th pixel of the last eight views is
/// compared, so that the time of a view does not depend on the camera or on the number of views. A
/// motion is named only where nothing else explains it, as in `register_views`; the reconstruction
/// of the scan, which has all views and pixels, decides.
class ViewWatch {
 public:
  /// A rig without turntable, or whose projector is a label, has nothing to compare.
  explicit ViewWatch(const Rig& rig);

  /// Compares a view that was decoded, with the next `setup` from the first view on.
  ///
  /// @missing  no finding for the first view of a setup, a view without points, and one whose
  ///           frames do not fit the rig
  /// @errors   Error(Cancelled)
  [[nodiscard]] WatchedView compare(std::size_t view,
                                    double angle_rad,
                                    int setup,
                                    const DecodedView& decoded,
                                    const Run& run = {});
  /// The same of points that were measured.
  ///
  /// @shape    `range` of the size of the reference camera; `pattern`: any of the fringes
  [[nodiscard]] WatchedView compare(std::size_t view,
                                    double angle_rad,
                                    int setup,
                                    const RangeGrid& range,
                                    const Pattern& pattern,
                                    const Run& run = {});

 private:
  struct Seen {
    std::size_t view = 0;
    double angle_rad = 0.0;
    RangeGrid range;  ///< thinned
  };

  Rig rig_;
  Rig thinned_;  ///< its reference camera has the pixels that are kept
  Image<Eigen::Vector2f> rays_;
  int step_ = 1;
  int setup_ = 0;
  std::vector<Seen> seen_;  ///< the last views, since the part moved
};

}  // namespace frangia

#pragma once

#include <functional>
#include <map>
#include <vector>

#include "frangia/phase/phase_map.h"

namespace frangia {

/// What becomes of each pixel of the view at hand when its fringes are taken at an exposure in ms.
using ExposureProbe = std::function<Image<PixelStatus>(double exposure_ms)>;

struct ExposureRange {
  double initial_ms = 10.0;
  double min_ms = 0.01;
  double max_ms = 10'000.0;
};

/// The longest exposure, to a few percent, that saturates at most 0.5 % of what is lit.
///
/// errors   what the probe throws
[[nodiscard]] double longest_exposure(const ExposureProbe& probe, const ExposureRange& range);

/// Finds the exposures that a part needs, by what each one measures in a few of its views.
class ExposureBracket {
 public:
  explicit ExposureBracket(const ExposureRange& range) : range_(range) {}

  /// Looks at a view: at exposures a factor of two apart, up and down from the guess, until neither
  /// more light nor less measures anything new.
  void add_view(const ExposureProbe& probe);

  /// The exposure that measures most, then that which adds most, and so on while one adds half a
  /// percent.
  /// missing  the guess alone when nothing was measured at all
  [[nodiscard]] std::vector<double> selected() const;

 private:
  using Mask = std::vector<bool>;  ///< of the pixels measured, one view's after the other's

  [[nodiscard]] bool adds(int step, const Image<PixelStatus>& status, Mask& all);

  ExposureRange range_;
  std::map<int, Mask> measured_;    ///< by the power of two of the guess
  std::size_t earlier_pixels_ = 0;  ///< pixels of the views before
};

}  // namespace frangia

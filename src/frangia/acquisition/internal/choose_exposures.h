#pragma once

#include <functional>
#include <map>
#include <span>
#include <vector>

#include "frangia/acquisition/capture_options.h"
#include "frangia/acquisition/internal/capture_devices.h"
#include "frangia/acquisition/internal/capture_manifest.h"
#include "frangia/acquisition/internal/table_mover.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/devices/rig_devices.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/pattern/pattern.h"
#include "frangia/phase/wrap/phase_map.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Returns the pixel states of the current view when its fringes are captured at an exposure.
using ExposureProbe = std::function<Image<PixelStatus>(double exposure_ms)>;

struct ExposureRange {
  double initial_ms = 10.0;
  double min_ms = 0.01;
  double max_ms = 10'000.0;
  double step_ms = 0.0;  ///< exposures are whole multiples of it; 0: any
};

/// What the reference camera can expose, on the raster of the devices, from the exposure of
/// `options` on.
[[nodiscard]] ExposureRange exposure_range(const RigDevices& devices,
                                           const CaptureOptions& options);

/// The longest whole multiple of `step_ms` that is not above an exposure; the exposure itself where
/// it is shorter than one step, and for no step.
[[nodiscard]] double on_raster(double exposure_ms, double step_ms);

/// Finds the longest exposure of the range, within 5 % or a step, that saturates at most 0.5 % of
/// the lit pixels.
///
/// @units    ms
///
/// @errors   those of the probe
[[nodiscard]] double longest_exposure(const ExposureProbe& probe, const ExposureRange& range);

/// Chooses a set of exposures by the pixels that each one measures in a few views.
class ExposureBracket {
 public:
  explicit ExposureBracket(const ExposureRange& range) : range_(range) {}

  /// Probes the current view at exposures a factor of two apart, up and down from the initial one,
  /// until two successive exposures in each direction measure no new pixels.
  void add_view(const ExposureProbe& probe);

  /// Selects greedily the exposure that adds most pixels, while it adds at least 0.5 %.
  ///
  /// @units    ms
  /// @missing  the initial exposure alone when no pixel was measured
  [[nodiscard]] std::vector<double> selected() const;

 private:
  using Mask = std::vector<bool>;  ///< measured pixels of all views, concatenated

  [[nodiscard]] double exposure_of(int step) const;
  [[nodiscard]] bool adds(int step, const Image<PixelStatus>& status, Mask& all);

  ExposureRange range_;
  std::map<int, Mask> measured_;    ///< by the power of two relative to the initial exposure
  std::size_t earlier_pixels_ = 0;  ///< pixels of the earlier views
};

/// Exposures of a scan.
struct ChosenExposures {
  std::vector<double> fringes_ms;  ///< of the fringes, in the order of capture
  double single_ms = 0.0;          ///< of patterns without exposures of their own
};

/// Chooses the exposures for the whole scan, or takes those of an earlier session from the
/// manifest. Adds the exposures of a bracket to the patterns of `plan`.
///
/// @errors   Error(Input) when the manifest is damaged and lacks the exposures; those of the
/// devices
[[nodiscard]] ChosenExposures choose_exposures(Scan& plan,
                                               CaptureDevices& devices,
                                               const ExposureRange& range,
                                               TableMover& table,
                                               CaptureManifest& manifest,
                                               const CaptureOptions& options,
                                               const Run& run);

/// Captures the frames of the finest fringes of `patterns` at an exposure, where the turntable
/// stands.
///
/// @errors   Error(Input) without a pattern of fringes, and those of the devices
[[nodiscard]] FrameStack capture_finest(std::span<const Pattern> patterns,
                                        const Rig& rig,
                                        int view,
                                        CaptureDevices& devices,
                                        double exposure_ms);

/// Captures the finest fringes of `patterns` at an exposure, where the turntable stands, and
/// returns the state of each pixel.
///
/// @errors   Error(Input) without a pattern of fringes, and those of the devices
[[nodiscard]] Image<PixelStatus> probe_exposure(std::span<const Pattern> patterns,
                                                const Rig& rig,
                                                int view,
                                                CaptureDevices& devices,
                                                double exposure_ms);

}  // namespace frangia

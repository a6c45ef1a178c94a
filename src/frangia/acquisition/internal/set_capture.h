#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "frangia/acquisition/capture_options.h"
#include "frangia/acquisition/internal/capture_devices.h"
#include "frangia/acquisition/internal/capture_manifest.h"
#include "frangia/acquisition/internal/frame_store.h"
#include "frangia/acquisition/internal/set_files.h"
#include "frangia/acquisition/internal/table_mover.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/frames/frame_stack.h"

namespace frangia {

/// What a capture works with. All objects outlive it.
struct CaptureParts {
  const Scan& plan;
  const CaptureOptions& options;
  const Run& run;
  CaptureDevices& devices;
  TableMover& table;
  CaptureManifest& manifest;
  const SetFiles& files;
  FrameStore& store;
};

/// Captures sets: all frames of one pattern in one view. The order of the device calls and of the
/// manifest's entries makes an interrupted capture continue with the same bytes.
class SetCapture {
 public:
  using FramePtr = std::shared_ptr<const Frame>;

  /// `exposure_ms` is the exposure of patterns without exposures of their own. `on_frames` receives
  /// the number of frames that are done, negative when a set is captured again.
  SetCapture(const CaptureParts& parts,
             double exposure_ms,
             std::function<void(std::ptrdiff_t)> on_frames)
      : parts_(parts), exposure_ms_(exposure_ms), on_frames_(std::move(on_frames)) {}

  /// Captures the missing frames of a set and repeats the set while it shows motion. Turns the
  /// table before the first frame. Returns the frames of the reference camera in the order of
  /// `read_frames`: one exposure after the other.
  [[nodiscard]] std::vector<FramePtr> capture(std::size_t view, const Pattern& pattern);

  /// Number of frames captured so far.
  [[nodiscard]] std::size_t captured() const { return captured_; }

 private:
  void capture_trial_set(std::size_t view, const Pattern& pattern);
  bool shows_motion(std::size_t view,
                    const Pattern& pattern,
                    const std::vector<FramePtr>& frames,
                    int attempt);
  [[nodiscard]] std::vector<FrameStack> stacks_of(const Pattern& pattern,
                                                  const std::vector<FramePtr>& frames) const;
  void capture_further_cameras(std::size_t view,
                               const Pattern& pattern,
                               const FrameLabel& label,
                               double scale);
  [[nodiscard]] ManifestFrame about(int attempts, double scale) const;
  std::vector<FramePtr> acquire(std::size_t view, const Pattern& pattern, int attempt);
  [[nodiscard]] double exposure_of(const Pattern& pattern, int exposure) const;

  CaptureParts parts_;
  double exposure_ms_;
  std::function<void(std::ptrdiff_t)> on_frames_;
  std::size_t captured_ = 0;
};

}  // namespace frangia

#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "frangia/acquisition/capture_options.h"
#include "frangia/acquisition/internal/capture_devices.h"
#include "frangia/acquisition/internal/capture_manifest.h"
#include "frangia/acquisition/internal/frame_store.h"
#include "frangia/acquisition/internal/table_mover.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Names and states of the files of a plan. A set is all frames of one pattern in one view.
class SetFiles {
 public:
  /// The arguments must outlive this object.
  SetFiles(const Scan& plan, const CaptureManifest& manifest) : plan_(plan), manifest_(manifest) {}

  /// The set's name in the manifest.
  [[nodiscard]] std::string set_of(std::size_t view, const Pattern& pattern) const;
  /// Folder of a camera's frames, 0 for the reference camera, relative to the scan folder.
  [[nodiscard]] std::filesystem::path folder_of(std::size_t view, std::size_t camera) const;
  /// Number of cameras, with the reference camera.
  [[nodiscard]] std::size_t cameras() const;
  /// A frame's file, relative to the scan folder.
  [[nodiscard]] std::string file_of(std::size_t view,
                                    const Pattern& pattern,
                                    int frame,
                                    int exposure,
                                    std::size_t camera = 0) const;
  /// Of the reference camera.
  [[nodiscard]] std::size_t frames_per_view() const;
  /// Whether the frames of all cameras are stored.
  [[nodiscard]] bool has_all_frames(std::size_t view, const Pattern& pattern) const;
  /// Whether all sets of a view are stored and none is rejected.
  [[nodiscard]] bool is_complete(std::size_t view) const;
  /// Whether any frame of a view was ever stored.
  [[nodiscard]] bool is_begun(std::size_t view) const;
  /// Which frames of a set by the reference camera are stored, in the order of capture: all
  /// exposures of a frame, then the next frame.
  [[nodiscard]] std::vector<bool> stored_frames(std::size_t view, const Pattern& pattern) const;
  /// The scale of a set's shifts: that of its stored frames, else that of the next set.
  [[nodiscard]] double scale_of(std::size_t view, const Pattern& pattern) const;
  /// Moves the frames of a rejected set to the view's folder `rejected`. Raw frames are never
  /// changed or deleted.
  void move_to_rejected(std::size_t view, const Pattern& pattern, int attempt) const;

 private:
  const Scan& plan_;
  const CaptureManifest& manifest_;
};

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

/// Motion and step errors of a complete set of fringe frames.
struct SetAssessment {
  bool moved = false;       ///< motion, or flicker of the light, between the frames
  bool step_found = false;  ///< `gain_error` is valid
  double gain_error = 0.0;  ///< true shift = nominal shift * (1 + gain_error)
};

/// Assesses the frames of one pattern. Of several exposures, the one with most measured pixels
/// counts.
///
/// `camera` is the camera's noise model. Without it `moved` is false, because noise estimated from
/// the frames includes motion.
///
/// With n frames it takes at most n^2 operations for each sampled pixel, see `estimate_shifts`; all
/// other steps are linear in pixels and frames.
/// @errors   as fit_algorithm and wrap_phase
[[nodiscard]] SetAssessment assess_set(std::span<const FrameStack> exposures,
                                       const std::optional<NoiseModel>& camera,
                                       bool shifter);

/// Pixel states of the decoded set.
[[nodiscard]] Image<PixelStatus> pixel_status_of(const FrameStack& stack,
                                                 const std::optional<NoiseModel>& camera);

}  // namespace frangia

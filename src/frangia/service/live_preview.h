#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frangia/acquisition/preview.h"
#include "frangia/core/enum_names.h"
#include "frangia/core/image.h"
#include "frangia/decode/decode_view.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/range/range_grid.h"
#include "frangia/service/capture_settings.h"

namespace frangia {

/// What a client looks at. A picture layer has one byte for each pixel.
enum class LiveLayer {
  None,        ///< nothing: no messages
  Camera,      ///< the newest frame by the curve of sRGB; 255 is saturated
  Phase,       ///< modulo 2 pi of the finest fringes: 1 to 255; 0 is not measured
  Modulation,  ///< of the finest fringes, 255 is half of white
  Status,      ///< PixelStatus of the absolute phase
  Depth,       ///< 1 to 255 from `low` to `high`, mm; 0 is not measured
  Points       ///< points in the frame of the object
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(LiveLayer /*any*/) {
  return EnumNames<LiveLayer, 7>{{{LiveLayer::None, "none"},
                                  {LiveLayer::Camera, "camera"},
                                  {LiveLayer::Phase, "phase"},
                                  {LiveLayer::Modulation, "modulation"},
                                  {LiveLayer::Status, "status"},
                                  {LiveLayer::Depth, "depth"},
                                  {LiveLayer::Points, "points"}}};
}

/// What the light pattern is.
enum class LivePattern {
  Fringes,  ///< the patterns of a scan, which are decoded
  White,    ///< full light
  Dark      ///< no light
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(LivePattern /*any*/) {
  return EnumNames<LivePattern, 3>{{{LivePattern::Fringes, "fringes"},
                                    {LivePattern::White, "white"},
                                    {LivePattern::Dark, "dark"}}};
}

/// Settings of a live preview.
struct LiveSettings {
  CaptureSettings capture;                     ///< as the scan will use them
  LivePattern pattern = LivePattern::Fringes;  ///< what the projector shows
  double table_rad = 0.0;                      ///< turntable angle
};

/// A decoded view of a preview.
struct LiveDecode {
  DecodedView view;          ///< with the wrapped map of the finest fringes last
  RangeGrid range;           ///< empty for a phase that does not fit the rig
  double angle_rad = 0.0;    ///< of the turntable
  std::size_t points = 0;    ///< measured pixels
  double decode_ms = 0.0;    ///< from frames to points
  std::string finding = {};  ///< what the frames lack, one sentence; empty when they are good
};

/// The newest of a preview. Immutable, so that a client reads it while the preview goes on.
struct LiveSnapshot {
  std::uint64_t revision = 0;                ///< grows with each snapshot, from 1
  std::shared_ptr<const Frame> frame;        ///< newest one
  int white_level = 255;                     ///< of the camera
  std::vector<Eigen::Vector2d> corners_px;   ///< of a board, where one is looked for
  std::shared_ptr<const LiveDecode> decode;  ///< null before the first complete set
  double frames_per_s = 0.0;                 ///< over the last seconds
  double decodes_per_s = 0.0;                ///< over the last seconds
};

/// Decodes the frames of a preview as they come. One thread calls `run`; the other functions may be
/// called from any thread.
class LivePreview {
 public:
  /// `on_change` is called after each snapshot, on the thread of `run`. Of a rig with start values
  /// only, the frames are shown and not decoded.
  LivePreview(Rig rig, LiveSettings settings, std::function<void()> on_change);

  /// Changes the settings from the next frame on.
  void set(const LiveSettings& settings);
  [[nodiscard]] LiveSettings settings() const;           ///< as last set
  [[nodiscard]] const Rig& rig() const { return rig_; }  ///< whose frames are decoded
  /// The newest snapshot; null before the first frame. Asking keeps the preview alive.
  [[nodiscard]] std::shared_ptr<const LiveSnapshot> snapshot() const;
  /// Frames are captured and decoded until `run` is stopped, or until nobody has asked for a
  /// snapshot for `kPatience`, after which it returns.
  ///
  /// @errors   as preview
  void run(RigDevices& devices, const Run& run);

  static constexpr std::chrono::seconds kPatience{20};  ///< without anybody who watches

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] std::optional<PreviewSettings> next_settings();
  void take(PreviewFrame captured, int white_level);

  Rig rig_;
  bool calibrated_ = false;
  Image<Eigen::Vector2f> rays_;  ///< empty for a rig that is not calibrated
  std::function<void()> on_change_;
  mutable std::mutex mutex_;
  LiveSettings settings_;
  bool changed_ = true;
  std::shared_ptr<const LiveSnapshot> snapshot_;
  mutable Clock::time_point watched_ = Clock::now();
  // Of the thread of `run`:
  LiveSettings active_;
  std::vector<FrameStack> stacks_;
  std::size_t missing_ = 0;  ///< frames until all stacks are complete
  std::vector<Clock::time_point> frame_times_;
  std::vector<Clock::time_point> decode_times_;
};

/// Decodes the frames of all patterns of a view and triangulates it.
///
/// @shape    `stacks` as decode_view wants them; `rays` as rays_of(rig.reference().model)
/// @errors   as decode_view
[[nodiscard]] LiveDecode decode_live(std::span<const FrameStack> stacks,
                                     const Rig& rig,
                                     const Image<Eigen::Vector2f>& rays,
                                     const LiveSettings& settings);

/// Packs a layer of a snapshot in the form of encode_arrays.h. Pictures are reduced to at most 960
/// columns. "values" of the header are "revision", "layer", "width", "height", "low", "high",
/// "frames_per_s", "decodes_per_s", "decode_ms", "contrast", "saturated", "dark", "points" and
/// "finding"; "histogram" has 64 bins (uint32) of the newest frame; "corners" holds x and y of each
/// point of a board, in pixels of the picture.
[[nodiscard]] std::string encode_live(const LiveSnapshot& snapshot,
                                      LiveLayer layer,
                                      const Rig& rig);

}  // namespace frangia

#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/pattern/pattern.h"
#include "frangia/rig/artifact.h"
#include "frangia/rig/board.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/rig.h"
#include "frangia/rig/target_set.h"

namespace frangia {

/// The `version` that `write_scan` writes and the newest that `read_scan` accepts.
/// Version 2 calls a clamping of the part a setup: `setup` and `[[setup]]`.
inline constexpr int kScanVersion = 2;

/// One view of a scan: table angle, image folder and setup.
struct ScanView {
  double angle_rad = 0.0;        ///< commanded turntable angle
  std::filesystem::path folder;  ///< relative to the scan folder, inside it
  int setup = 0;                 ///< views of one setup share one pose of the part on the turntable
};

/// The white level of a scan with floating-point frames: full scale of the 16 bits to which they
/// are scaled.
inline constexpr int kFloatWhiteLevel = 65535;

/// How the frames of a scan are stored, where that differs from plain PNG: `[frames]`.
struct FrameStorage {
  /// Frames are 32-bit floating-point TIFFs, whose values are scaled to whole counts from 0 to the
  /// camera's white level when they are read.
  bool is_float = false;
  double zero = 0.0;        ///< value that becomes 0 counts
  double full_scale = 1.0;  ///< value that becomes the white level
  /// Variance that a lossy compression before the import added to each pixel, counts squared.
  double compression_counts2 = 0.0;

  /// Whether all members are equal.
  friend bool operator==(const FrameStorage&, const FrameStorage&) = default;
};

/// The content of scan.toml and rig.toml: everything but the images.
struct Scan {
  std::filesystem::path folder;   ///< folder that contains scan.toml
  std::string name;               ///< name of the scan, as in scan.toml
  Rig rig;                        ///< calibrated rig, from rig.toml
  std::vector<Pattern> patterns;  ///< in the order of capture
  std::vector<ScanView> views;    ///< in the order of capture
  /// Approximate part poses of setups, where known: part pose · (point of setup 0) = point of this
  /// setup, both in the object frame.
  std::map<int, Eigen::Isometry3d> part_poses{};
  std::optional<Board> board{};  ///< of a scan whose views are poses for calibration
  /// Instead of `board`: a screen, plate or balls; its views are at turntable angles or poses.
  std::optional<Artifact> artifact{};
  std::optional<TargetSet> targets{};  ///< round stickers on the part, where it has some
  FrameStorage frames{};               ///< how the frames are stored
};

/// Reads scan.toml and rig.toml of a scan folder, see docs/scan-format.md. Unknown keys are warned
/// of by name and ignored. `content` states how much rig.toml must hold; with
/// `RigContent::PhaseOnly` there may be none: the camera's size is then that of the frames, and the
/// projector's field the length after which all patterns repeat.
///
/// @errors   Error(Input) that names the file and the key: a missing or wrong value, a key of
///          version 1 that was renamed, a newer version, a view's folder outside of the scan;
///          or the folder, when its capture or simulation is not complete
[[nodiscard]] Scan read_scan(const std::filesystem::path& folder,
                             const Run& run = {},
                             RigContent content = RigContent::Complete);

/// PATTERN-FRAME.png, or PATTERN-FRAME@EXPOSURE.png for a pattern with several exposures.
[[nodiscard]] std::string frame_file_name(const Pattern& pattern, int frame, int exposure = 0);

/// Returns a scan as one camera captured it: its rig is `rig_of_camera(scan.rig, camera)`, and the
/// folder of each view is that of the camera's frames. Camera 0 is the reference camera.
[[nodiscard]] Scan scan_of_camera(const Scan& scan, std::size_t camera);

}  // namespace frangia

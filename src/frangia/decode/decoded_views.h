#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "frangia/dataset/scan_folder.h"
#include "frangia/decode/told_view.h"

namespace frangia {

/// Views of a scan that were decoded from the frames of the camera while it was captured, so that a
/// reconstruction need not read and decode them again. A view is given out only where the frames on
/// the disk are those that were decoded, and patterns, rig and options are the same: the result has
/// the same bytes as without. The turntable of the rig may differ, which no view is decoded with:
/// it may be found by the scan itself. All functions may be called from any thread.
class DecodedViews {
 public:
  /// Pixels of all views that are kept, of up to 30 bytes each; later views are decoded again.
  static constexpr std::size_t kMostPixels = 45'000'000;

  /// `options` are those of the reconstruction. Writes the files of `plan` into the folder
  /// `scratch` and removes it: numbers that are written and read back may differ in their last
  /// digits.
  ///
  /// @errors   as write_scan and read_scan
  DecodedViews(const Scan& plan, DecodeOptions options, const std::filesystem::path& scratch);

  /// The scan as read_scan will return it once the plan is captured.
  [[nodiscard]] const Scan& scan() const { return scan_; }
  /// What the views are decoded with.
  [[nodiscard]] const DecodeOptions& options() const { return options_; }
  /// Whether another plan is the same but for its turntable, and so is the algorithm.
  [[nodiscard]] bool fits(const Scan& plan, const DecodeOptions& options) const;

  /// The frames of a view are captured, for the first time or again.
  void forget(std::size_t view);
  /// Keeps a view that was decoded from its captured frames.
  void put(std::size_t view, ToldView decoded);
  /// The frames of all views that were put are on the disk, as they were decoded. Until then none
  /// of them is given out.
  void seal();
  /// Forgets the views of a capture that was interrupted: their frames may not be on the disk.
  void forget_unsealed();
  /// A view of a scan that is to be decoded with `options`; null where it was not decoded before,
  /// or differently.
  [[nodiscard]] std::shared_ptr<const ToldView> find(const Scan& scan,
                                                     const DecodeOptions& options,
                                                     std::size_t view) const;

 private:
  struct Kept {
    std::shared_ptr<const ToldView> view;
    std::string frames;  ///< their names, sizes and times; empty until they are on the disk
    std::size_t pixels = 0;
  };

  std::string plan_;  ///< its files, without turntable
  Scan scan_;
  DecodeOptions options_;
  std::string rig_;  ///< of the scan, without turntable; empty where views are not kept
  mutable std::mutex mutex_;
  std::map<std::string, Kept> kept_;  ///< by the folder of the view
};

}  // namespace frangia

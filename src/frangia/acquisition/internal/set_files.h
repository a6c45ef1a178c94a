#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "frangia/acquisition/internal/capture_manifest.h"
#include "frangia/dataset/scan_folder.h"

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
  /// Moves the frames of a rejected set to the folder `rejected` beside them. Raw frames are never
  /// changed or deleted.
  void move_to_rejected(std::size_t view, const Pattern& pattern, int attempt) const;

 private:
  const Scan& plan_;
  const CaptureManifest& manifest_;
};

}  // namespace frangia

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "frangia/views/view.h"

namespace frangia {

/// Stores views in an unnamed temporary file, so that memory holds one view at a time.
///
/// errors   Error(File) when the temporary folder cannot hold the views
class ViewStore {
 public:
  ViewStore();
  ViewStore(const ViewStore&) = delete;
  ViewStore& operator=(const ViewStore&) = delete;
  ViewStore(ViewStore&& other) noexcept;
  ViewStore& operator=(ViewStore&& other) noexcept;
  ~ViewStore();

  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  void add(const View& view);
  /// Replaces view `index`. The grid keeps its size, and the number of edge pixels must not grow.
  void replace(std::size_t index, const View& view);
  /// Removes all points of view `index`; the view itself remains.
  void clear(std::size_t index);
  [[nodiscard]] View load(std::size_t index) const;
  /// The pose of a view, without reading its grid.
  [[nodiscard]] const Eigen::Isometry3d& rig_from_object(std::size_t index) const {
    return entries_[index].rig_from_object;
  }
  void set_rig_from_object(std::size_t index, const Eigen::Isometry3d& pose) {
    entries_[index].rig_from_object = pose;
  }

 private:
  struct Entry {
    Eigen::Isometry3d rig_from_object;
    int width = 0;
    int height = 0;
    std::size_t edge_pixels = 0;  ///< pixels
    std::int64_t offset = 0;
  };
  /// Returns the end of the view in the file.
  std::int64_t write(const View& view, std::int64_t offset);

  std::vector<Entry> entries_;
  std::FILE* file_ = nullptr;
  std::int64_t end_ = 0;
};

}  // namespace frangia

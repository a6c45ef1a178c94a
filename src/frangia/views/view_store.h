#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/sigma_terms.h"
#include "frangia/views/view.h"

namespace frangia {

/// The parts of the uncertainty that are loaded with the points of a view.
enum class PointSigma {
  Noise,      ///< noise only
  BothParts,  ///< noise, and the systematic part where it is known
};

/// Stores views in an unnamed temporary file, so that memory holds one view at a time. Of each
/// grid, the file holds the smallest box with all pixels that have a depth.
///
/// @missing  a pixel without a depth is loaded as NaN in all images of the grid; images that a
///           grid does not have stay empty
/// @errors   Error(File) when the temporary folder cannot hold the views
class ViewStore {
 public:
  ViewStore();  ///< opens the temporary file
  ViewStore(const ViewStore&) = delete;
  ViewStore& operator=(const ViewStore&) = delete;
  /// Takes over the temporary file.
  ViewStore(ViewStore&& other) noexcept;
  /// Takes over the temporary file.
  ViewStore& operator=(ViewStore&& other) noexcept;
  ~ViewStore();

  [[nodiscard]] std::size_t size() const { return entries_.size(); }  ///< number of views
  void add(const View& view);                                         ///< appends a view
  /// Replaces view `index`.
  ///
  /// @errors   Error(Input) unless the grid keeps its size and has a phase image, a systematic part
  ///           and colors when it had them before, and the number of edge pixels does not grow
  void replace(std::size_t index, const View& view);
  /// Removes all points of view `index`; the view itself remains.
  void clear(std::size_t index);
  [[nodiscard]] View load(std::size_t index) const;  ///< reads a view from the file
  /// Loads a view without its phase image, for stages that use points only, and without the
  /// systematic part of their uncertainty unless that is asked for.
  [[nodiscard]] View load_points(std::size_t index, PointSigma sigma = PointSigma::Noise) const;
  /// Loads a view as `load_points` does, with the colors of its pixels.
  [[nodiscard]] View load_colored_points(std::size_t index) const;
  /// Whether the colors of any view are known.
  [[nodiscard]] bool has_color() const;
  /// Whether a systematic part of the uncertainty is known of the points of any view.
  [[nodiscard]] bool has_systematic() const;
  /// Loads the depth image alone.
  [[nodiscard]] Image<float> load_depth_mm(std::size_t index) const;
  /// Returns `rays_of(camera)`. The store keeps them, because several stages need them. Not to be
  /// called by several threads at once.
  [[nodiscard]] std::shared_ptr<const Image<Eigen::Vector2f>> rays(const CameraModel& camera) const;
  /// The pose of a view, without reading its grid.
  [[nodiscard]] const Eigen::Isometry3d& rig_from_object(std::size_t index) const {
    return entries_[index].rig_from_object;
  }
  /// Changes the pose of a view without writing its grid.
  void set_rig_from_object(std::size_t index, const Eigen::Isometry3d& pose) {
    entries_[index].rig_from_object = pose;
  }

 private:
  struct Entry {
    Eigen::Isometry3d rig_from_object;
    int width = 0;
    int height = 0;
    bool has_phase = false;
    bool has_systematic = false;
    bool has_color = false;
    float differing_share = 0.0F;
    std::size_t edge_pixels = 0;  ///< pixels
    std::int64_t offset = 0;
    std::int64_t reserved = 0;  ///< bytes of the file from `offset` on
    PixelBox box;               ///< of the grid; the file holds its pixels only
  };
  struct OptionalImages {
    bool phase = true;
    bool systematic = true;
    bool color = true;
  };
  [[nodiscard]] View read(std::size_t index, const OptionalImages& wanted) const;
  /// Writes a view to the place of its entry, or to the end of the file if the place is too small.
  void write(const View& view, Entry& entry);

  struct Rays {
    CameraModel camera;
    std::shared_ptr<const Image<Eigen::Vector2f>> of_pixels;
  };

  std::vector<Entry> entries_;
  mutable Rays rays_;  ///< of the camera that `rays` was last called with
  std::FILE* file_ = nullptr;
  std::int64_t end_ = 0;
};

/// Calls `use` with the number and the points of each view in turn, as `ViewStore::load_points`
/// returns them. The next view is loaded meanwhile, so memory holds two views.
///
/// @errors   Error(File) when a view cannot be read; and what `use` throws
void load_each_view(const ViewStore& views,
                    const std::function<void(std::size_t index, View& view)>& use,
                    PointSigma sigma = PointSigma::Noise);

/// Measured points of all views, neither smoothed nor averaged.
///
/// @units    mm, object frame
struct PointCloud {
  std::vector<Eigen::Vector3f> points_mm;  ///< positions
  std::vector<float> sigma_mm;  ///< noise of each point, standard deviation along its viewing ray
  /// Systematic standard uncertainty of each point along its viewing ray; empty when none is known.
  std::vector<float> systematic_mm;
};

/// Collects the points of all views, view by view and row by row, without edge pixels.
/// `terms`: systematic parts that are not stored with the views of this `camera_index`.
///
/// @units    mm, object frame
/// @missing  missing pixels are skipped
/// @errors   Error(Input) when a view and the camera differ in size
[[nodiscard]] PointCloud collect_points(const ViewStore& views,
                                        const CameraModel& camera,
                                        const Run& run = {},
                                        std::span<const SigmaTerm> terms = {},
                                        std::size_t camera_index = 0);

}  // namespace frangia

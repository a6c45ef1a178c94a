#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/views/view_group.h"

namespace frangia {

/// Places are told apart, and points agree, by shares of the spacing of the groups' points.
struct PlaceScale {
  double spacing_mm = 1.0;

  [[nodiscard]] double gate_mm() const { return 0.3 * spacing_mm; }   ///< what agrees
  [[nodiscard]] double start_mm() const { return 1.2 * spacing_mm; }  ///< motions are as near
  [[nodiscard]] double apart_mm() const { return 1.5 * spacing_mm; }  ///< places that differ
};

/// A place of one group on another that may be right.
struct GroupPlace {
  Eigen::Isometry3d to_from = Eigen::Isometry3d::Identity();
  GroupFit fit;

  /// What it is worth, where surfaces that are one come to lie `usual_mm` apart: points that agree,
  /// less those against it.
  [[nodiscard]] double score(double usual_mm) const;
};

/// A group and the features of its points.
struct KnownGroup {
  const ViewGroup& group;
  const Eigen::MatrixXf& features;
};

/// Places of one group on another by their shape alone, refined; best first, at most a few.
[[nodiscard]] std::vector<GroupPlace> find_places(const KnownGroup& to,
                                                  const KnownGroup& from,
                                                  const GroupViews& views,
                                                  const PlaceScale& scale);

/// Refines places and drops those that come to be the same or worth nothing; best first.
[[nodiscard]] std::vector<GroupPlace> refine_places(const ViewGroup& to,
                                                    const ViewGroup& from,
                                                    std::span<const Eigen::Isometry3d> starts,
                                                    const GroupViews& views,
                                                    const PlaceScale& scale);

/// Places beside one, shifted and turned in the two ways that are known least: what slides on a
/// face comes to rest in many.
[[nodiscard]] std::vector<Eigen::Isometry3d> places_beside(const GroupPlace& place,
                                                           const PlaceScale& scale);

/// Puts the best first, by `GroupPlace::score`.
void sort_places(std::vector<GroupPlace>& places, double usual_mm);

}  // namespace frangia

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/local_fit/surfel_map.h"
#include "frangia/registration/internal/table_state.h"
#include "frangia/registration/internal/view_pairs.h"
#include "frangia/rig/camera_model.h"

namespace frangia {

/// Surfels of one view, or of a region of it, compared with another view.
struct PairTally {
  std::size_t agree = 0;       ///< lie on the surface that the other view measured
  std::size_t violations = 0;  ///< lie in front of it, where the other view looked through them
  double weight = 0.0;         ///< sum of w of those that agree
  double weighted_mm = 0.0;    ///< sum of w r

  void add(const PairTally& other) {
    agree += other.agree;
    violations += other.violations;
    weight += other.weight;
    weighted_mm += other.weighted_mm;
  }
  /// Mean distance from the other view.
  [[nodiscard]] double mean_mm() const { return weighted_mm / weight; }
};

/// Regions of a view: quarters of its surfels, as `pick_all_surfels` orders them.
constexpr std::size_t kRegionsPerView = 4;

/// Surfels of one region of a view that are summed at once.
struct SurfelChunk {
  std::size_t view = 0;
  std::size_t region = 0;
  std::size_t first = 0;
  std::size_t count = 0;
};

/// All surfels in chunks, view by view and region by region.
[[nodiscard]] std::vector<SurfelChunk> chunks_of(
    std::span<const std::vector<SurfelMap::Surfel>> surfels);

/// Normal equations of all point-to-plane distances between views, in one state.
///
/// @shape    unknowns: as `TableState` orders them
/// @units    rad, mm
struct BundleSums {
  Eigen::MatrixXd hessian;            ///< sum of w J^T J
  Eigen::VectorXd gradient;           ///< sum of w J^T r
  double closing_weight = 0.0;        ///< sum of w s^2 of the pairs of the closing view and view 0;
                                      ///< s is the derivative by the closing view's angle
  double closing_gradient = 0.0;      ///< sum of w s r of these pairs
  std::vector<float> distances_mm;    ///< absolute, of all pairs within the gate
  std::vector<float> over_sigma;      ///< the same over the standard deviations of the pairs
  std::vector<std::size_t> matched;   ///< by view: its surfels on a surface that another view saw
  std::vector<std::size_t> observed;  ///< by view: its surfels that project onto another's surface
  std::vector<PairTally> regions;     ///< by view, other view, and region of the view
  Eigen::MatrixXd region_gradients;   ///< sum of w J, a column for each view and region of it

  [[nodiscard]] PairTally pair(std::size_t from, std::size_t to) const {
    PairTally all;
    for (std::size_t i = 0; i < kRegionsPerView; ++i)
      all.add(regions[kRegionsPerView * (from * matched.size() + to) + i]);
    return all;
  }
  /// The weight of all pairs of a view, of its own surfels and of those of the others.
  [[nodiscard]] double weight_of(std::size_t view) const {
    double all = 0.0;
    for (std::size_t other = 0; other < matched.size(); ++other)
      all += pair(view, other).weight + pair(other, view).weight;
    return all;
  }
};

struct BundleOptions {
  double gate_mm = 0.0;               ///< pairs farther apart do not belong to one surface
  double free_space_margin_mm = 0.0;  ///< a point violates free space from this distance on
};

/// Compares the surfels of each view with the surfels of its paired views that they project onto.
///
/// @shape    `surfels`, `maps` and `pairs`: one a view
/// @source   projective association: Blais & Levine 1995; symmetric point-to-plane distance:
///          Rusinkiewicz 2019; weights: Tukey's biweight over the variance of the pair
[[nodiscard]] BundleSums sum_bundle(std::span<const std::vector<SurfelMap::Surfel>> surfels,
                                    std::span<const SurfelMap> maps,
                                    const FastCameraModel& model,
                                    const TableState& state,
                                    const ViewPairs& pairs,
                                    const BundleOptions& options);

}  // namespace frangia

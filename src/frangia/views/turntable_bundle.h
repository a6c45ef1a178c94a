#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/rig/rig.h"
#include "frangia/views/fast_lens.h"
#include "frangia/views/plane_map.h"

namespace frangia {

/// What moves when views are registered: the axis, the angle of each view, and how the part stands
/// in each round but the first.
struct TableState {
  Turntable table;
  std::vector<double> angles_rad;
  std::vector<std::size_t> rounds;  ///< of each view; empty: all in the first
  std::vector<Eigen::Isometry3d>
      placings{};  ///< of each further round: what takes the part from its
                   ///< place in the first, both at angle 0, rig frame

  [[nodiscard]] std::size_t round_of(std::size_t view) const {
    return rounds.empty() ? 0 : rounds[view];
  }
  [[nodiscard]] Eigen::Isometry3d placing(std::size_t round) const {
    return round == 0 ? Eigen::Isometry3d::Identity() : placings[round - 1];
  }
  [[nodiscard]] Eigen::Index unknowns() const {
    return static_cast<Eigen::Index>(angles_rad.size() + 3 + 6 * placings.size());
  }
  /// Where the unknowns of a further round begin.
  [[nodiscard]] Eigen::Index place_of_round(std::size_t round) const {
    return static_cast<Eigen::Index>(angles_rad.size() + 3 + 6 * (round - 1));
  }
  /// The view whose turn closes with that of the first: the last of the first round.
  [[nodiscard]] std::size_t closing_view() const;
};

/// What another view says to the spots of one.
struct PairTally {
  std::size_t agree = 0;    ///< lie on what it saw
  std::size_t against = 0;  ///< lie before what it saw, where it would have seen them
};

/// How the views fit together in one state, and which way to go: the normal equations of all
/// point-to- plane distances between views.
///
/// shape    unknowns: two tilts of the axis and two shifts, about and along `across`; then the
/// angles of
///          views 1, 2, ...; view 0 is held; then three shifts and three turns of each further
///          round's placing, about the table's point
/// units    rad, mm
struct BundleSums {
  Eigen::MatrixXd hessian;
  Eigen::VectorXd gradient;
  double squares = 0.0;         ///< sum of w r^2
  double closing_weight = 0.0;  ///< sum of w s^2 of the pairs of the closing view and the first, s
                                ///< the slope by the last one's angle
  double closing_pull = 0.0;    ///< sum of w s r of them
  std::vector<float> distances_mm;  ///< of all pairs, without sign
  std::vector<std::size_t> met;     ///< by view: its spots that lie on a surface another view saw
  std::vector<std::size_t> faced;   ///< by view: its spots that another view looked at
  std::vector<PairTally> pairs;     ///< by view and other view, row by row

  [[nodiscard]] const PairTally& pair(std::size_t from, std::size_t to) const {
    return pairs[from * met.size() + to];
  }
};

/// The two directions across the axis in which it is moved.
[[nodiscard]] Eigen::Matrix<double, 3, 2> across(const Turntable& table);

struct BundleOptions {
  double gate_mm = 3.0;     ///< pairs farther apart are not of the same surface
  double through_mm = 3.0;  ///< a point farther before what a view saw is seen through
  std::optional<std::size_t> left_out = std::nullopt;  ///< a view that is not compared
};

/// Compares the spots of each view with the planes that they project onto in each other view.
///
/// shape    `spots` and `maps`: one a view
/// source   projective association, Blais & Levine 1995; symmetric distance, Rusinkiewicz 2019;
/// Tukey's
///          biweight
[[nodiscard]] BundleSums sum_bundle(std::span<const std::vector<PlaneMap::Spot>> spots,
                                    std::span<const PlaneMap> maps,
                                    const FastLens& lens,
                                    const TableState& state,
                                    const BundleOptions& options);

/// The state after a step in the unknowns.
[[nodiscard]] TableState moved(const TableState& state, const Eigen::VectorXd& step);

}  // namespace frangia

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/calibrate/internal/rig_bundle.h"

namespace frangia {

/// The covariance of the parameters of a rig.
struct SolvedCovariance {
  Eigen::MatrixXd covariance;
  std::vector<std::string> undetermined;  ///< parameters that the data do not determine
};

/// The covariance of cameras, projector and relative poses, with the poses and the board's shape
/// marginalized. Terms of the lenses that are held have the uncertainty that ordinary lenses leave,
/// so that it enters the parameters that would compensate them.
///
/// @shape    `names` are those of the first parameters of the layout, whose covariance is returned
/// @units    focal lengths and principal points px, rotation rad, translation mm
/// @missing  a parameter that is not determined has an infinite variance
/// @source   inverse of the normal equations; a direction whose eigenvalue is below 1e-12 of the
///           largest, in parameters scaled to unit diagonal, counts as not determined
[[nodiscard]] SolvedCovariance covariance_of(std::span<const RigObservation> observations,
                                             const RigFreedom& freedom,
                                             const RigNoise& noise,
                                             const RigParameters& parameters,
                                             const std::vector<std::string>& names);

/// A group of parameters that enters the model together when the data supports it.
struct ModelTerm {
  std::string name;
  std::vector<std::size_t> parameters;  ///< in the order of the layout
  bool of_board = false;
};

/// Terms beyond a principal point, one focal length and k1 of each device, the simplest first.
/// `cameras` are the names of the further cameras.
[[nodiscard]] std::vector<ModelTerm> optional_terms(const RigLayout& layout,
                                                    std::span<const std::string> cameras,
                                                    bool release_board);

void set_free(const ModelTerm& term, RigFreedom& freedom);

/// Whether all parameters of a term are estimated.
[[nodiscard]] bool is_free(const ModelTerm& term, const RigFreedom& freedom);

/// The term that lowers the weighted squares most beyond `min_gain` a parameter; none when there is
/// no such term.
///
/// @source   score test, Rao 1948, at the optimum of the present model; a gain of 2 a parameter is
///           Akaike's criterion
[[nodiscard]] std::optional<std::size_t> best_term(std::span<const RigObservation> observations,
                                                   std::span<const ModelTerm> terms,
                                                   const RigFreedom& freedom,
                                                   const RigNoise& noise,
                                                   const RigParameters& parameters,
                                                   double min_gain);

}  // namespace frangia

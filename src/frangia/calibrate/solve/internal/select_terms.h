#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frangia/calibrate/internal/rig_bundle.h"
#include "frangia/calibrate/internal/rig_observations.h"

namespace frangia {

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

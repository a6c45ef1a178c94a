#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/local_fit/surfel_map.h"
#include "frangia/registration/internal/turntable_bundle.h"
#include "frangia/registration/registration_report.h"
#include "frangia/rig/fast_camera_model.h"

namespace frangia {

/// The registration of a turntable's views on its way.
struct Bundle {
  std::vector<SurfelMap> maps;
  FastCameraModel model;
  TableState given;
  TableState state;
  Eigen::VectorXd prior_sigma;  ///< of each unknown
  double gate_mm = 0.0;
  double min_gate_mm = 0.0;  ///< the gate never closes farther than noise allows
  double systematic_mm = 0.0;
  int iterations = 0;
  std::optional<std::size_t> left_out{};  ///< a view that is not compared
};

/// One list of surfels a view.
using SurfelLists = std::vector<std::vector<SurfelMap::Surfel>>;

[[nodiscard]] SurfelLists pick_all_surfels(const std::vector<SurfelMap>& maps, std::size_t count);

[[nodiscard]] BundleSums sum(const Bundle& bundle, const SurfelLists& surfels);

[[nodiscard]] double median(std::vector<float> values);

/// Gauss-Newton until nothing moves by more than a hundredth of what noise would.
void optimize_bundle(Bundle& bundle,
                     const SurfelLists& surfels,
                     int max_iterations,
                     const Run& run);

/// What the data say less about than the prior does, by the eigenvectors of their information in
/// units of the prior's: sets `weakest`, `condition`, `axis_sigma_mm` and `open`.
void assess_observability(RegistrationReport& report, const Bundle& bundle, const BundleSums& sums);

}  // namespace frangia

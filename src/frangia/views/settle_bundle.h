#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/views/fast_lens.h"
#include "frangia/views/plane_map.h"
#include "frangia/views/registration_report.h"
#include "frangia/views/turntable_bundle.h"

namespace frangia {

/// The registration of a turntable's views on its way.
struct Bundle {
  std::vector<PlaneMap> maps;
  FastLens lens;
  TableState given;
  TableState state;
  Eigen::VectorXd prior_sigma;  ///< of each unknown
  double gate_mm = 0.0;
  double floor_mm = 0.0;  ///< the gate never closes farther than noise allows
  double systematic_mm = 0.0;
  int iterations = 0;
  std::optional<std::size_t> left_out{};  ///< a view that is not compared
};

/// One list of spots a view.
using Spots = std::vector<std::vector<PlaneMap::Spot>>;

[[nodiscard]] Spots pick_all(const std::vector<PlaneMap>& maps, std::size_t count);

[[nodiscard]] BundleSums sum(const Bundle& bundle, const Spots& spots);

[[nodiscard]] double median(std::vector<float> values);

/// Gauss-Newton until nothing moves by more than a hundredth of what noise would.
void settle(Bundle& bundle, const Spots& spots, int max_iterations, const Run& run);

/// What the data say less about than the prior does, by the eigenvectors of their information in
/// units of the prior's: sets `weakest`, `condition`, `axis_known_mm` and `open`.
void judge(RegistrationReport& report, const Bundle& bundle, const BundleSums& sums);

}  // namespace frangia

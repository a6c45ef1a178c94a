// What the views of a scan can tell of its fault at best, whatever program looks at them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/missing.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/registration/explain/internal/scored_round.h"
#include "frangia/registration/explain/internal/time_profiles.h"
#include "frangia/registration/internal/assess_fit.h"
#include "frangia/registration/refine_rig.h"
#include "frangia/registration/register_views.h"

#include "support/faulty_scan.h"

namespace frangia {

/// What the pairs of a scan's views can tell of its true fault.
struct PoseReach {
  /// By how much the true cause beats every other that moves the views otherwise, in expected log
  /// evidence.
  double log_odds = 0.0;
  /// The Cramer-Rao bound of the true cause: what it leaves open of the surfaces of the views, root
  /// mean square.
  double bound_mm = kMissing;
};

/// The hypotheses on the pairs of a scan in the true poses of its views, with a noise that is known
/// or with that of the pairs.
inline PoseRound round_at_truth(const testing::FaultyScan& scan,
                                const RayScene& part,
                                const std::optional<PairNoise>& noise) {
  const RegisterOptions options;
  const ViewStore views = scan.take(part);
  const std::vector<Station> stations = scan.stations();
  const TurntableStations given = scan.given(stations);
  const TableState state = given_state(given, options);
  Bundle bundle = make_bundle(views, scan.stated.reference().model, state, options, {});
  const SurfelLists surfels = pick_all_surfels(bundle.maps, surfels_to_explain(views.size()));
  const PoseChart chart = make_chart(bundle, surfels, state, times_of(stations), options);
  const Eigen::Isometry3d frame = chart.from.front() * scan.rig_from_part(0);
  PoseRound round{.bundle = std::move(bundle), .chart = chart};
  for (std::size_t view = 0; view < views.size(); ++view)
    round.poses.push_back(frame * scan.rig_from_part(view).inverse());
  const DriftModel model(*given.rig, RefineRigOptions{}, chart.setting.distance_mm);
  round.surfaces = surfaces_of(surfels, round.poses);
  sum_pairs(round,
            surfels,
            given,
            model,
            Eigen::VectorXd::Zero(chart.setting.rig_basis.cols() * model.count()));
  if (noise) {
    score_with(round, *noise);
  } else {
    score(round);
  }
  return round;
}

/// @shape    `noise`: that of the pairs of the scan without its fault
inline PoseReach reach_of(testing::FaultyScan scan,
                          const RayScene& part,
                          PoseCause truth,
                          const PairNoise& noise) {
  scan.noisy = false;
  const PoseRound round = round_at_truth(scan, part, noise);
  const auto at = std::find_if(round.causes.begin(),
                               round.causes.end(),
                               [&](const ScoredCause& cause) { return cause.cause == truth; });
  const auto own = static_cast<std::size_t>(at - round.causes.begin());
  PoseReach reach{std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < round.causes.size(); ++i) {
    if (i != own && !are_alike(round, own, i))
      reach.log_odds = std::min(reach.log_odds, at->log_odds - round.causes[i].log_odds);
  }
  if (changes_rig(truth)) return reach;  // its points move, too
  // The noise of these scans is independent, unlike what the registration expects of others.
  NormalEquations data = from_stated(round.sums.all(), round.at());
  const Eigen::Index unknowns = data.gradient.size();
  const PoseEvidence independent(std::move(data), padded(round.chart.table, unknowns));
  const Eigen::MatrixXd factor =
      independent.posterior(motions_of(at->best, round.chart.setting, unknowns)).factor;
  double squares = 0.0;
  for (Eigen::Index i = 0; i < factor.cols(); ++i)
    squares += std::pow(round.surface_mm(factor.col(i)), 2);
  reach.bound_mm = std::sqrt(squares);
  return reach;
}

}  // namespace frangia

#include "frangia/registration/explain/internal/pose_round.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "frangia/core/angles.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/robust_gauss_newton.h"
#include "frangia/registration/explain/internal/cause_motions.h"
#include "frangia/registration/explain/internal/time_profiles.h"
#include "frangia/registration/internal/table_state.h"

namespace frangia {
namespace {

using Motion6 = Eigen::Matrix<double, 6, 1>;

Eigen::Isometry3d moved(const Motion6& motion, const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d turn = motion.head<3>();
  Eigen::Isometry3d by = Eigen::Isometry3d::Identity();
  if (turn.norm() > 0.0)
    by.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  by.translation() = motion.tail<3>();
  return by * pose;
}

Motion6 motion_from(const Eigen::Isometry3d& given, const Eigen::Isometry3d& pose) {
  const Eigen::Isometry3d by = pose * given.inverse();
  const Eigen::AngleAxisd turn(by.linear());
  Motion6 motion;
  motion << turn.angle() * turn.axis(), by.translation();
  return motion;
}

Eigen::MatrixXd stacked(const ViewMotions& motions, const Eigen::VectorXd& sigma) {
  Eigen::MatrixXd all(static_cast<Eigen::Index>(6 * motions.size()), sigma.size());
  for (std::size_t view = 0; view < motions.size(); ++view)
    all.middleRows(static_cast<Eigen::Index>(6 * view), 6) = motions[view] * sigma.asDiagonal();
  return all;
}

/// Standard deviations of the table's unknowns: what the rig states, else the priors.
Eigen::VectorXd stated_sigmas(const Bundle& bundle) {
  const Turntable& table = bundle.given.table;
  Eigen::VectorXd sigma = bundle.prior_sigma;
  const auto angles = static_cast<Eigen::Index>(bundle.given.angles_rad.size()) - 1;
  if (!std::isnan(table.axis_sigma_rad)) sigma.head<2>().setConstant(table.axis_sigma_rad);
  if (!std::isnan(table.point_sigma_mm)) sigma.segment<2>(2).setConstant(table.point_sigma_mm);
  if (!std::isnan(table.angle_sigma_rad))
    sigma.segment(4, angles).setConstant(table.angle_sigma_rad);
  return sigma;
}

/// Holds the motions of a view that hardly move its surface along its normals, as of a round part
/// about its axis: else it would turn by many degrees to make up for a fault of a hundredth of a
/// millimetre.
void hold_open_motions(Linearization& at,
                       const Eigen::MatrixXd& data,
                       const BundleSums& sums,
                       const PoseSetting& setting,
                       std::size_t view,
                       const Eigen::VectorXd& off) {
  constexpr double kHeld = 1e4;  // times what the pairs of the view would tell of a shift
  const double pairs = sums.weight_of(view);
  const Eigen::Matrix<double, 6, 6> by = motions_of_part(setting, view);
  const auto first = static_cast<Eigen::Index>(6 * view);
  const auto eigen = symmetric_eigen(congruence(by, data.block<6, 6>(first, first)));
  const Eigen::Matrix<double, 6, 6> from = by.inverse();
  for (Eigen::Index i = 0; i < 6; ++i) {
    if (eigen.values[i] > kOpenMotion * kOpenMotion * pairs) continue;
    const Eigen::Matrix<double, 6, 1> row = from.transpose() * eigen.vectors.col(i);
    const double held = kHeld * pairs;
    at.hessian.block<6, 6>(first, first) += held * row * row.transpose();
    at.gradient.segment<6>(first) += held * row * row.dot(off.segment<6>(first));
  }
}

/// The table of each view as its setup stands on it: z is the axis.
std::vector<Eigen::Isometry3d> tables_of_views(const TableState& state) {
  const Eigen::Isometry3d rig_from_table = state.table.rig_from_object(0.0);
  std::vector<Eigen::Isometry3d> tables;
  for (std::size_t view = 0; view < state.angles_rad.size(); ++view) {
    tables.push_back(rig_from_table.inverse() * state.part_pose(state.setup_of(view)).inverse() *
                     rig_from_table);
  }
  return tables;
}

/// Centre and radius of the part that some surfels show.
void measure_part(PoseSetting& setting,
                  const SurfelLists& surfels,
                  const std::vector<Eigen::Isometry3d>& object_from_rig) {
  double count = 0.0;
  double squares = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t view = 0; view < surfels.size(); ++view) {
    for (const SurfelMap::Surfel& surfel : surfels[view]) {
      const Eigen::Vector3d point = object_from_rig[view] * surfel.point_mm.cast<double>();
      sum += point;
      squares += point.squaredNorm();
      count += 1.0;
    }
  }
  if (count == 0.0) return;
  setting.center_mm = sum / count;
  setting.radius_mm = std::sqrt(std::max(1e-12, squares / count - setting.center_mm.squaredNorm()));
}

}  // namespace

PoseChart PoseChart::with_exact_table() const {
  PoseChart exact = *this;
  exact.table_sigma = table_sigma.cwiseProduct(exact_share);
  exact.table = table * exact_share.asDiagonal();
  exact.exact_share.setOnes();
  return exact;
}

Eigen::VectorXd PoseChart::motions_to(const std::vector<Eigen::Isometry3d>& poses) const {
  Eigen::VectorXd all = stated;
  for (std::size_t view = 0; view < from.size(); ++view)
    all.segment<6>(static_cast<Eigen::Index>(6 * view)) += motion_from(from[view], poses[view]);
  return all;
}

std::vector<Eigen::Isometry3d> PoseChart::poses_at(const Eigen::VectorXd& motion) const {
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t view = 0; view < from.size(); ++view) {
    const auto at = static_cast<Eigen::Index>(6 * view);
    poses.push_back(moved(motion.segment<6>(at) - stated.segment<6>(at), from[view]));
  }
  return poses;
}

TableState PoseChart::table_at(const TableState& given, const Eigen::VectorXd& changes) const {
  return apply_update(state, table_sigma.cwiseProduct(changes) - deviation(state, given));
}

PoseChart make_chart(const Bundle& bundle,
                     const SurfelLists& surfels,
                     const TableState& state,
                     const std::vector<double>& times,
                     const RegisterOptions& options) {
  PoseChart chart;
  chart.state = state;
  for (const Eigen::Isometry3d& pose : object_poses(state))
    chart.from.push_back(pose.inverse());
  PoseSetting& setting = chart.setting;
  setting.views = bundle.maps.size();
  setting.angles_rad = bundle.given.angles_rad;
  setting.times = times;
  setting.rig_basis = basis_of_rigs(times);
  setting.distance_mm = bundle.prior_sigma[2] / options.relative_shift_sigma;
  measure_part(setting, surfels, chart.from);
  constexpr double kTilt_rad = rad_from_deg(0.1);  // as `RefineRigOptions` has them of a drift
  constexpr double kShift = 0.001;
  setting.object_from_rig = chart.from;
  if (!state.part_poses.empty()) setting.object_from_table = tables_of_views(state);
  setting.tilt_rad = kTilt_rad;
  setting.shift_mm = kShift * setting.distance_mm;
  chart.table_sigma = stated_sigmas(bundle);
  // Of the standard deviations that are assumed, which allow for a rig that was moved: most were
  // not.
  constexpr double kNotMoved = 0.03;
  const Eigen::Index own = 4 + static_cast<Eigen::Index>(state.angles_rad.size()) - 1;
  chart.exact_share = Eigen::VectorXd::Ones(state.unknowns());
  for (Eigen::Index i = 0; i < own; ++i)
    if (chart.table_sigma[i] >= bundle.prior_sigma[i]) chart.exact_share[i] = kNotMoved;
  const ViewMotions motions = motions_by_unknown(state);
  const Eigen::VectorXd beyond =
      (bundle.prior_sigma.cwiseAbs2() - chart.table_sigma.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  if (beyond.maxCoeff() > 0.0) setting.beyond_stated = stacked(motions, beyond);
  chart.table = stacked(motions, chart.table_sigma);
  chart.stated = product(stacked(motions, Eigen::VectorXd::Ones(state.unknowns())),
                         deviation(state, bundle.given));
  return chart;
}

void free_poses(Bundle& bundle,
                const SurfelLists& surfels,
                std::vector<Eigen::Isometry3d>& poses,
                const PoseChart& chart,
                const RegisterOptions& options,
                const Run& run) {
  const auto count = static_cast<Eigen::Index>(6 * poses.size());
  Eigen::VectorXd information(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double sigma = i % 6 < 3 ? options.tilt_sigma_rad
                                   : options.relative_shift_sigma * chart.setting.distance_mm;
    information[i] = 1.0 / (sigma * sigma);
  }
  const auto linearize = [&](double gate_mm) {
    bundle.gate_mm = gate_mm;
    const PoseSums sums = sum_poses(bundle, surfels, {poses, nullptr});
    const double weight = effective_weight(bundle, sums.fit);
    const NormalEquations data = sums.all();
    Linearization at;
    at.hessian = weight * data.hessian;
    const Eigen::VectorXd off = chart.motions_to(poses) - chart.stated;
    at.hessian.diagonal() += information;
    at.gradient = weight * data.gradient + information.cwiseProduct(off);
    if (!bundle.ties.empty()) {
      const NormalEquations ties = sum_pose_ties(bundle, {poses, nullptr});
      at.hessian += ties.hessian;
      at.gradient += ties.gradient;
    }
    for (std::size_t view = 0; view < poses.size(); ++view)
      hold_open_motions(at, data.hessian, sums.fit, chart.setting, view, off);
    at.median_residual = static_cast<double>(median(sums.fit.distances_mm));
    return at;
  };
  const auto update = [&](const Eigen::VectorXd& step) {
    for (std::size_t view = 0; view < poses.size(); ++view)
      poses[view] = moved(step.segment<6>(static_cast<Eigen::Index>(6 * view)), poses[view]);
  };
  const auto result = minimize_robustly({linearize, update},
                                        {.gate = bundle.gate_mm,
                                         .min_gate = bundle.min_gate_mm,
                                         .max_iterations = options.max_iterations},
                                        run);
  bundle.gate_mm = result.gate;
}

PairNoise noise_after(const Bundle& bundle,
                      const PoseSums& sums,
                      const PoseEvidence& plain,
                      const Eigen::VectorXd& at,
                      const Eigen::VectorXd& motion) {
  constexpr std::size_t kFewest = 100;  // pairs of a region: their noise must not count
  const double before = std::max(sums.squares, 1e-300);
  const double after = before + 2.0 * (plain.loss(motion) - plain.loss(at));
  const double ratio = std::sqrt(std::max(0.0, after / before));
  PairNoise noise;
  noise.excess =
      std::max(1.0, ratio * static_cast<double>(median(sums.fit.over_sigma)) / kMedianOfNormal);
  noise.scatter_mm = ratio * static_cast<double>(median(sums.fit.distances_mm)) / kMedianOfNormal;
  std::vector<float> means_mm = sums.region_means_mm(motion - at, kFewest);
  noise.regions = static_cast<double>(means_mm.size());
  for (float& mean : means_mm)
    mean = std::abs(mean);
  noise.shared_mm = std::max(bundle.systematic_mm,
                             static_cast<double>(median(std::move(means_mm))) / kMedianOfNormal);
  const auto errors = static_cast<double>(
      kRegionsPerView * std::min(bundle.maps.size(), count_pairs(bundle.pairs) / 2));
  const double independent = errors * std::pow(noise.scatter_mm / noise.shared_mm, 2);
  const auto pairs = static_cast<double>(std::max<std::size_t>(1, sums.fit.distances_mm.size()));
  noise.scale = std::min(1.0, independent / pairs) / (noise.excess * noise.excess);
  return noise;
}

NormalEquations from_stated(NormalEquations data, const Eigen::VectorXd& at) {
  data.gradient -= product(data.hessian, at);
  return data;
}

Eigen::MatrixXd padded(const Eigen::MatrixXd& some, Eigen::Index rows) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows, some.cols());
  all.topRows(some.rows()) = some;
  return all;
}

}  // namespace frangia

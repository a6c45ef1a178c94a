#include "frangia/views/register_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "frangia/core/missing.h"
#include "frangia/views/plane_map.h"
#include "frangia/views/turntable_bundle.h"

namespace frangia {
namespace {

constexpr double kPairsToOverlap = 0.05;  // of all spots: fewer are chance

struct Bundle {
  std::vector<PlaneMap> maps;
  FastLens lens;
  TableState given;
  TableState state;
  Eigen::VectorXd prior_sigma;
  double gate_mm = 0.0;
  double floor_mm = 0.0;  ///< the gate never closes farther than noise allows
  int iterations = 0;
  double systematic_mm = 0.0;
};

Eigen::VectorXd prior_sigmas(std::size_t views, const RegisterOptions& options) {
  Eigen::VectorXd sigma =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(views) + 3, options.angle_sigma_rad);
  sigma.head<2>().setConstant(options.tilt_sigma_rad);
  sigma.segment<2>(2).setConstant(options.shift_sigma_mm);
  return sigma;
}

/// How far the state is from the given one, in the unknowns.
Eigen::VectorXd departure(const Bundle& bundle) {
  const Eigen::Matrix<double, 3, 2> sides = across(bundle.state.table);
  Eigen::VectorXd away(bundle.prior_sigma.size());
  away.head<2>() = sides.transpose() * bundle.given.table.axis.cross(bundle.state.table.axis);
  away.segment<2>(2) =
      sides.transpose() * (bundle.state.table.point_mm - bundle.given.table.point_mm);
  for (std::size_t view = 1; view < bundle.state.angles_rad.size(); ++view) {
    away[static_cast<Eigen::Index>(view) + 3] =
        bundle.state.angles_rad[view] - bundle.given.angles_rad[view];
  }
  return away;
}

double median(std::vector<float> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

double rms_of(const std::vector<float>& distances) {
  double sum = 0.0;
  for (const float d : distances)
    sum += static_cast<double>(d) * static_cast<double>(d);
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, distances.size())));
}

double closure_rad(const BundleSums& sums) {
  return sums.closing_weight > 0.0 ? -sums.closing_pull / sums.closing_weight : kMissing;
}

using Spots = std::vector<std::vector<PlaneMap::Spot>>;

Spots pick_all(const std::vector<PlaneMap>& maps, std::size_t count) {
  Spots spots;
  for (const PlaneMap& map : maps)
    spots.push_back(pick_spots(map, count));
  return spots;
}

BundleSums sum(const Bundle& bundle, const Spots& spots) {
  return sum_bundle(spots, bundle.maps, bundle.lens, bundle.state, {bundle.gate_mm});
}

/// What the pairs count beside what was known before: as many fewer as have errors of their own,
/// when the error common to all pairs of two views is as given.
double worth_of(const Bundle& bundle, const BundleSums& sums) {
  const double pairs = static_cast<double>(std::max<std::size_t>(1, sums.distances_mm.size()));
  const double view_pairs = static_cast<double>(bundle.maps.size() * (bundle.maps.size() - 1));
  const double scatter = 1.4826 * median(sums.distances_mm);
  const double independent = view_pairs * std::pow(scatter / bundle.systematic_mm, 2);
  return std::min(1.0, independent / pairs);
}

/// Gauss-Newton until nothing moves by more than a hundredth of what noise would.
void settle(Bundle& bundle, const Spots& spots, int max_iterations, const Run& run) {
  const Eigen::VectorXd prior = bundle.prior_sigma.cwiseAbs2().cwiseInverse();
  for (int i = 0; i < max_iterations; ++i) {
    run.check();
    const BundleSums sums = sum(bundle, spots);
    const double worth = worth_of(bundle, sums);
    Eigen::MatrixXd hessian = worth * sums.hessian;
    hessian.diagonal() += prior;
    const Eigen::VectorXd slope = worth * sums.gradient + prior.cwiseProduct(departure(bundle));
    const Eigen::VectorXd step = -hessian.ldlt().solve(slope);
    bundle.state = moved(bundle.state, step);
    ++bundle.iterations;
    constexpr double kTukey = 4.685 * 1.4826;  // sigmas, in medians
    const double gate = std::max(bundle.floor_mm, kTukey * median(sums.distances_mm));
    const bool gate_rests = gate > 0.9 * bundle.gate_mm;
    bundle.gate_mm = std::min(bundle.gate_mm, gate);
    if (gate_rests && step.dot(hessian * step) < 1e-4) break;
  }
}

std::size_t total(const std::vector<std::size_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

/// Views of whose spots far fewer lie on what others saw than is usual.
std::vector<std::size_t> find_outliers(const BundleSums& sums) {
  std::vector<float> shares;
  for (std::size_t view = 0; view < sums.met.size(); ++view) {
    const auto faced = static_cast<float>(sums.faced[view]);
    shares.push_back(faced > 0.0F ? static_cast<float>(sums.met[view]) / faced : 1.0F);
  }
  const double usual = median(shares);
  std::vector<std::size_t> outliers;
  for (std::size_t view = 0; view < shares.size(); ++view) {
    if (static_cast<double>(shares[view]) < 0.4 * usual) outliers.push_back(view);
  }
  return outliers;
}

/// What the data say less about than the prior does, by the eigenvectors of their information in
/// units of the prior's.
void judge(RegistrationReport& report, const Bundle& bundle, const BundleSums& sums) {
  const Eigen::MatrixXd gain =
      worth_of(bundle, sums) *
      (bundle.prior_sigma.asDiagonal() * sums.hessian * bundle.prior_sigma.asDiagonal());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gain);
  report.weakest = std::sqrt(1.0 + std::max(0.0, solver.eigenvalues()[0]));
  report.condition = std::sqrt((1.0 + solver.eigenvalues().tail<1>()[0]) /
                               (1.0 + std::max(0.0, solver.eigenvalues()[0])));
  constexpr double kKnown = 9.0;  // three times better than before
  std::array<double, 3> open{};   // tilt, shift, angles
  for (Eigen::Index i = 0; i < solver.eigenvalues().size() && solver.eigenvalues()[i] < kKnown;
       ++i) {
    const Eigen::VectorXd direction = solver.eigenvectors().col(i).cwiseAbs2();
    open[0] += direction.head<2>().sum();
    open[1] += direction.segment<2>(2).sum();
    open[2] += direction.tail(direction.size() - 4).sum();
  }
  if (open[0] > 0.5) report.open.emplace_back("the tilt of the axis");
  if (open[1] > 0.5) report.open.emplace_back("the place of the axis");
  if (open[2] > 0.5) report.open.emplace_back("the angles of the views");
}

/// The refined table with its point nearest to the given one.
Turntable nearest_to(const Turntable& given, Turntable refined) {
  const Eigen::Vector3d away = given.point_mm - refined.point_mm;
  refined.point_mm += refined.axis * refined.axis.dot(away);
  return refined;
}

void leave_out(Bundle& bundle,
               ViewStore& views,
               std::span<const RegisteredView> stops,
               const std::vector<std::size_t>& outliers,
               const Run& run) {
  for (const std::size_t view : outliers) {
    run.warn(fmt::format("view {} fits no other view and is left out: was the part moved?",
                         stops[view].name.empty() ? std::to_string(view) : stops[view].name));
    View empty = views.load(view);
    for (float& depth : empty.range.depth_mm.pixels())
      depth = kMissing;
    views.replace(view, empty);
    for (auto& spot : bundle.maps[view].spots.pixels())
      spot = {};
  }
}

Bundle make_bundle(const ViewStore& views,
                   const Lens& camera,
                   const TableState& given,
                   const RegisterOptions& options,
                   const Run& run) {
  constexpr std::size_t kSpots = 250000;
  const CameraRays rays(camera);
  Bundle bundle{{},
                FastLens(camera),
                given,
                given,
                prior_sigmas(views.size(), options),
                options.reach_mm,
                0.0,
                0,
                options.systematic_mm};
  std::vector<float> sigmas;
  LocalPlanes planes;
  for (std::size_t i = 0; i < views.size(); ++i) {
    run.report(0.5 * static_cast<double>(i) / static_cast<double>(views.size()));
    planes = local_planes(views.load(i), rays, {}, std::move(planes));
    bundle.maps.push_back(plane_map(planes, rays, kSpots));
    for (const auto& spot : pick_spots(bundle.maps.back(), 1000))
      sigmas.push_back(spot.sigma_mm);
  }
  constexpr double kPairSigmas = 6.0;  // of one spot: over four of a pair's distance
  bundle.floor_mm = kPairSigmas * median(sigmas);
  return bundle;
}

}  // namespace

RegistrationReport register_views(ViewStore& views,
                                  const Lens& camera,
                                  const Turntable& given,
                                  std::span<const RegisteredView> stops,
                                  const RegisterOptions& options,
                                  const Run& run) {
  require(stops.size() == views.size(), "register_views: each view needs its table angle");
  RegistrationReport report;
  report.table = report.given = given;
  for (std::size_t i = 0; i < views.size(); ++i) {
    report.angles_rad.push_back(stops[i].angle_rad);
    views.set_rig_from_object(i, given.rig_from_object(stops[i].angle_rad));
  }
  report.given_angles_rad = report.angles_rad;
  if (views.size() < 2) {
    run.warn("one view alone cannot be registered: the rig's turntable is taken as it is");
    return report;
  }
  Bundle bundle = make_bundle(views, camera, {given, report.angles_rad}, options, run);
  constexpr std::size_t kFew = 2500;
  constexpr std::size_t kMany = 20000;
  Spots spots = pick_all(bundle.maps, kFew);
  const BundleSums before = sum(bundle, spots);
  report.rms_before_mm = rms_of(before.distances_mm);
  report.closure_before_rad = closure_rad(before);
  const std::size_t all = std::transform_reduce(
      spots.begin(), spots.end(), std::size_t{0}, std::plus<>(), [](const auto& s) {
        return s.size();
      });
  if (static_cast<double>(total(before.met)) < kPairsToOverlap * static_cast<double>(all)) {
    run.warn("the views do not overlap: the rig's turntable and angles are taken as they are");
    return report;
  }
  settle(bundle, spots, options.max_iterations, run);
  run.report(0.7);
  report.outliers = find_outliers(sum(bundle, spots));
  if (!report.outliers.empty()) {
    leave_out(bundle, views, stops, report.outliers, run);
    bundle.state = bundle.given;
    bundle.gate_mm = options.reach_mm;
    settle(bundle, pick_all(bundle.maps, kFew), options.max_iterations, run);
  }
  spots = pick_all(bundle.maps, kMany);
  settle(bundle, spots, options.max_iterations, run);
  run.report(0.9);
  const BundleSums after = sum(bundle, spots);
  report.rms_after_mm = rms_of(after.distances_mm);
  report.closure_after_rad = closure_rad(after);
  report.overlap =
      static_cast<double>(total(after.met)) /
      static_cast<double>(std::max<std::size_t>(
          1,
          std::transform_reduce(
              spots.begin(), spots.end(), std::size_t{0}, std::plus<>(), [](const auto& s) {
                return s.size();
              })));
  report.iterations = bundle.iterations;
  judge(report, bundle, after);
  report.table = nearest_to(given, bundle.state.table);
  report.angles_rad = bundle.state.angles_rad;
  for (std::size_t i = 0; i < views.size(); ++i) {
    views.set_rig_from_object(i, report.table.rig_from_object(report.angles_rad[i]));
  }
  return report;
}

std::string RegistrationReport::text() const {
  std::string words = fmt::format(
      "views agree to {:.4f} mm RMS (before: {:.3g} mm), {:.0f} % of their points overlap; the "
      "axis "
      "moved by {:.3f} mm and {:.3f} degrees, the angles by up to {:.3f} degrees",
      rms_after_mm,
      rms_before_mm,
      100.0 * overlap,
      axis_moved_mm(),
      deg_from_rad(axis_turned_rad()),
      deg_from_rad(largest_turn_rad()));
  if (!std::isnan(closure_after_rad)) {
    words += fmt::format("; the turn closes to {:.4f} degrees (before: {:.4f})",
                         std::abs(deg_from_rad(closure_after_rad)),
                         std::abs(deg_from_rad(closure_before_rad)));
  }
  for (const std::string& unknown : open) {
    words += fmt::format("; the part does not determine {}, which stays as the rig says", unknown);
  }
  return words;
}

double RegistrationReport::axis_moved_mm() const {
  return (table.point_mm - given.point_mm).norm();
}

double RegistrationReport::axis_turned_rad() const {
  return std::asin(std::min(1.0, given.axis.cross(table.axis).norm()));
}

double RegistrationReport::largest_turn_rad() const {
  double largest = 0.0;
  for (std::size_t i = 0; i < angles_rad.size(); ++i)
    largest = std::max(largest, std::abs(angles_rad[i] - given_angles_rad[i]));
  return largest;
}

}  // namespace frangia

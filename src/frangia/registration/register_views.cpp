#include "frangia/registration/register_views.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "frangia/core/missing.h"
#include "frangia/local_fit/make_surfel_maps.h"
#include "frangia/registration/internal/find_moved_view.h"
#include "frangia/registration/internal/optimize_bundle.h"

namespace frangia {
namespace {

constexpr double kMinOverlap = 0.05;  // of all surfels: fewer are chance

Eigen::VectorXd prior_sigmas(const TableState& state, const RegisterOptions& options) {
  constexpr double kFree = 1e4;  // mm, rad: nothing is known of how the part was set down
  Eigen::VectorXd sigma = Eigen::VectorXd::Constant(state.unknowns(), options.angle_sigma_rad);
  sigma.head<2>().setConstant(options.tilt_sigma_rad);
  sigma.segment<2>(2).setConstant(options.shift_sigma_mm);
  sigma.tail(static_cast<Eigen::Index>(6 * state.part_poses.size())).setConstant(kFree);
  return sigma;
}

double rms_of(const std::vector<float>& distances) {
  double sum = 0.0;
  for (const float d : distances)
    sum += static_cast<double>(d) * static_cast<double>(d);
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, distances.size())));
}

double closure_rad(const BundleSums& sums) {
  return sums.closing_weight > 0.0 ? -sums.closing_gradient / sums.closing_weight : kMissing;
}

/// Share of the surfels that lie on a surface another view saw.
double overlap_of(const BundleSums& sums, const SurfelLists& surfels) {
  std::size_t all = 0;
  for (const auto& own : surfels)
    all += own.size();
  const std::size_t matched =
      std::accumulate(sums.matched.begin(), sums.matched.end(), std::size_t{0});
  return static_cast<double>(matched) / static_cast<double>(std::max<std::size_t>(1, all));
}

/// Views of whose surfels far fewer lie on what others saw than is usual.
std::vector<std::size_t> find_outliers(const BundleSums& sums) {
  std::vector<float> shares;
  for (std::size_t view = 0; view < sums.matched.size(); ++view) {
    const auto observed = static_cast<float>(sums.observed[view]);
    shares.push_back(observed > 0.0F ? static_cast<float>(sums.matched[view]) / observed : 1.0F);
  }
  const double usual = median(shares);
  std::vector<std::size_t> outliers;
  for (std::size_t view = 0; view < shares.size(); ++view) {
    if (static_cast<double>(shares[view]) < 0.4 * usual) outliers.push_back(view);
  }
  return outliers;
}

/// The refined table with its point nearest to the given one.
Turntable nearest_to(const Turntable& given, Turntable refined) {
  const Eigen::Vector3d away = given.point_mm - refined.point_mm;
  refined.point_mm += refined.axis * refined.axis.dot(away);
  return refined;
}

/// Whether the given state fits the views as well as the one found, within what a view is off by
/// itself: then the rig, which was calibrated, knows better.
bool fits_as_well(const Bundle& bundle, const SurfelLists& surfels, const BundleSums& found) {
  constexpr double kAsWell = 1.02;
  Bundle as_given = bundle;
  as_given.state = bundle.given;
  const BundleSums given = sum(as_given, surfels);
  return given.distances_mm.size() >= found.distances_mm.size() / 100 * 99 &&
         median(given.distances_mm) < kAsWell * median(found.distances_mm);
}

/// A registration with all that it works on.
struct Registration {
  Bundle bundle;
  SurfelLists surfels;
  ViewStore& views;
  std::span<const Station> stations;
  const RegisterOptions& options;
  const Run& run;

  [[nodiscard]] std::string name_of(std::size_t view) const {
    return stations[view].name.empty() ? std::to_string(view) : stations[view].name;
  }
  void optimize_again() {
    bundle.state = bundle.given;
    bundle.gate_mm = options.reach_mm;
    optimize_bundle(bundle, surfels, options.max_iterations, run);
  }
  void leave_out(std::size_t view) {
    views.clear(view);
    surfels[view].clear();
    for (auto& surfel : bundle.maps[view].surfels.pixels())
      surfel = {};
  }
};

/// Views of a part that was moved go one by one, as long as each makes the others agree better.
void leave_out_moved(RegistrationReport& report, Registration& work) {
  if (!work.bundle.state.part_poses.empty()) return;  // each setup was looked at by itself
  const MovedViewOptions how{work.options.reach_mm, work.options.max_iterations};
  while (2 * (report.outliers.size() + 1) < work.views.size()) {
    const auto moved = find_moved_view(work.bundle, work.surfels, how, work.run);
    if (!moved) return;
    const std::string name = work.name_of(moved->view);
    work.run.warn(
        moved->alternative
            ? fmt::format("views {} and {} contradict each other, and the others do not tell which "
                          "of them is wrong: {} is left out; was the part moved?",
                          name,
                          work.name_of(*moved->alternative),
                          name)
            : fmt::format("view {} contradicts the others, which agree better without it, and is "
                          "left out: was the part moved?",
                          name));
    report.outliers.push_back(moved->view);
    work.leave_out(moved->view);
    work.optimize_again();
  }
}

/// What is left over when no one view is to blame.
void warn_of_violations(const BundleSums& sums, const Run& run) {
  constexpr double kMuch = 0.03;
  double most = 0.0;
  for (std::size_t view = 0; view < sums.matched.size(); ++view)
    most = std::max(most, free_space_violation(sums, view));
  if (most < kMuch) return;
  run.warn(
      fmt::format("the views contradict each other: up to {:.0f} % of a view's points lie before "
                  "what another view saw there; was the part moved, or is the rig's calibration "
                  "off?",
                  100.0 * most));
}

TableState given_state(const TurntableStations& given, const RegisterOptions& options) {
  TableState state{given.table, {}, {}, {}};
  const Eigen::Isometry3d rig_from_table = given.table.rig_from_object(0.0);
  for (const Station& station : given.stations) {
    require(station.setup <= options.part_poses.size(),
            "register_views: each further setup needs a part pose to start from");
    state.angles_rad.push_back(station.angle_rad);
    state.setups.push_back(station.setup);
  }
  for (const Eigen::Isometry3d& part_pose : options.part_poses)
    state.part_poses.push_back(rig_from_table * part_pose * rig_from_table.inverse());
  return state;
}

Bundle make_bundle(const ViewStore& views,
                   const CameraModel& camera,
                   const TableState& given,
                   const RegisterOptions& options,
                   const Run& run) {
  constexpr std::size_t kSurfels = 250000;
  Bundle bundle{make_surfel_maps(views, camera, kSurfels, run),
                FastCameraModel(camera),
                given,
                given,
                prior_sigmas(given, options),
                options.reach_mm,
                0.0,
                options.systematic_mm};
  std::vector<float> sigmas;
  for (const SurfelMap& map : bundle.maps) {
    for (const auto& surfel : pick_surfels(map, 1000))
      sigmas.push_back(surfel.sigma_mm);
  }
  constexpr double kPairSigmas = 6.0;  // of one surfel: over four of a pair's distance
  bundle.min_gate_mm = kPairSigmas * median(sigmas);
  return bundle;
}

/// Sets the poses of the views, and tells the state in the frame of its own table.
void apply_state(RegistrationReport& report, ViewStore& views, const TableState& state) {
  report.table = nearest_to(report.given, state.table);
  report.angles_rad = state.angles_rad;
  report.part_poses.clear();
  const Eigen::Isometry3d rig_from_table = report.table.rig_from_object(0.0);
  for (const Eigen::Isometry3d& part_pose : state.part_poses)
    report.part_poses.emplace_back(rig_from_table.inverse() * part_pose * rig_from_table);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::size_t setup = state.setup_of(i);
    const Eigen::Isometry3d rig_from_table_i = report.table.rig_from_object(report.angles_rad[i]);
    views.set_rig_from_object(
        i, setup == 0 ? rig_from_table_i : rig_from_table_i * report.part_poses[setup - 1]);
  }
}

/// Views that hardly overlap fit nearly as well with the axis elsewhere.
void warn_of_uncertain_axis(const RegistrationReport& report, const Run& run) {
  constexpr double kUncertain_mm = 0.05;
  if (report.axis_sigma_mm < kUncertain_mm) return;
  run.warn(fmt::format(
      "the {:.0f} % of the points that overlap tell where the axis is to no better than {:.2g} mm: "
      "the views may be off by more than that; add views between them, or calibrate the rig",
      100.0 * report.overlap,
      report.axis_sigma_mm));
}

void report_fit(RegistrationReport& report, const BundleSums& sums) {
  report.rms_after_mm = rms_of(sums.distances_mm);
  report.closure_after_rad = closure_rad(sums);
}

}  // namespace

RegistrationReport register_views(ViewStore& views,
                                  const CameraModel& camera,
                                  const TurntableStations& given,
                                  const RegisterOptions& options,
                                  const Run& run) {
  constexpr std::size_t kFew = 2500;
  constexpr std::size_t kMany = 20000;
  require(given.stations.size() == views.size(), "register_views: each view needs its table angle");
  RegistrationReport report;
  report.given = given.table;
  const TableState start = given_state(given, options);
  report.given_angles_rad = start.angles_rad;
  apply_state(report, views, start);
  if (views.size() < 2) {
    run.warn("one view alone cannot be registered: the rig's turntable is taken as it is");
    return report;
  }
  Registration work{
      make_bundle(views, camera, start, options, run), {}, views, given.stations, options, run};
  Bundle& bundle = work.bundle;
  SurfelLists& surfels = work.surfels;
  surfels = pick_all_surfels(bundle.maps, kFew);
  const BundleSums before = sum(bundle, surfels);
  report.rms_before_mm = rms_of(before.distances_mm);
  report.closure_before_rad = closure_rad(before);
  if (overlap_of(before, surfels) < kMinOverlap) {
    run.warn("the views do not overlap: the rig's turntable and angles are taken as they are");
    return report;
  }
  optimize_bundle(bundle, surfels, options.max_iterations, run);
  run.report(0.7);
  report.outliers = find_outliers(sum(bundle, surfels));
  for (const std::size_t view : report.outliers) {
    run.warn(fmt::format("view {} fits no other view and is left out: was the part moved?",
                         work.name_of(view)));
    work.leave_out(view);
  }
  if (!report.outliers.empty()) work.optimize_again();
  leave_out_moved(report, work);
  surfels = pick_all_surfels(bundle.maps, kMany);
  optimize_bundle(bundle, surfels, options.max_iterations, run);
  run.report(0.9);
  const BundleSums after = sum(bundle, surfels);
  warn_of_violations(after, run);
  report_fit(report, after);
  report.overlap = overlap_of(after, surfels);
  report.iterations = bundle.iterations;
  report.kept_rig = fits_as_well(bundle, surfels, after);
  if (report.kept_rig) {
    bundle.state = bundle.given;
    report_fit(report, sum(bundle, surfels));
  }
  assess_observability(report, bundle, after);
  warn_of_uncertain_axis(report, run);
  apply_state(report, views, bundle.state);
  return report;
}

}  // namespace frangia

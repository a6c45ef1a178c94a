#include "frangia/views/register_views.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "frangia/core/missing.h"
#include "frangia/views/find_moved_view.h"
#include "frangia/views/map_views.h"
#include "frangia/views/settle_bundle.h"

namespace frangia {
namespace {

constexpr double kPairsToOverlap = 0.05;  // of all spots: fewer are chance

Eigen::VectorXd prior_sigmas(const TableState& state, const RegisterOptions& options) {
  constexpr double kFree = 1e4;  // mm, rad: nothing is known of how the part was set down
  Eigen::VectorXd sigma = Eigen::VectorXd::Constant(state.unknowns(), options.angle_sigma_rad);
  sigma.head<2>().setConstant(options.tilt_sigma_rad);
  sigma.segment<2>(2).setConstant(options.shift_sigma_mm);
  sigma.tail(static_cast<Eigen::Index>(6 * state.placings.size())).setConstant(kFree);
  return sigma;
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

/// Share of the spots that lie on a surface another view saw.
double overlap_of(const BundleSums& sums, const Spots& spots) {
  std::size_t all = 0;
  for (const auto& own : spots)
    all += own.size();
  const std::size_t met = std::accumulate(sums.met.begin(), sums.met.end(), std::size_t{0});
  return static_cast<double>(met) / static_cast<double>(std::max<std::size_t>(1, all));
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

/// The refined table with its point nearest to the given one.
Turntable nearest_to(const Turntable& given, Turntable refined) {
  const Eigen::Vector3d away = given.point_mm - refined.point_mm;
  refined.point_mm += refined.axis * refined.axis.dot(away);
  return refined;
}

/// Whether the given state fits the views as well as the one found, within what a view is off by
/// itself: then the rig, which was calibrated, knows better.
bool fits_as_well(const Bundle& bundle, const Spots& spots, const BundleSums& found) {
  constexpr double kAsWell = 1.02;
  Bundle as_given = bundle;
  as_given.state = bundle.given;
  const BundleSums given = sum(as_given, spots);
  return given.distances_mm.size() >= found.distances_mm.size() / 100 * 99 &&
         median(given.distances_mm) < kAsWell * median(found.distances_mm);
}

/// A registration with all that it works on.
struct Work {
  Bundle bundle;
  Spots spots;
  ViewStore& views;
  std::span<const RegisteredView> stops;
  const RegisterOptions& options;
  const Run& run;

  [[nodiscard]] std::string name_of(std::size_t view) const {
    return stops[view].name.empty() ? std::to_string(view) : stops[view].name;
  }
  void settle_again() {
    bundle.state = bundle.given;
    bundle.gate_mm = options.reach_mm;
    settle(bundle, spots, options.max_iterations, run);
  }
  void leave_out(std::size_t view) {
    views.clear(view);
    spots[view].clear();
    for (auto& spot : bundle.maps[view].spots.pixels())
      spot = {};
  }
};

/// Views of a part that was moved go one by one, as long as each makes the others agree better.
void leave_out_moved(RegistrationReport& report, Work& work) {
  if (!work.bundle.state.placings.empty()) return;  // each round was looked at by itself
  const MovedViewOptions how{work.options.reach_mm, work.options.max_iterations};
  while (2 * (report.outliers.size() + 1) < work.views.size()) {
    const auto moved = find_moved_view(work.bundle, work.spots, how, work.run);
    if (!moved) return;
    const std::string name = work.name_of(moved->view);
    work.run.warn(
        moved->rival
            ? fmt::format("views {} and {} contradict each other, and the others do not tell which "
                          "of them is wrong: {} is left out; was the part moved?",
                          name,
                          work.name_of(*moved->rival),
                          name)
            : fmt::format("view {} contradicts the others, which agree better without it, and is "
                          "left out: was the part moved?",
                          name));
    report.outliers.push_back(moved->view);
    work.leave_out(moved->view);
    work.settle_again();
  }
}

/// What is left over when no one view is to blame.
void warn_of_contradiction(const BundleSums& sums, const Run& run) {
  constexpr double kMuch = 0.03;
  double most = 0.0;
  for (std::size_t view = 0; view < sums.met.size(); ++view)
    most = std::max(most, contradiction_of(sums, view));
  if (most < kMuch) return;
  run.warn(
      fmt::format("the views contradict each other: up to {:.0f} % of a view's points lie before "
                  "what another view saw there; was the part moved, or is the rig's calibration "
                  "off?",
                  100.0 * most));
}

TableState given_state(const TableStops& given, const RegisterOptions& options) {
  TableState state{given.table, {}, {}, {}};
  const Eigen::Isometry3d rig_from_table = given.table.rig_from_object(0.0);
  for (const RegisteredView& stop : given.stops) {
    require(stop.round <= options.placings.size(),
            "register_views: each further round needs a placing to start from");
    state.angles_rad.push_back(stop.angle_rad);
    state.rounds.push_back(stop.round);
  }
  for (const Eigen::Isometry3d& placing : options.placings)
    state.placings.push_back(rig_from_table * placing * rig_from_table.inverse());
  return state;
}

Bundle make_bundle(const ViewStore& views,
                   const Lens& camera,
                   const TableState& given,
                   const RegisterOptions& options,
                   const Run& run) {
  constexpr std::size_t kSpots = 250000;
  Bundle bundle{map_views(views, camera, kSpots, run),
                FastLens(camera),
                given,
                given,
                prior_sigmas(given, options),
                options.reach_mm,
                0.0,
                options.systematic_mm};
  std::vector<float> sigmas;
  for (const PlaneMap& map : bundle.maps) {
    for (const auto& spot : pick_spots(map, 1000))
      sigmas.push_back(spot.sigma_mm);
  }
  constexpr double kPairSigmas = 6.0;  // of one spot: over four of a pair's distance
  bundle.floor_mm = kPairSigmas * median(sigmas);
  return bundle;
}

/// Sets the poses of the views, and tells the state in the frame of its own table.
void take_over(RegistrationReport& report, ViewStore& views, const TableState& state) {
  report.table = nearest_to(report.given, state.table);
  report.angles_rad = state.angles_rad;
  report.placings.clear();
  const Eigen::Isometry3d rig_from_table = report.table.rig_from_object(0.0);
  for (const Eigen::Isometry3d& placing : state.placings)
    report.placings.emplace_back(rig_from_table.inverse() * placing * rig_from_table);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::size_t round = state.round_of(i);
    const Eigen::Isometry3d rig_from_table_i = report.table.rig_from_object(report.angles_rad[i]);
    views.set_rig_from_object(
        i, round == 0 ? rig_from_table_i : rig_from_table_i * report.placings[round - 1]);
  }
}

/// Views that hardly overlap fit nearly as well with the axis elsewhere.
void warn_of_loose_axis(const RegistrationReport& report, const Run& run) {
  constexpr double kLoose_mm = 0.05;
  if (report.axis_known_mm < kLoose_mm) return;
  run.warn(fmt::format(
      "the {:.0f} % of the points that overlap tell where the axis is to no better than {:.2g} mm: "
      "the views may be off by more than that; add views between them, or calibrate the rig",
      100.0 * report.overlap,
      report.axis_known_mm));
}

void tell_fit(RegistrationReport& report, const BundleSums& sums) {
  report.rms_after_mm = rms_of(sums.distances_mm);
  report.closure_after_rad = closure_rad(sums);
}

}  // namespace

RegistrationReport register_views(ViewStore& views,
                                  const Lens& camera,
                                  const TableStops& given,
                                  const RegisterOptions& options,
                                  const Run& run) {
  constexpr std::size_t kFew = 2500;
  constexpr std::size_t kMany = 20000;
  require(given.stops.size() == views.size(), "register_views: each view needs its table angle");
  RegistrationReport report;
  report.given = given.table;
  const TableState start = given_state(given, options);
  report.given_angles_rad = start.angles_rad;
  take_over(report, views, start);
  if (views.size() < 2) {
    run.warn("one view alone cannot be registered: the rig's turntable is taken as it is");
    return report;
  }
  Work work{make_bundle(views, camera, start, options, run), {}, views, given.stops, options, run};
  Bundle& bundle = work.bundle;
  Spots& spots = work.spots;
  spots = pick_all(bundle.maps, kFew);
  const BundleSums before = sum(bundle, spots);
  report.rms_before_mm = rms_of(before.distances_mm);
  report.closure_before_rad = closure_rad(before);
  if (overlap_of(before, spots) < kPairsToOverlap) {
    run.warn("the views do not overlap: the rig's turntable and angles are taken as they are");
    return report;
  }
  settle(bundle, spots, options.max_iterations, run);
  run.report(0.7);
  report.outliers = find_outliers(sum(bundle, spots));
  for (const std::size_t view : report.outliers) {
    run.warn(fmt::format("view {} fits no other view and is left out: was the part moved?",
                         work.name_of(view)));
    work.leave_out(view);
  }
  if (!report.outliers.empty()) work.settle_again();
  leave_out_moved(report, work);
  spots = pick_all(bundle.maps, kMany);
  settle(bundle, spots, options.max_iterations, run);
  run.report(0.9);
  const BundleSums after = sum(bundle, spots);
  warn_of_contradiction(after, run);
  tell_fit(report, after);
  report.overlap = overlap_of(after, spots);
  report.iterations = bundle.iterations;
  report.kept_rig = fits_as_well(bundle, spots, after);
  if (report.kept_rig) {
    bundle.state = bundle.given;
    tell_fit(report, sum(bundle, spots));
  }
  judge(report, bundle, after);
  warn_of_loose_axis(report, run);
  take_over(report, views, bundle.state);
  return report;
}

}  // namespace frangia

#include "frangia/registration/register_views.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/held_messages.h"
#include "frangia/core/missing.h"
#include "frangia/core/statistics.h"
#include "frangia/registration/internal/assess_fit.h"
#include "frangia/registration/internal/assess_observability.h"
#include "frangia/registration/internal/explain_poses.h"
#include "frangia/registration/internal/optimize_bundle.h"
#include "frangia/registration/internal/table_state.h"
#include "frangia/registration/internal/turntable_bundle.h"
#include "frangia/registration/internal/view_transfer.h"

namespace frangia {
namespace {

double closure_rad(const BundleSums& sums) {
  return sums.closing_weight > 0.0 ? -sums.closing_gradient / sums.closing_weight : kMissing;
}

/// Whether the given state fits the views as well as the refined one. Then the rig's calibration
/// is the better estimate: noise alone can move what the overlap determines badly by millimetres.
bool fits_as_well(const Bundle& bundle,
                  const SurfelLists& surfels,
                  const BundleSums& found,
                  double factor) {
  // Relative standard error of a median of points of which about 10 neighbours have like errors.
  constexpr double kErrorOfMedian = 4.0;
  Bundle as_given = bundle;
  as_given.state = bundle.given;
  const BundleSums given = sum(as_given, surfels);
  const auto count = static_cast<double>(std::max<std::size_t>(1, found.distances_mm.size()));
  const double allowed = std::max(factor, 1.0 + kErrorOfMedian / std::sqrt(count));
  const double ratio = static_cast<double>(median(given.distances_mm)) /
                       static_cast<double>(median(found.distances_mm));
  const auto has_fewer = [](const BundleSums& one, const BundleSums& other) {
    return one.distances_mm.size() < other.distances_mm.size() / 100 * 99;
  };
  if (has_fewer(given, found)) return false;
  constexpr double kMuch = 9.0;  // of chi squared: three standard deviations
  if (sum_ties(bundle.ties, bundle.given).chi_squared >
      sum_ties(bundle.ties, bundle.state).chi_squared + kMuch)
    return false;
  // A better axis brings more points together, not fewer.
  constexpr double kNearly = 1.1;
  return ratio < (has_fewer(found, given) ? std::max(allowed, kNearly) : allowed);
}

/// Whether the refined state makes views contradict each other that do not at the given one. It
/// has slid along faces that do not hold it.
bool has_slid(const Bundle& bundle, const SurfelLists& surfels, double found_contradiction) {
  constexpr double kMore = 0.01;  // share of a view's points; without a fault it is below 0.002
  Bundle as_given = bundle;
  as_given.state = bundle.given;
  return found_contradiction > contradiction_of(sum(as_given, surfels), surfels) + kMore;
}

/// Marks a report whose views contradict each other although no single view explains it.
void assess_contradiction(RegistrationReport& report, const BundleSums& sums, Registration& work) {
  report.contradiction = contradiction_of(sums, work.surfels);
  report.trustworthy = report.contradiction <= work.options.max_contradiction;
  work.contradicting.reset();
  if (!report.trustworthy)
    work.contradicting = contradicting_view(sums, work.surfels, work.options.max_contradiction);
}

/// Sets the poses of the views, and reports the state in the frame of its own table.
void apply_state(RegistrationReport& report, ViewStore& views, const TableState& state) {
  report.table = nearest_to(report.given, state.table);
  report.angles_rad = state.angles_rad;
  report.part_poses.clear();
  const Eigen::Isometry3d rig_from_table = report.table.rig_from_object(0.0);
  for (const Eigen::Isometry3d& part_pose : state.part_poses)
    report.part_poses.emplace_back(rig_from_table.inverse() * part_pose * rig_from_table);
  TableState in_frame = state;
  in_frame.table = report.table;
  const std::vector<Eigen::Isometry3d> poses = object_poses(in_frame);
  for (std::size_t i = 0; i < views.size(); ++i)
    views.set_rig_from_object(i, poses[i]);
}

/// Warns when the views fit nearly as well with the axis elsewhere, as with little overlap.
void warn_of_uncertain_axis(const RegistrationReport& report,
                            const PartScale& scale,
                            const RegisterOptions& options,
                            const Run& run) {
  if (report.axis_sigma_mm < options.max_axis_sigma_px * scale.sampling_mm) return;
  run.warn(fmt::format(
      "the {:.0f} % of the points that overlap determine the axis only to {:.2g} mm, and the views "
      "may be displaced by more than that: add views between them, or calibrate the rig",
      100.0 * report.overlap,
      report.axis_sigma_mm));
}

void report_fit(RegistrationReport& report, const BundleSums& sums) {
  report.rms_after_mm = rms_of(sums.distances_mm);
  report.closure_after_rad = closure_rad(sums);
}

/// Reports views that do not overlap, so that the rig alone places them.
void report_rig_alone(RegistrationReport& report, const BundleSums& sums, Registration& work) {
  assess_contradiction(report, sums, work);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(work.bundle.state.unknowns());
  assess_places(report, work.bundle, sums, work.options, Overlap::SaysNothing, none);
  const std::string untrusted = report.untrusted_reason();
  work.run.warn((untrusted.empty() ? "the views do not overlap" : untrusted) + "; " +
                report.rig_alone_text());
}

void report_sums(RegistrationReport& report, const BundleSums& sums, Registration& work) {
  assess_contradiction(report, sums, work);
  report_fit(report, sums);
  report.overlap = overlap_of(sums, work.surfels);
}

/// Triangulates the points of each view by the rig as it was while the view was taken, and
/// registers them again.
void correct_drift(Registration& work,
                   const TurntableStations& given,
                   const std::vector<Rig>& rigs) {
  for (std::size_t view = 0; view < work.views.size(); ++view) {
    work.views.replace(
        view, retriangulate(work.views.load(view), *given.pattern, *given.rig, rigs[view]));
  }
  // The ties go with the old bundle: their points are those of the rig as stated.
  work.bundle = make_bundle(
      work.views, given.rig->reference().model, work.bundle.given, work.options, work.run);
  work.surfels = pick_all_surfels(work.bundle.maps, surfels_to_explain(work.views.size()));
  work.optimize_again();
}

/// Adds changes by which the views are uncertain, too.
void add_motions(ViewMotions& motions, const ViewMotions& more) {
  if (motions.size() != more.size()) return;
  for (std::size_t view = 0; view < motions.size(); ++view) {
    Eigen::Matrix<double, 6, Eigen::Dynamic> both(6, motions[view].cols() + more[view].cols());
    both << motions[view], more[view];
    motions[view] = std::move(both);
  }
}

/// Explains what the views still disagree about once their points are those of the rigs that were
/// found: what moved the camera moved it against the table, too.
void explain_rest(RegistrationReport& report,
                  ExplainedPoses& found,
                  const TurntableStations& given,
                  const Registration& work,
                  std::size_t dense) {
  ExplainedPoses rest = explain_poses(work, {given.table, given.stations}, dense);
  if (rest.explanation.best == PoseCause::Unexplained) report.explanation = rest.explanation;
  if (rest.corrected) {
    add_motions(rest.corrected->motions, found.spread);
  } else {
    add_motions(found.spread, rest.spread);
  }
  found.corrected = std::move(rest.corrected);
}

/// Whether the table alone does not explain the places of the views, which are then corrected.
bool apply_correction(RegistrationReport& report, ExplainedPoses& found, Registration& work) {
  if (!found.corrected) return false;
  CorrectedPoses& poses = *found.corrected;
  assess_contradiction(report, poses.wide, work);
  report_fit(report, poses.fit);
  report.overlap = overlap_of(poses.wide, work.surfels);
  apply_state(report, work.views, poses.state);
  for (std::size_t view = 0; view < work.views.size(); ++view)
    work.views.set_rig_from_object(view, poses.object_from_rig[view].inverse());
  const double distance_mm = work.bundle.prior_sigma[2] / work.options.relative_shift_sigma;
  report.sigma = sigma_of(report.given, work.options, distance_mm);
  report.motions = std::move(poses.motions);
  report.iterations = work.bundle.iterations;
  return true;
}

/// Decides between the given state and the refined one, and assesses the places of the views.
/// Returns whether the refined one slid, so that the rig alone places them.
bool keep_better_state(RegistrationReport& report, const BundleSums& refined, Registration& work) {
  Bundle& bundle = work.bundle;
  const bool slid = has_slid(bundle, work.surfels, report.contradiction);
  report.kept_rig =
      slid || fits_as_well(bundle, work.surfels, refined, work.options.as_good_as_given);
  Eigen::VectorXd offset = Eigen::VectorXd::Zero(bundle.given.unknowns());
  if (!report.kept_rig) {
    assess_places(report, bundle, refined, work.options, Overlap::Determines, offset);
    return slid;
  }
  if (!slid) offset = deviation(bundle.state, bundle.given);
  bundle.state = bundle.given;
  const BundleSums sums = sum(bundle, work.surfels);
  report_sums(report, sums, work);
  const Overlap overlap = slid ? Overlap::SaysNothing : Overlap::Determines;
  assess_places(report, bundle, sums, work.options, overlap, offset);
  return slid;
}

/// A registration, and the view that makes it untrustworthy, if there is one.
struct Attempt {
  RegistrationReport report;
  std::optional<std::size_t> at_fault{};
};

Attempt register_once(ViewStore& views,
                      const CameraModel& camera,
                      const TurntableStations& given,
                      const RegisterOptions& options,
                      const Run& run) {
  const std::size_t many_surfels = surfels_per_view(20000, views.size());
  RegistrationReport report;
  report.given = given.table;
  const TableState start = given_state(given, options);
  report.given_angles_rad = start.angles_rad;
  apply_state(report, views, start);
  if (views.size() < 2) {
    run.warn("one view alone cannot be registered: the axis and angles of the rig are kept");
    return {report};
  }
  Bundle made = make_bundle(views, camera, start, options, run);
  made.ties.assign(given.ties.begin(), given.ties.end());
  const double reach_mm = made.gate_mm;
  Registration work{std::move(made), {}, reach_mm, views, given.stations, options, run};
  Bundle& bundle = work.bundle;
  SurfelLists& surfels = work.surfels;
  surfels = pick_all_surfels(bundle.maps, surfels_to_explain(views.size()));
  const BundleSums before = sum(bundle, surfels);
  report.rms_before_mm = rms_of(before.distances_mm);
  report.closure_before_rad = closure_rad(before);
  report.overlap = overlap_of(before, surfels);
  if (report.overlap < kMinOverlap && bundle.ties.empty()) {
    report_rig_alone(report, before, work);
    return {report, work.contradicting};
  }
  optimize_bundle(bundle, surfels, options.max_iterations, run);
  run.report(0.5);
  ExplainedPoses explained = explain_registration(report, work, given, many_surfels);
  report.rig_open = std::move(explained.rig_open);
  const PoseExplanation& explanation = report.explanation;
  if (!explained.rigs.empty()) {
    correct_drift(work, given, explained.rigs);
    explain_rest(report, explained, given, work, many_surfels);
  }
  // A view that moved is reported when it is left out, and `untrusted_reason` reports Unexplained.
  const bool is_reported = explanation.best == PoseCause::Unexplained ||
                           (explanation.best == PoseCause::ViewMoved && !report.outliers.empty());
  if (!explanation.text.empty() && !is_reported) {
    run.warn(explanation.remedy.empty() ? explanation.text
                                        : explanation.text + "; " + explanation.remedy);
  }
  run.report(0.7);
  // What a wrong rig does to the views is judged once it is refined.
  const bool is_refined = explanation.best == PoseCause::Rig && explanation.decided &&
                          options.wrong_rig == WrongRig::IsRefined;
  // Points that were triangulated again with other rigs differ from those in the views.
  const bool may_blame = explained.rigs.empty() && !is_refined;
  const auto warn_if_untrusted = [&] {
    if (!is_refined && !report.untrusted_reason().empty()) run.warn(report.untrusted_reason());
  };
  if (apply_correction(report, explained, work)) {
    warn_if_untrusted();
    return {report, may_blame ? view_at_fault(report, work) : std::nullopt};
  }
  if (explanation.best == PoseCause::AsStated || explanation.best == PoseCause::ViewMoved)
    leave_out_outliers(report, work);
  surfels = pick_all_surfels(bundle.maps, many_surfels);
  optimize_bundle(bundle, surfels, options.max_iterations, run);
  run.report(0.9);
  const BundleSums after = sum(bundle, surfels);
  report_sums(report, after, work);
  report.iterations = bundle.iterations;
  const bool slid = keep_better_state(report, after, work);
  add_motions(report.motions, explained.spread);
  warn_if_untrusted();
  if (slid && !is_refined) run.warn(report.rig_alone_text());
  const PartScale scale = measure_part_scale(bundle, surfels, camera);
  assess_observability(report, bundle, after, surfels, scale.radius_mm);
  warn_of_uncertain_axis(report, scale, options, run);
  apply_state(report, views, bundle.state);
  return {report, may_blame ? view_at_fault(report, work) : std::nullopt};
}

}  // namespace

std::string Station::label(std::size_t view) const {
  constexpr std::string_view kFolder = "views/";
  if (name.empty()) return std::to_string(view);
  return name.starts_with(kFolder) ? name.substr(kFolder.size()) : name;
}

void RegisterOptions::check() const {
  require(angle_sigma_rad > 0.0, "RegisterOptions: angle_sigma_rad must be above 0");
  require(tilt_sigma_rad > 0.0, "RegisterOptions: tilt_sigma_rad must be above 0");
  require(relative_shift_sigma > 0.0, "RegisterOptions: relative_shift_sigma must be above 0");
  require(relative_reach > 0.0, "RegisterOptions: relative_reach must be above 0");
  require(relative_systematic > 0.0, "RegisterOptions: relative_systematic must be above 0");
  require(max_contradiction >= 0.0, "RegisterOptions: max_contradiction must not be negative");
  require(unverified_share >= 0.0, "RegisterOptions: unverified_share must not be negative");
  require(max_iterations >= 1, "RegisterOptions: max_iterations must be at least 1");
}

RegistrationReport register_views(ViewStore& views,
                                  const CameraModel& camera,
                                  const TurntableStations& given,
                                  const RegisterOptions& options,
                                  const Run& run) {
  options.check();
  require(given.stations.size() == views.size(),
          "register_views: the number of stations differs from the number of views");
  TurntableStations used = given;
  std::vector<PointTie> ties(given.ties.begin(), given.ties.end());
  std::vector<std::size_t> outliers;
  for (;;) {
    HeldMessages held;
    Attempt found = held.during(run, [&](const Run& attempt) {
      return register_once(views, camera, used, options, attempt);
    });
    const auto& own = found.report.outliers;
    outliers.insert(outliers.end(), own.begin(), own.end());
    if (!found.at_fault || 4 * (outliers.size() + 1) > views.size()) {
      held.pass_on(run);
      found.report.outliers = std::move(outliers);
      return std::move(found.report);
    }
    const std::size_t view = *found.at_fault;
    run.warn(fmt::format(
        "view {} contradicts the surfaces of the others, which agree without it, and is left out: "
        "check that nothing moved while it was captured or covered the part, and that it is in "
        "focus",
        given.stations[view].label(view)));
    views.clear(view);
    outliers.push_back(view);
    std::erase_if(ties, [&](const PointTie& tie) { return tie.from == view || tie.to == view; });
    used.ties = ties;
  }
}

}  // namespace frangia

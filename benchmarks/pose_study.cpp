// Faults of the poses of views: which cause the registration names, and what remains of the error.
// `./run figures poses` runs it on six parts.
//
// usage: pose_study PART SEEDS [-v] [FAULT]
// Prints a JSON array with a row for each fault and size, and with -v what each seed found.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/registration/register_views.h"
#include "frangia/simulate/parts.h"

#include "pose_reach.h"
#include "study.h"
#include "support/pose_faults.h"

namespace frangia {
namespace {

using testing::FaultyScan;
using testing::Registered;
using testing::registered;

/// A fault of the study. Sizes are multiples of the noise of a pair of surfels.
struct StudyFault {
  const char* name;
  PoseCause right;
  std::function<void(FaultyScan&, double mm)> make;
  PoseCause larger = right;  ///< what it is where it is too large for a table's play
};

constexpr double kPairNoise_mm = 0.01;
constexpr double kArm_mm = 50.0;
constexpr double kAllowed = 1.3;  // times the error without the fault

void displace_some(FaultyScan& scan, std::initializer_list<std::size_t> views, double mm) {
  double way = 0.4;
  for (const std::size_t view : views) {
    scan.displace(view, mm * Eigen::Vector3d(std::cos(way), std::sin(way), 0.0));
    way += 2.2;  // each elsewhere
  }
}

std::vector<StudyFault> study_faults() {
  return {
      {"none", PoseCause::AsStated, [](FaultyScan&, double) {}},
      {"slide before view 5",
       PoseCause::PartMoved,
       [](FaultyScan& scan, double mm) {
         scan.slide(scan.views.size() / 2, Eigen::Vector3d(0.8 * mm, 0.6 * mm, 0.0));
       }},
      {"slides before views 3 and 6",
       PoseCause::PartMovedTwice,
       [](FaultyScan& scan, double mm) {
         scan.slide(2, Eigen::Vector3d(0.8 * mm, 0.6 * mm, 0.0));
         scan.slide(5, Eigen::Vector3d(-0.3 * mm, 0.95 * mm, 0.0));
       }},
      {"a step is lost before view 5",
       PoseCause::Turned,
       [](FaultyScan& scan, double mm) {
         for (std::size_t view = scan.views.size() / 2; view < scan.views.size(); ++view)
           scan.views[view].angle_rad -= mm / kArm_mm;
       }},
      {"the part creeps",
       PoseCause::PartDrift,
       [](FaultyScan& scan, double mm) {
         const auto last = static_cast<double>(scan.views.size() - 1);
         for (std::size_t view = 0; view < scan.views.size(); ++view)
           scan.displace(
               view, static_cast<double>(view) / last * Eigen::Vector3d(0.8 * mm, 0.6 * mm, 0.0));
       }},
      {"the table is knocked before view 5",
       PoseCause::TableMoved,
       [](FaultyScan& scan, double mm) {
         scan.knock(scan.views.size() / 2, mm / 500.0, mm, false, true);
       }},
      {"one view elsewhere",
       PoseCause::ViewMoved,
       [](FaultyScan& scan, double mm) {
         scan.displace(3, Eigen::Vector3d(0.8 * mm, 0.6 * mm, 0.0));
       }},
      {"one view turned",
       PoseCause::ViewMoved,
       [](FaultyScan& scan, double mm) {
         scan.displace(3,
                       Eigen::Isometry3d(Eigen::AngleAxisd(
                           mm / kArm_mm, Eigen::Vector3d(0.3, 0.2, 1.0).normalized())));
       }},
      {"views 2, 4 and 6 elsewhere",
       PoseCause::ViewsMoved,
       [](FaultyScan& scan, double mm) {
         for (const std::size_t view : {1U, 3U, 5U})
           scan.displace(view, Eigen::Vector3d(0.8 * mm, 0.6 * mm, 0.0));
       }},
      {"views 2 and 3 elsewhere",
       PoseCause::ViewsMoved,
       [](FaultyScan& scan, double mm) {
         displace_some(scan, {1, 2}, mm);
       }},
      {"views 2 and 5 elsewhere",
       PoseCause::ViewsMoved,
       [](FaultyScan& scan, double mm) {
         displace_some(scan, {1, 4}, mm);
       }},
      {"wobble",
       PoseCause::Wobble,
       [](FaultyScan& scan, double mm) { scan.wobble(0.5 * mm / kArm_mm, 0.5 * mm); },
       PoseCause::Unexplained},
      {"drift of the projector",
       PoseCause::RigDrift,
       [](FaultyScan& scan, double mm) { scan.drift_projector(mm / 500.0, mm); }},
      {"rig not as stated",
       PoseCause::Rig,
       [](FaultyScan& scan, double mm) { scan.drift_projector(mm / 500.0, mm, true); }},
      {"principal point",
       PoseCause::Rig,
       [](FaultyScan& scan, double mm) {
         // A point at the working distance moves by mm.
         for (testing::TrueView& view : scan.views) {
           CameraModel& camera = view.rig.reference().model;
           camera.principal_point_px +=
               mm / 500.0 * camera.focal_px.x() * Eigen::Vector2d(0.8, 0.6);
         }
       }},
      {"focal length",
       PoseCause::Rig,
       [](FaultyScan& scan, double mm) {
         for (testing::TrueView& view : scan.views)
           view.rig.reference().model.focal_px *= 1.0 + mm / 500.0;
       }},
      {"angles in proportion",
       PoseCause::AnglesScaled,
       [](FaultyScan& scan, double mm) { scan.scale_angles(1.0 + mm / kArm_mm / kTwoPi); }},
      {"axis elsewhere, stated as exact", PoseCause::Turntable, [](FaultyScan& scan, double mm) {
         scan.state_exact();
         scan.misalign(mm, mm / 500.0, 0.0);
       }}};
}

/// Scans of a part without a fault, by seed, and how their pairs scatter.
struct SoundScan {
  double error_mm = 0.0;
  PairNoise noise;
};

FaultyScan scan_of(int seed) {
  FaultyScan scan(8);
  scan.seed = static_cast<std::uint32_t>(seed);
  return scan;
}

/// What the registration makes of one fault of one size with several seeds, as a row of JSON.
std::string row(const StudyFault& fault,
                double size,
                const RayScene& part,
                const std::map<int, SoundScan>& sound,
                bool verbose) {
  int right = 0;
  int wrong = 0;
  int refused = 0;
  int silent = 0;
  int decidable = 0;
  int determined = 0;
  std::size_t left_out = 0;
  std::vector<double> ratios;
  std::vector<double> over_sigma;
  for (const auto& [seed, without] : sound) {
    FaultyScan scan = scan_of(seed);
    fault.make(scan, size * kPairNoise_mm);
    const PoseReach reach = reach_of(scan, part, fault.right, without.noise);
    const Registered out = registered(scan, part);
    const PoseExplanation& found = out.report.explanation;
    const bool named =
        found.best == fault.right || found.best == fault.larger ||
        std::find(found.alike.begin(), found.alike.end(), fault.right) != found.alike.end();
    right += named && found.decided ? 1 : 0;
    wrong += !named && found.decided && found.best != PoseCause::AsStated ? 1 : 0;
    const bool trusted = out.report.untrusted_reason().empty();
    if (verbose) {
      fmt::print(stderr,
                 "{}, {:g}, seed {}: {} ({}decided) {:.4f} mm for {:.4f}, bound {:.4f}, odds "
                 "{:.1f}, {:.2f} sigma, {:.2f} beyond; {} {} | {}\n",
                 fault.name,
                 size,
                 seed,
                 name_of(found.best),
                 found.decided ? "" : "not ",
                 out.error_mm,
                 without.error_mm,
                 reach.bound_mm,
                 reach.log_odds,
                 out.error.over_sigma,
                 out.error.share_beyond,
                 found.text,
                 out.report.untrusted_reason(),
                 out.report.fit_text());
    }
    refused += trusted ? 0 : 1;
    silent += trusted && out.error.share_beyond > 0.05 ? 1 : 0;
    decidable += reach.log_odds > kNamed ? 1 : 0;
    determined += reach.bound_mm < kAllowed * without.error_mm / 3.0 ? 1 : 0;
    left_out += out.report.outliers.size();
    ratios.push_back(out.error_mm / without.error_mm);
    over_sigma.push_back(out.error.over_sigma);
  }
  return fmt::format(
      R"({{"fault": "{}", "size": {}, "seeds": {}, "right": {}, "wrong": {}, "left_out": {}, "refused": {}, "silent": {}, "decidable": {}, "determined": {}, "ratios": [{:.3f}], "over_sigma": [{:.2f}]}})",
      fault.name,
      size,
      sound.size(),
      right,
      wrong,
      left_out,
      refused,
      silent,
      decidable,
      determined,
      fmt::join(ratios, ", "),
      fmt::join(over_sigma, ", "));
}

std::vector<std::string> rows_of(const StudyArguments& study) {
  const RayScene part(make_part(study.part));
  std::map<int, SoundScan> sound;
  for (int seed = study.first_seed; seed < study.first_seed + study.seeds; ++seed) {
    const FaultyScan scan = scan_of(seed);
    sound[seed] = {registered(scan, part).error_mm, round_at_truth(scan, part, {}).noise};
  }
  std::vector<std::string> rows;
  for (const StudyFault& fault : study_faults()) {
    if (std::string(fault.name).find(study.only) == std::string::npos) continue;
    const bool sized = fault.right != PoseCause::AsStated;
    for (const double size : sized ? std::vector{2.0, 10.0, 50.0} : std::vector{0.0})
      rows.push_back(row(fault, size, part, sound, study.verbose));
  }
  return rows;
}

}  // namespace
}  // namespace frangia

int main(int argc, char** argv) {
  return frangia::study_main(argc, argv, frangia::rows_of);
}

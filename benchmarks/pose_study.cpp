// Faults of the poses of views: which cause the registration names, and what remains of the error.
// `./run figures poses` runs it on four parts.
//
// usage: pose_study PART SEEDS [-v] [FAULT]
// Prints a JSON array with a row for each fault and size, and with -v what each seed found.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/registration/register_views.h"
#include "frangia/simulate/parts.h"

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
};

constexpr double kPairNoise_mm = 0.01;
constexpr double kArm_mm = 50.0;

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
       [](FaultyScan& scan, double mm) { scan.wobble(0.5 * mm / kArm_mm, 0.5 * mm); }},
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

/// What the registration makes of one fault of one size with several seeds, as a row of JSON.
std::string row(
    const StudyFault& fault, double size, const RayScene& part, int seeds, bool verbose) {
  int right = 0;
  int wrong = 0;
  int refused = 0;
  int silent = 0;
  std::size_t left_out = 0;
  double ratio = 0.0;
  std::vector<double> over_sigma;
  for (int seed = 1; seed <= seeds; ++seed) {
    FaultyScan scan(8);
    scan.seed = static_cast<std::uint32_t>(seed);
    const double without_mm = registered(scan, part).error_mm;
    fault.make(scan, size * kPairNoise_mm);
    const Registered out = registered(scan, part);
    const PoseExplanation& found = out.report.explanation;
    const bool named =
        found.best == fault.right ||
        std::find(found.alike.begin(), found.alike.end(), fault.right) != found.alike.end();
    right += named && found.decided ? 1 : 0;
    wrong += !named && found.decided && found.best != PoseCause::AsStated ? 1 : 0;
    const bool trusted = out.report.untrusted_reason().empty();
    if (verbose) {
      fmt::print(stderr,
                 "{}, {:g}, seed {}: {} ({}decided) {:.4f} mm for {:.4f}, {:.2f} sigma; {} {}\n",
                 fault.name,
                 size,
                 seed,
                 name_of(found.best),
                 found.decided ? "" : "not ",
                 out.error_mm,
                 without_mm,
                 out.error.over_sigma,
                 found.text,
                 out.report.untrusted_reason());
    }
    refused += trusted ? 0 : 1;
    silent += trusted && out.error.share_beyond > 0.05 ? 1 : 0;
    left_out += out.report.outliers.size();
    ratio += out.error_mm / without_mm / seeds;
    over_sigma.push_back(out.error.over_sigma);
  }
  std::sort(over_sigma.begin(), over_sigma.end());
  return fmt::format(
      R"({{"fault": "{}", "size": {}, "seeds": {}, "right": {}, "wrong": {}, "left_out": {}, "refused": {}, "silent": {}, "ratio": {:.3f}, "over_sigma": {:.2f}}})",
      fault.name,
      size,
      seeds,
      right,
      wrong,
      left_out,
      refused,
      silent,
      ratio,
      over_sigma[over_sigma.size() / 2]);
}

std::vector<std::string> rows_of(const StudyArguments& study) {
  const RayScene part(make_part(study.part));
  std::vector<std::string> rows;
  for (const StudyFault& fault : study_faults()) {
    if (std::string(fault.name).find(study.only) == std::string::npos) continue;
    const bool sized = fault.right != PoseCause::AsStated;
    for (const double size : sized ? std::vector{2.0, 10.0, 50.0} : std::vector{0.0})
      rows.push_back(row(fault, size, part, study.seeds, study.verbose));
  }
  return rows;
}

}  // namespace
}  // namespace frangia

int main(int argc, char** argv) {
  return frangia::study_main(argc, argv, frangia::rows_of);
}

// What is named of a fault of the poses, and what remains of its error. `./run figures poses` runs
// it; it takes minutes.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/registration/register_views.h"
#include "frangia/simulate/parts.h"

#include "support/pose_faults.h"

namespace frangia {
namespace {

using testing::FaultyScan;
using testing::registered;
using testing::Registered;

/// A fault, of a size in mm at the part.
struct StudyFault {
  const char* name;
  PoseCause right;
  std::function<void(FaultyScan&, double mm)> make;
};

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

TEST(PoseStudy, NamesTheFault) {
  const char* const part_name = std::getenv("FRANGIA_POSE_PART");
  const char* const seeds_text = std::getenv("FRANGIA_POSE_SEEDS");
  const char* const only = std::getenv("FRANGIA_POSE_FAULT");  // a part of a name
  const char* const views_text = std::getenv("FRANGIA_POSE_VIEWS");
  if (seeds_text == nullptr) GTEST_SKIP() << "FRANGIA_POSE_SEEDS is not set";
  const int seeds = std::atoi(seeds_text);
  const int views = views_text == nullptr ? 8 : std::atoi(views_text);
  const RayScene part(make_part(part_name == nullptr ? "bracket" : part_name));
  constexpr double kPairNoise_mm = 0.01;
  std::string json;
  int blamed = 0;
  for (const StudyFault& fault : study_faults()) {
    if (only != nullptr && std::string(fault.name).find(only) == std::string::npos) continue;
    for (const double size : {2.0, 10.0, 50.0}) {
      int right = 0;
      int wrong = 0;
      int refused = 0;
      int silent = 0;
      std::size_t left_out = 0;
      double ratio = 0.0;
      std::vector<double> over_sigma;
      for (int seed = 1; seed <= seeds; ++seed) {
        FaultyScan scan(views);
        scan.seed = static_cast<std::uint32_t>(seed);
        const double without_mm = registered(scan, part).error_mm;
        fault.make(scan, size * kPairNoise_mm);
        const Registered out = registered(scan, part);
        const PoseExplanation& found = out.report.explanation;
        const bool named =
            found.best == fault.right ||
            std::find(found.alike.begin(), found.alike.end(), fault.right) != found.alike.end();
        const bool trusted = out.report.untrusted_reason().empty();
        right += named && found.decided ? 1 : 0;
        wrong += !named && found.decided && found.best != PoseCause::AsStated ? 1 : 0;
        refused += trusted ? 0 : 1;
        silent += trusted && out.error.share_beyond > 0.05 ? 1 : 0;
        left_out += out.report.outliers.size();
        ratio += out.error_mm / without_mm / seeds;
        over_sigma.push_back(out.error.over_sigma);
        if (only != nullptr) {
          std::printf(
              "%s %g: contradiction %.4f, %.4f mm of %.4f, over sigma %.2f, beyond %.3f; %s [%s; "
              "odds %.1f, %.1f; decided %d] %s | %s\n",
              fault.name,
              size,
              out.report.contradiction,
              out.error_mm,
              without_mm,
              out.error.over_sigma,
              out.error.share_beyond,
              name_of(found.best),
              name_of(found.second),
              found.log_odds,
              found.log_odds_stated,
              found.decided ? 1 : 0,
              out.report.untrusted_reason().c_str(),
              fmt::format("{}", fmt::join(out.warnings, " | ")).c_str());
        }
      }
      std::sort(over_sigma.begin(), over_sigma.end());
      if (fault.right == PoseCause::AsStated) blamed += wrong;
      json += fmt::format(
          "{}{{\"fault\": \"{}\", \"size\": {}, \"seeds\": {}, \"right\": {}, \"wrong\": {}, "
          "\"left_out\": {}, \"refused\": {}, \"silent\": {}, \"ratio\": {:.3f}, "
          "\"over_sigma\": {:.2f}}}",
          json.empty() ? "" : ", ",
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
      if (fault.right == PoseCause::AsStated) break;
    }
  }
  std::printf("FIGURE [%s]\n", json.c_str());
  EXPECT_EQ(blamed, 0);
}

}  // namespace
}  // namespace frangia

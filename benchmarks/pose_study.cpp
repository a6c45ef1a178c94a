// Faults of the poses of views: which cause the registration names, and what remains of the error.
// `./run figures poses` runs it on four parts.
//
// usage: pose_study PART SEEDS
// Prints a JSON array with a row for each fault and size.
#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/registration/register_views.h"
#include "frangia/simulate/parts.h"

#include "support/pose_faults.h"

namespace frangia {
namespace {

using testing::FaultyScan;

/// A fault of the study. Sizes are multiples of the noise of a pair of surfels.
struct StudyFault {
  const char* name;
  PoseCause right;
  std::function<void(FaultyScan&, double mm)> make;
};

constexpr double kPairNoise_mm = 0.01;
constexpr double kArm_mm = 50.0;

std::vector<StudyFault> study_faults() {
  return {{"none", PoseCause::AsStated, [](FaultyScan&, double) {}},
          {"slide before view 5",
           PoseCause::PartMoved,
           [](FaultyScan& scan, double mm) {
             scan.slide(4, Eigen::Vector3d(0.8 * mm, 0.6 * mm, 0.0));
           }},
          {"one view elsewhere",
           PoseCause::ViewMoved,
           [](FaultyScan& scan, double mm) {
             scan.views[3].part =
                 Eigen::Translation3d(0.8 * mm, 0.6 * mm, 0.0) * Eigen::Isometry3d::Identity();
           }},
          {"wobble",
           PoseCause::Wobble,
           [](FaultyScan& scan, double mm) { scan.wobble(0.5 * mm / kArm_mm, 0.5 * mm); }},
          {"drift of the projector",
           PoseCause::RigDrift,
           [](FaultyScan& scan, double mm) { scan.drift_projector(mm / 500.0, mm); }},
          {"rig not as stated", PoseCause::Rig, [](FaultyScan& scan, double mm) {
             scan.drift_projector(mm / 500.0, mm, true);
           }}};
}

struct Registered {
  RegistrationReport report;
  double error_mm = 0.0;
};

Registered registered(const FaultyScan& scan, const RayScene& part) {
  ViewStore views = scan.take(part);
  Registered out;
  const auto stations = scan.stations();
  out.report = register_views(
      views, scan.stated.reference().model, scan.given(stations), RegisterOptions{}, Run{});
  out.error_mm = testing::surface_error_mm(scan, part, views);
  return out;
}

/// What the registration makes of one fault of one size with several seeds, as a row of JSON.
std::string row(const StudyFault& fault, double size, const RayScene& part, int seeds) {
  int right = 0;
  int wrong = 0;
  std::size_t left_out = 0;
  double ratio = 0.0;
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
    left_out += out.report.outliers.size();
    ratio += out.error_mm / without_mm / seeds;
  }
  return fmt::format(
      R"({{"fault": "{}", "size": {}, "seeds": {}, "right": {}, "wrong": {}, "left_out": {}, "ratio": {:.3f}}})",
      fault.name,
      size,
      seeds,
      right,
      wrong,
      left_out,
      ratio);
}

void run(const std::vector<std::string_view>& arguments) {
  int seeds = 0;
  if (arguments.size() == 2)
    std::from_chars(arguments[1].data(), arguments[1].data() + arguments[1].size(), seeds);
  if (seeds < 1) throw Error(ErrorKind::Input, "usage: pose_study PART SEEDS");
  const RayScene part(make_part(std::string(arguments[0])));
  std::vector<std::string> rows;
  for (const StudyFault& fault : study_faults()) {
    const bool sized = fault.right != PoseCause::AsStated;
    for (const double size : sized ? std::vector{2.0, 10.0, 50.0} : std::vector{0.0})
      rows.push_back(row(fault, size, part, seeds));
  }
  fmt::print("[{}]\n", fmt::join(rows, ",\n "));
}

}  // namespace
}  // namespace frangia

int main(int argc, char** argv) {
  try {
    frangia::run({argv + 1, argv + argc});
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    fmt::print(stderr, "pose_study: {}\n", error.what());
    return EXIT_FAILURE;
  }
}

// Parts that look alike from several sides, in several setups: whether the setups are joined as
// they were, and what remains of the error.
//
// usage: setup_study PART SEEDS [-v]
// Prints a JSON array with a row for each way to scan the part.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/simulate/parts.h"

#include "study.h"
#include "support/alike_parts.h"
#include "support/scan_in_setups.h"

namespace frangia {
namespace {

using testing::JoinedScan;
using testing::ScanInSetups;

Mesh part_of(const std::string& name) {
  using testing::boss;
  using testing::together;
  using testing::turned;
  using testing::upright_box;
  const std::map<std::string, std::function<Mesh()>> made{
      {"cone",
       [] {
         return turned({{30.0, 0.0}, {30.0, 5.0}, {10.0, 70.0}, {0.0, 70.0}});
       }},
      {"cup",
       [] {
         return turned({{20.0, 0.0}, {28.0, 60.0}, {25.0, 60.0}, {17.5, 4.0}, {0.0, 4.0}});
       }},
      {"cup with a handle",
       [] {
         return together(turned({{20.0, 0.0}, {28.0, 60.0}, {25.0, 60.0}, {17.5, 4.0}, {0.0, 4.0}}),
                         boss(23.0, 0.0, 30.0, 5.0, 12.0));
       }},
      {"box", [] { return upright_box(50.0, 50.0, 50.0); }},
      {"box with a boss",
       [] { return together(upright_box(50.0, 50.0, 60.0), boss(25.0, 8.0, 22.0, 5.0, 3.0)); }},
      {"cylinder", [] {
         return turned({{18.0, 0.0}, {18.0, 80.0}, {0.0, 80.0}});
       }}};
  const auto own = made.find(name);
  return own == made.end() ? make_part(name) : own->second();
}

/// How the part is scanned.
struct Way {
  const char* name;
  std::vector<double> tilts_deg;
  bool stated = false;
};

/// Prints the result of one seed as text.
void print_seed(const Way& way,
                int seed,
                const ScanInSetups& scan,
                const JoinedScan& out,
                const Eigen::Vector3d& middle) {
  fmt::print(stderr,
             "{} seed {}: {} views, RMS {:.4f}, 99 % {:.4f} mm, {:.1f} sigma\n",
             way.name,
             seed,
             out.joined.measured.stations.size(),
             out.error.rms_mm,
             out.error.largest_mm,
             out.error.largest_over_sigma);
  for (std::size_t i = 0; i < out.joined.joins.size(); ++i) {
    const Eigen::Isometry3d off = scan.part_poses[i].inverse() * out.joined.joins[i].part_pose;
    const Eigen::AngleAxisd turn(off.rotation());
    fmt::print(stderr,
               "    setup {}: joined {}, turned by {:.3f} degrees, middle {:.3f} mm away\n",
               i,
               out.joined.joins[i].joined,
               deg_from_rad(turn.angle()),
               (off * middle - middle).norm());
  }
  for (const std::string& warning : out.warnings)
    fmt::print(stderr, "    {}\n", warning);
  for (const std::string& note : out.notes)
    fmt::print(stderr, "    ({})\n", note);
  if (out.joined.registration) fmt::print(stderr, "    {}\n", out.joined.registration->text());
}

/// One way to scan the part with several seeds, as a row of JSON.
std::string row(const Way& way,
                const Mesh& mesh,
                const RayScene& part,
                const StudyArguments& study) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : mesh.vertices_mm)
    box.extend(vertex);
  const Eigen::Vector3d middle = box.center().cast<double>();
  int left_out = 0;
  int refused = 0;
  int silent = 0;
  int warned = 0;
  std::vector<double> largest;
  std::vector<double> over;
  std::vector<double> over_sigma;
  for (int seed = 1; seed <= study.seeds; ++seed) {
    constexpr int kViews = 8;
    ScanInSetups scan(kViews, 2);
    scan.all.seed = static_cast<std::uint32_t>(seed);
    for (std::size_t i = 0; i < way.tilts_deg.size(); ++i) {
      const double turn = kTwoPi * uniform_from(hash(static_cast<std::uint64_t>(seed), i + 1));
      scan.add_setup(pose_on_table(mesh, rad_from_deg(way.tilts_deg[i]), turn));
    }
    RegisterSetupsOptions options;
    if (way.stated)
      options.part_poses =
          scan.stated_poses(rad_from_deg(2.0), 1.0, static_cast<std::uint32_t>(seed), middle);
    const JoinedScan out = joined(scan, part, options);
    const bool all = out.joined.measured.stations.size() == scan.all.views.size();
    const bool trusted =
        !out.joined.registration || out.joined.registration->untrusted_reason().empty();
    left_out += all ? 0 : 1;
    refused += trusted ? 0 : 1;
    warned += out.warnings.empty() ? 0 : 1;
    silent += trusted && all && out.warnings.empty() && out.error.largest_over_sigma > 4.0 ? 1 : 0;
    largest.push_back(out.error.largest_mm);
    over.push_back(out.error.largest_over_sigma);
    over_sigma.push_back(out.error.over_sigma);
    if (study.verbose) print_seed(way, seed, scan, out, middle);
  }
  for (auto* values : {&largest, &over, &over_sigma})
    std::sort(values->begin(), values->end());
  return fmt::format(
      R"({{"way": "{}", "seeds": {}, "left_out": {}, "refused": {}, "warned": {}, "silent": {}, "largest_mm": {:.4f}, "worst_mm": {:.4f}, "largest_over_sigma": {:.2f}, "over_sigma": {:.2f}}})",
      way.name,
      study.seeds,
      left_out,
      refused,
      warned,
      silent,
      largest[largest.size() / 2],
      largest.back(),
      over.back(),
      over_sigma[over_sigma.size() / 2]);
}

std::vector<std::string> rows_of(const StudyArguments& study) {
  const Mesh mesh = part_of(study.part);
  const RayScene part(mesh);
  std::vector<std::string> rows;
  for (const Way& way : {Way{"turned over, pose stated", {180.0}, true},
                         Way{"turned over", {180.0}},
                         Way{"laid down, pose stated", {90.0}, true},
                         Way{"laid down", {90.0}},
                         Way{"laid down and turned over, poses stated", {90.0, 180.0}, true},
                         Way{"laid down and turned over", {90.0, 180.0}}})
    rows.push_back(row(way, mesh, part, study));
  return rows;
}

}  // namespace
}  // namespace frangia

int main(int argc, char** argv) {
  return frangia::study_main(argc, argv, frangia::rows_of);
}

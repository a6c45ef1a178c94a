#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/reconstruct/reconstruct.h"

#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

/// A square of the object frame of a view, which stands still in the rig frame: behind the axis as
/// the camera sees it, and along the axis.
void add_wall(Mesh& mesh, const Rig& rig, double angle_rad, double behind_mm) {
  constexpr double kHalf_mm = 160.0;
  const Eigen::Vector3d axis = rig.turntable->axis.normalized();
  const Eigen::Vector3d& on_axis = rig.turntable->point_mm;
  const Eigen::Vector3d away = (on_axis - axis * axis.dot(on_axis)).normalized();
  const Eigen::Vector3d across = axis.cross(away);
  const Eigen::Isometry3d object_from_rig = rig.rig_from_object(angle_rad).inverse();
  const auto first = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  for (const auto& [u, v] : {std::pair(-1.0, -1.0), {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
    const Eigen::Vector3d corner = on_axis + behind_mm * away + kHalf_mm * (u * across + v * axis);
    mesh.vertices_mm.emplace_back((object_from_rig * corner).cast<float>());
  }
  // Both sides, so that one of them faces the camera.
  for (const auto& [a, b, c] :
       {std::array<std::uint32_t, 3>{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}})
    mesh.triangles.push_back({first + a, first + b, first + c});
}

/// A scan of a part before a wall that does not turn: each view is of another mesh.
Scan scan_before_wall(const std::filesystem::path& folder, const std::string& part, int views) {
  Scan all;
  all.folder = folder;
  all.name = part;
  all.rig = testing::small_rig("digital", 4);
  all.patterns = default_patterns(all.rig);
  for (int i = 0; i < views; ++i) {
    Scan one = all;
    const std::string name = std::to_string(i);
    one.folder = folder / name;
    one.views = {{kTwoPi * i / views, "view"}};
    Mesh mesh = make_part(part);
    add_wall(mesh, all.rig, one.views.front().angle_rad, 120.0);
    one = simulate_scan(mesh, one, {.samples_per_px = 4});
    all.views.push_back(one.views.front());
    all.views.back().folder = std::filesystem::path(name) / "view";
  }
  return all;
}

float reach_of(const Mesh& mesh) {
  float widest = 0.0F;
  for (const Eigen::Vector3f& vertex : mesh.vertices_mm)
    widest = std::max(widest, vertex.head<2>().norm());
  return widest;
}

TEST(Reconstruct, LeavesOutAWallThatDoesNotTurn) {
  const testing::TemporaryFolder folder;
  const Scan scan = scan_before_wall(folder.path(), "bracket", 6);
  std::vector<std::string> notes;
  frangia::Run run;
  run.on_note = [&](const std::string& sentence) { notes.push_back(sentence); };
  const Reconstruction result = reconstruct(scan, {}, run);
  EXPECT_EQ(result.untrusted_reason, "");
  EXPECT_NEAR(result.background.from_axis_mm, 120.0, 2.0);
  EXPECT_GT(result.background.points, result.points);
  EXPECT_LT(reach_of(result.mesh), 60.0F);
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.find("background, 120 mm from the axis") != std::string::npos;
  }));
  ReconstructOptions keep;
  keep.keep_background = true;
  const Reconstruction kept = reconstruct(scan, keep);
  EXPECT_EQ(kept.background.points, 0U);
  EXPECT_NE(kept.untrusted_reason, "");
}

}  // namespace
}  // namespace frangia

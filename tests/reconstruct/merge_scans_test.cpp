#include "frangia/reconstruct/merge_scans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/inspect/surface_error.h"
#include "frangia/simulate/parts.h"

namespace frangia {
namespace {

Eigen::Isometry3d turned(double angle_rad, const Eigen::Vector3d& axis, const Eigen::Vector3d& by) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
  pose.translation() = by;
  return pose;
}

/// What a scanner that looks along -z sees of a part that was turned about z: a grid of points with
/// noise, joined to triangles, in the scanner's own frame.
RangeScan scan_of(
    const RayScene& part, double turn_rad, unsigned seed, bool joined, double above_rad = 0.0) {
  constexpr int kSide = 160;
  constexpr int kHalf = kSide / 2;
  constexpr double kStep_mm = 0.7;
  constexpr double kNoise_mm = 0.02;
  // The scanner's y is the part's z: it looks at the part from the side.
  Eigen::Isometry3d scan_from_part = turned(-M_PI / 2.0, Eigen::Vector3d::UnitX(), {0, -35, 0});
  scan_from_part = turned(above_rad, Eigen::Vector3d::UnitX(), {0, 0, 0}) * scan_from_part *
                   turned(turn_rad, Eigen::Vector3d::UnitZ(), {0, 0, 0});
  const Eigen::Isometry3d part_from_scan = scan_from_part.inverse();
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, kNoise_mm);
  RangeScan scan;
  scan.world_from_scan = part_from_scan;
  std::vector<std::int64_t> number(std::size_t{kSide} * kSide, -1);
  for (int i = 0; i < kSide * kSide; ++i) {
    const int row = i / kSide;
    const Eigen::Vector3d from((i % kSide - kHalf) * kStep_mm, (row - kHalf) * kStep_mm, 300.0);
    const auto hit =
        part.first_hit(part_from_scan * from, part_from_scan.linear() * -Eigen::Vector3d::UnitZ());
    if (!hit) continue;
    number[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(scan.mesh.vertices_mm.size());
    scan.mesh.vertices_mm.emplace_back(
        Eigen::Vector3d(from.x(), from.y(), from.z() - hit->distance + noise(random))
            .cast<float>());
  }
  for (int i = 0; joined && i + kSide + 1 < kSide * kSide; ++i) {
    const auto at = [&](int j) { return number[static_cast<std::size_t>(j)]; };
    const auto add = [&](std::int64_t a, std::int64_t b, std::int64_t c) {
      if (a < 0 || b < 0 || c < 0 || i % kSide + 1 == kSide) return;
      const auto z = [&](std::int64_t k) {
        return scan.mesh.vertices_mm[static_cast<std::size_t>(k)].z();
      };
      if (std::max({z(a), z(b), z(c)}) - std::min({z(a), z(b), z(c)}) > 3.0F) return;
      scan.mesh.triangles.push_back({static_cast<std::uint32_t>(a),
                                     static_cast<std::uint32_t>(b),
                                     static_cast<std::uint32_t>(c)});
    };
    add(at(i), at(i + 1), at(i + kSide + 1));
    add(at(i), at(i + kSide + 1), at(i + kSide));
  }
  return scan;
}

std::vector<RangeScan> scans_of(const RayScene& part, bool joined) {
  std::vector<RangeScan> scans;
  for (unsigned i = 0; i < 6; ++i)
    scans.push_back(scan_of(part, i * M_PI / 3.0, i + 1, joined));
  return scans;
}

/// The tests run in one process, and share the part, its scans and what they give when merged.
class MergeScans : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { static_cast<void>(part()); }
  static const RayScene& part() {
    static const RayScene kPart(make_part("bust"));
    return kPart;
  }
  /// Scans whose poses are true.
  static const std::vector<RangeScan>& scans(bool joined = true) {
    static const std::vector<RangeScan> kJoined = scans_of(part(), true);
    static const std::vector<RangeScan> kPoints = scans_of(part(), false);
    return joined ? kJoined : kPoints;
  }
  static const MergedScans& merged(bool joined) {
    static const MergedScans kJoined = merge_scans(scans(true), {.register_poses = false});
    static const MergedScans kPoints = merge_scans(scans(false), {.register_poses = false});
    return joined ? kJoined : kPoints;
  }
};

TEST_F(MergeScans, MakesOneSurfaceOfScansThatFit) {
  ASSERT_FALSE(merged(true).mesh.empty());
  EXPECT_LT(surface_error(merged(true).mesh, part()).rms_mm, 0.06);
}

TEST_F(MergeScans, PutsPosesRightThatAreOff) {
  const std::vector<RangeScan>& truth = MergeScans::scans();
  std::vector<RangeScan> scans = truth;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const Eigen::Vector3d axis(any(random), any(random), any(random));
    const Eigen::Vector3d by(any(random), any(random), any(random));
    scans[i].world_from_scan = turned(0.01, axis, by) * scans[i].world_from_scan;
  }
  const double off_mm =
      surface_error(merge_scans(scans, {.register_poses = false}).mesh, part()).rms_mm;
  const MergedScans merged = merge_scans(scans);
  EXPECT_GT(off_mm, 0.2);
  EXPECT_LT(surface_error(merged.mesh, part()).rms_mm, 0.07);
  ASSERT_TRUE(merged.registration.has_value());
  EXPECT_LT(merged.registration->rms_after_mm, 0.3 * merged.registration->rms_before_mm);
  // The refined poses agree with the true ones: the first is held.
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Eigen::Vector3d corner(20.0, -20.0, 10.0);
    EXPECT_LT((merged.scans[i].world_from_scan * corner - truth[i].world_from_scan * corner).norm(),
              0.2)
        << i;
  }
}

TEST_F(MergeScans, CountsDroppedPointsByTheReason) {
  // A plate of 41 x 41 points, 1 mm apart, with the back of the plate 10 mm below, seen from
  // behind.
  RangeScan scan;
  constexpr std::uint32_t kSide = 41;
  const auto add_plate = [&](float z, bool faces_up) {
    const auto first = static_cast<std::uint32_t>(scan.mesh.vertices_mm.size());
    for (std::uint32_t i = 0; i < kSide * kSide; ++i)
      scan.mesh.vertices_mm.emplace_back(
          static_cast<float>(i % kSide), static_cast<float>(i / kSide), z);
    for (std::uint32_t row = 0; row + 1 < kSide; ++row) {
      for (std::uint32_t column = 0; column + 1 < kSide; ++column) {
        const std::uint32_t a = first + row * kSide + column;
        const std::uint32_t b = a + 1;
        const std::uint32_t c = b + kSide;
        const std::uint32_t d = a + kSide;
        scan.mesh.triangles.push_back(faces_up ? std::array{a, b, c} : std::array{a, c, b});
        scan.mesh.triangles.push_back(faces_up ? std::array{a, c, d} : std::array{a, d, c});
      }
    }
  };
  add_plate(0.0F, true);
  add_plate(0.001F, true);                 // as dense again: the same pixels
  add_plate(-10.0F, false);                // fewer of them would leave the mean normal up
  for (std::uint32_t i = 0; i < 200; ++i)  // half of the back
    scan.mesh.triangles.pop_back();
  scan.mesh.vertices_mm.emplace_back(5.0F, 5.0F, 3.0F);  // in no triangle
  const MergedScans merged = merge_scans({scan}, {.register_poses = false});
  const MergedScan& only = merged.scans.front();
  EXPECT_EQ(only.points_read, 3U * kSide * kSide + 1U);
  EXPECT_GE(only.dropped.unconnected, 1U);
  EXPECT_NEAR(static_cast<double>(only.dropped.hidden), kSide * kSide, 200.0);
  EXPECT_NEAR(static_cast<double>(only.dropped.too_dense), kSide * kSide, 200.0);
  EXPECT_NEAR(only.size_mm, std::hypot(40.0, 40.0, 10.0), 4.0);
}

/// Scans from all sides and a little above, each in its own unknown frame.
std::vector<RangeScan> lost_scans(const RayScene& part, unsigned count) {
  std::vector<RangeScan> scans;
  for (unsigned i = 0; i < count; ++i) {
    RangeScan scan = scan_of(part, 2.0 * M_PI * i / count, i + 1, true, 0.6);
    const Eigen::Isometry3d anyhow = turned(1.0 + i, {1.0, 0.3 * i, -0.5}, {10.0 * i, 30.0, -5.0});
    for (Eigen::Vector3f& point : scan.mesh.vertices_mm)
      point = (anyhow * point.cast<double>()).cast<float>();
    scan.world_from_scan = Eigen::Isometry3d::Identity();
    scan.path = "scan-" + std::to_string(i) + ".ply";
    scans.push_back(std::move(scan));
  }
  return scans;
}

TEST_F(MergeScans, FindsUnknownPoses) {
  const MergedScans merged = merge_scans(lost_scans(part(), 6));
  ASSERT_TRUE(merged.found_poses.has_value());
  EXPECT_TRUE(merged.found_poses->left_out.empty());
  // The mesh is in the frame of the first scan: bring it back into the part's.
  ASSERT_EQ(merged.found_poses->reference, 0U);
  const Eigen::Isometry3d anyhow = turned(1.0, {1.0, 0.0, -0.5}, {0.0, 30.0, -5.0});
  const Eigen::Isometry3d part_from_mesh =
      scan_of(part(), 0.0, 1, true, 0.6).world_from_scan * anyhow.inverse();
  Mesh mesh = merged.mesh;
  for (Eigen::Vector3f& point : mesh.vertices_mm)
    point = (part_from_mesh * point.cast<double>()).cast<float>();
  EXPECT_LT(surface_error(mesh, part()).rms_mm, 0.07);
}

TEST_F(MergeScans, TakesPointsWithoutTriangles) {
  ASSERT_FALSE(merged(false).mesh.empty());
  EXPECT_LT(surface_error(merged(false).mesh, part()).p95_mm, 0.4);
}

bool has_no_sigma(const Mesh& mesh) {
  return !mesh.sigma_mm.empty() && std::all_of(mesh.sigma_mm.begin(),
                                               mesh.sigma_mm.end(),
                                               [](float sigma) { return std::isnan(sigma); });
}

TEST_F(MergeScans, TrustsScansThatFit) {
  for (const bool joined : {true, false}) {
    const MergedScans& merged = MergeScans::merged(joined);
    EXPECT_EQ(merged.untrusted_reason, "") << joined;
    EXPECT_LT(merged.contradiction, 0.04) << joined;
    EXPECT_FALSE(has_no_sigma(merged.mesh)) << joined;
    ASSERT_EQ(merged.scans.size(), 6U);
    std::size_t points = 0;
    for (const MergedScan& scan : merged.scans)
      points += scan.points;
    EXPECT_EQ(points, merged.points);
    EXPECT_EQ(merged.scans[2].name, "scan 2");
    if (joined) {
      EXPECT_NEAR(merged.scans[2].noise_mm, 0.02, 0.01);  // that of the scanned grid
    }
  }
}

/// Expects that the result is marked as not trustworthy and that no note claims agreement.
void expect_untrusted(const std::vector<RangeScan>& scans, const MergeScansOptions& options = {}) {
  std::vector<std::string> notes;
  frangia::Run run;
  run.on_note = [&](const std::string& sentence) { notes.push_back(sentence); };
  const MergedScans merged = merge_scans(scans, options, run);
  EXPECT_NE(merged.untrusted_reason.find("the scans contradict each other"), std::string::npos)
      << merged.untrusted_reason << merged.contradiction;
  EXPECT_TRUE(has_no_sigma(merged.mesh));
  for (const std::string& note : notes)
    EXPECT_EQ(note.find("agree"), std::string::npos) << note;
}

TEST_F(MergeScans, DoesNotTrustScansOfDifferentScale) {
  std::vector<RangeScan> scans = MergeScans::scans();
  for (std::size_t i = 1; i < scans.size(); i += 2) {
    for (Eigen::Vector3f& vertex : scans[i].mesh.vertices_mm)
      vertex *= 1.05F;
  }
  expect_untrusted(scans);
}

TEST_F(MergeScans, DoesNotTrustScansOfAPartThatChanged) {
  const RayScene other(make_part("bracket"));
  std::vector<RangeScan> scans = MergeScans::scans();
  scans[2] = scan_of(other, 2.0 * M_PI / 3.0, 3, true);
  expect_untrusted(scans, {.poses = ScanPoses::Given});
}

TEST_F(MergeScans, DoesNotTrustUnregisteredScansWithPosesThatAreOff) {
  std::vector<RangeScan> scans = MergeScans::scans();
  scans[3].world_from_scan.pretranslate(Eigen::Vector3d(0.8, -0.8, 0.4));
  expect_untrusted(scans, {.register_poses = false});
}

TEST_F(MergeScans, RefusesAScanWithoutASurface) {
  RangeScan empty;
  empty.path = "empty.ply";
  EXPECT_THROW(static_cast<void>(merge_scans({empty})), Error);
}

/// A grid of `side` x `side` points, 1 mm apart, with or without triangles.
RangeScan small_scan(std::uint32_t side, bool joined) {
  RangeScan scan;
  scan.path = "small.ply";
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      scan.mesh.vertices_mm.emplace_back(
          static_cast<float>(x), static_cast<float>(y), 0.01F * static_cast<float>(x * y));
    }
  }
  for (std::uint32_t i = 0; joined && i + side < side * side; ++i) {
    if (i % side + 1 == side) continue;
    scan.mesh.triangles.push_back({i, i + 1, i + side});
    scan.mesh.triangles.push_back({i + 1, i + side + 1, i + side});
  }
  return scan;
}

/// Merges, which gives a mesh or an Error.
std::string fault_of(const std::vector<RangeScan>& scans) {
  try {
    EXPECT_FALSE(merge_scans(scans).mesh.empty());
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST_F(MergeScans, RefusesScansOfFewPointsInOneSentence) {
  for (const bool joined : {false, true})
    EXPECT_NE(fault_of({small_scan(3, joined), small_scan(3, joined)}), "");
}

TEST_F(MergeScans, RefusesAPoseThatIsTooFarForItsCoordinates) {
  for (const double far_mm : {1e300, 1e8}) {
    RangeScan far = small_scan(12, true);
    far.path = "far.ply";
    far.world_from_scan.translation().x() = far_mm;
    EXPECT_NE(fault_of({small_scan(12, true), far}).find("far.ply: its pose"), std::string::npos);
  }
}

TEST_F(MergeScans, RefusesPointsThatCoincide) {
  RangeScan scan = small_scan(3, false);
  for (auto& point : scan.mesh.vertices_mm)
    point.setConstant(1.0F);
  EXPECT_NE(fault_of({scan}).find("small.ply: holds no surface"), std::string::npos);
}

TEST_F(MergeScans, TakesAPointThatLiesFarAway) {
  for (const bool joined : {false, true}) {
    for (const float far_mm : {60'000.0F, 1e15F, 1e30F}) {
      RangeScan scan = small_scan(40, joined);
      scan.mesh.vertices_mm.back().x() = far_mm;
      static_cast<void>(fault_of({scan, small_scan(40, joined)}));
    }
  }
}

}  // namespace
}  // namespace frangia

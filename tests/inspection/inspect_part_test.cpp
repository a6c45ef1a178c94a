// One call inspects a part: what it aligns, judges, measures and refuses.
#include "frangia/inspection/inspect_part.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <stop_token>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/files/write_mesh.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/simulate/rig_presets.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

using testing::error_of;

double turn_of(const AlignmentPose& pose) {
  return Eigen::AngleAxisd(pose.reference_from_mesh.linear()).angle();
}

/// A brick with three different sides fits itself in four poses.
Mesh brick() {
  return testing::box({0.0, 0.0, 0.0}, {20.0, 12.0, 7.0});
}

InspectionPlan best_fit_plan(std::size_t start) {
  InspectionPlan plan;
  plan.align = "best-fit";
  plan.start = start;
  return plan;
}

/// A ball of 40 mm, measured 0.02 mm too large.
Mesh large_ball() {
  Mesh ball = testing::sphere({5, 0, 0}, 20.01, 40);
  ball.sigma_mm.assign(ball.vertices_mm.size(), 1e-4F);
  return ball;
}

InspectionPlan ball_plan(double tolerance_mm) {
  InspectionPlan plan;
  PlannedFeature ball;
  ball.name = "ball";
  ball.kind = ShapeKind::Sphere;
  ball.near_mm = {5, 0, 0};
  ball.diameter_mm = 40.0;
  ball.tolerance_mm = ToleranceLimits{-tolerance_mm, tolerance_mm};
  plan.features = {ball};
  return plan;
}

TEST(InspectPart, ListsThePosesThatFitAlikeAndTakesTheOneThatIsAskedFor) {
  const InspectionReference reference = reference_of_mesh(brick());
  const Inspection first = inspect_part(brick(), &reference, best_fit_plan(1));
  ASSERT_TRUE(first.alignment);
  const auto& poses = first.alignment->alternatives;
  ASSERT_EQ(poses.size(), 4U);
  EXPECT_EQ(turn_of(first.alignment->pose), turn_of(poses[0]));
  std::vector<double> turns;
  for (const AlignmentPose& pose : poses)
    turns.push_back(turn_of(pose));
  // The pose in which it stands, and three half turns.
  std::sort(turns.begin(), turns.end());
  EXPECT_NEAR(turns[0], 0.0, 1e-3);
  EXPECT_NEAR(turns[1], rad_from_deg(180.0), 1e-3);
  const Inspection third = inspect_part(brick(), &reference, best_fit_plan(3));
  EXPECT_EQ(turn_of(third.alignment->pose), turn_of(poses[2]));
  EXPECT_LT(std::abs(third.surface->summary.max_mm), 0.01);
}

Eigen::Isometry3d far_away() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -2, 0.5).normalized()).matrix();
  pose.translation() = Eigen::Vector3d(120, -40, 7);
  return pose;
}

/// Corners of the brick, each clicked half a millimetre beside its place on the mesh.
std::vector<PointPair> clicked_corners(const Eigen::Isometry3d& mesh_from_reference) {
  std::vector<PointPair> pairs;
  for (const Eigen::Vector3d& corner :
       std::vector<Eigen::Vector3d>{{0, 0, 0}, {20, 0, 0}, {0, 12, 7}, {20, 12, 0}})
    pairs.push_back({mesh_from_reference * (corner + Eigen::Vector3d(0.3, -0.4, 0.1) *
                                                         (pairs.size() % 2 == 0 ? 1.0 : -1.0)),
                     corner});
  return pairs;
}

TEST(InspectPart, BeginsTheFitAtPairsOfPointsWhichChooseAmongPosesThatFitAlike) {
  const InspectionReference reference = reference_of_mesh(brick());
  const Mesh mesh = transform_mesh(brick(), far_away());
  InspectionPlan plan = best_fit_plan(0);  // without the points: four poses, and none chosen
  EXPECT_NE(
      error_of([&] { static_cast<void>(inspect_part(mesh, &reference, plan)); }).find("4 poses"),
      std::string::npos);
  plan.points = clicked_corners(far_away());
  const Inspection found = inspect_part(mesh, &reference, plan);
  EXPECT_EQ(found.alignment->alternatives.size(), 1U);
  EXPECT_TRUE((found.alignment->pose.reference_from_mesh * far_away())
                  .isApprox(Eigen::Isometry3d::Identity(), 1e-4));
  ASSERT_EQ(found.points_mm.size(), 4U);
  for (const double distance : found.points_mm)
    EXPECT_NEAR(distance, std::sqrt(0.26), 1e-3);
  // Corners of another half turn choose the pose that they name.
  Eigen::Isometry3d half_turn = Eigen::Isometry3d::Identity();
  half_turn.linear() = Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitZ()).matrix();
  half_turn.translation() = Eigen::Vector3d(20, 12, 0);
  plan.points = clicked_corners(far_away() * half_turn);
  const Inspection turned = inspect_part(mesh, &reference, plan);
  EXPECT_TRUE((turned.alignment->pose.reference_from_mesh * far_away() * half_turn)
                  .isApprox(Eigen::Isometry3d::Identity(), 1e-4));
}

TEST(InspectPart, PutsThePartOnPairsOfPointsAlone) {
  const InspectionReference reference = reference_of_mesh(brick());
  InspectionPlan plan;
  plan.align = "points";
  plan.points = clicked_corners(far_away());
  const Inspection found = inspect_part(transform_mesh(brick(), far_away()), &reference, plan);
  const PointAlignment wanted = align_to_points(plan.points);
  EXPECT_EQ(found.alignment->pose.reference_from_mesh.matrix(),
            wanted.reference_from_mesh.matrix());
  EXPECT_EQ(found.points_mm, wanted.distances_mm);
  EXPECT_GT(found.alignment->pose.uncertainty.along({20, 12, 7}, Eigen::Vector3d::UnitZ()), 0.1);
  plan.align = "best-fit";  // points that name places of another part
  for (PointPair& pair : plan.points)
    pair.scan_mm = far_away() * (pair.reference_mm + Eigen::Vector3d(0, 0, 40));
  EXPECT_NE(
      error_of([&] {
        static_cast<void>(inspect_part(transform_mesh(brick(), far_away()), &reference, plan));
      }).find("near the given points"),
      std::string::npos);
}

TEST(InspectPart, SaysNothingOfAnAlignmentThatThePlanDoesNotMention) {
  const InspectionReference reference = reference_of_mesh(brick());
  EXPECT_FALSE(inspect_part(brick(), &reference, {}).alignment);
  InspectionPlan as_it_stands;
  as_it_stands.align = "none";
  const Inspection found = inspect_part(brick(), &reference, as_it_stands);
  ASSERT_TRUE(found.alignment);
  EXPECT_TRUE(found.alignment->alternatives.empty());
  EXPECT_GT(found.alignment->pose.overlap, 0.99);
}

TEST(InspectPart, WarnsOfAnotherPartWhosePoseNothingSearched) {
  const InspectionReference reference = reference_of_mesh(brick());
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  InspectionPlan as_it_stands;
  as_it_stands.align = "none";
  static_cast<void>(align_part(brick(), reference, as_it_stands, "brick.ply", run));
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  const Mesh other = testing::box({2.0, 2.0, 2.0}, {16.0, 8.0, 4.0});
  static_cast<void>(align_part(other, reference, as_it_stands, "other.ply", run));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0],
            "other.ply: 0 % of it lies on the reference; it is another part, or `align` best-fit "
            "must find its pose");
}

/// For the report, which is written where nobody saw the messages of the inspection.
TEST(InspectPart, KeepsItsWarnings) {
  InspectionPlan plan = ball_plan(0.1);
  plan.features[0].near_mm = {5, 0, 50};
  plan.features[0].kind = ShapeKind::Cylinder;
  std::vector<std::string> given;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { given.push_back(sentence); };
  const Inspection found = inspect_part(large_ball(), nullptr, plan, {}, run);
  ASSERT_FALSE(given.empty());
  EXPECT_EQ(found.warnings, given);
  EXPECT_EQ(inspect_part(large_ball(), nullptr, plan).warnings, given);
  EXPECT_TRUE(inspect_part(large_ball(), nullptr, ball_plan(0.1)).warnings.empty());
}

TEST(InspectPart, RefusesAnAlignmentWithoutAReference) {
  const auto refused =
      error_of([&] { static_cast<void>(inspect_part(brick(), nullptr, best_fit_plan(1))); });
  EXPECT_EQ(refused,
            "the plan: `align` is best-fit, but there is no reference to align the mesh to; give "
            "one, or leave out `align`");
}

TEST(InspectPart, DecidesByTheSurfaceAndTheCharacteristicsTogether) {
  const InspectionReference reference = reference_of_mesh(testing::sphere({5, 0, 0}, 20.0, 40));
  InspectionPlan plan = ball_plan(0.05);
  EXPECT_TRUE(inspect_part(large_ball(), &reference, plan).tolerance_is_default);
  plan.surface.edge_mm = 0.0;
  plan.tolerance_mm = ToleranceLimits{-0.1, 0.1};
  const Inspection good = inspect_part(large_ball(), &reference, plan);
  ASSERT_EQ(good.characteristics.size(), 1U);
  EXPECT_NEAR(good.characteristics[0].value, 40.02, 0.002);
  EXPECT_FALSE(good.tolerance_is_default);
  EXPECT_EQ(good.verdict, Conformity::In);
  // The same surface with a size that is out, and the same size with a surface that is out.
  const Inspection size_out = inspect_part(large_ball(), &reference, [&] {
    InspectionPlan tight = plan;
    tight.features[0].tolerance_mm = ToleranceLimits{-0.01, 0.01};
    return tight;
  }());
  EXPECT_EQ(size_out.surface->verdict.conformity, Conformity::In);
  EXPECT_EQ(size_out.verdict, Conformity::Out);
  // What decided stands first, with the name of the worst row.
  ASSERT_EQ(size_out.reasons.size(), 2U);
  EXPECT_EQ(size_out.reasons[0].about, "characteristics");
  EXPECT_EQ(size_out.reasons[0].text(),
            fmt::format("characteristics: 0 of 1 in, 1 out; the worst is ball diameter: {:.4f} mm, "
                        "U95 {:.4f}",
                        size_out.characteristics[0].value,
                        size_out.characteristics[0].u95));
  EXPECT_EQ(size_out.reasons[1].text(), "surface: " + sentence_of(size_out.surface->verdict));
  EXPECT_EQ(good.reasons[0].about, "surface");
  plan.tolerance_mm = ToleranceLimits{-0.005, 0.005};
  const Inspection surface_out = inspect_part(large_ball(), &reference, plan);
  EXPECT_EQ(surface_out.characteristics[0].conformity, Conformity::In);
  EXPECT_EQ(surface_out.verdict, Conformity::Out);
}

TEST(InspectPart, MeasuresWithoutAReference) {
  InspectionPlan plan = ball_plan(0.05);
  plan.thickness = true;
  plan.sections = {{.name = "middle", .point_mm = {5, 0, 0}, .normal = {0, 0, 1}}};
  const Inspection found = inspect_part(large_ball(), nullptr, plan);
  EXPECT_FALSE(found.reference);
  EXPECT_FALSE(found.surface);
  EXPECT_FALSE(found.statistics);
  EXPECT_EQ(found.verdict, Conformity::In);
  ASSERT_TRUE(found.walls);
  EXPECT_NEAR(found.walls->summary.median_mm, 40.0, 0.1);
  ASSERT_EQ(found.sections.size(), 1U);
  ASSERT_EQ(found.sections[0].measured.size(), 1U);
  EXPECT_NEAR(length_mm(found.sections[0].measured[0]), 2.0 * M_PI * 20.01, 0.5);
}

TEST(InspectPart, MeasuresThePlannedFeaturesOfAMeshOfFewTriangles) {
  InspectionPlan plan;
  for (const auto& [name, z] : {std::pair("top", 7.0), std::pair("bottom", 0.0)}) {
    PlannedFeature plane;
    plane.name = name;
    plane.near_mm = {10, 6, z};
    plane.forms_mm = {{Characteristic::Flatness, 0.01}};
    plan.features.push_back(plane);
  }
  plan.characteristics = {{.name = "height",
                           .kind = Characteristic::Distance,
                           .feature = "top",
                           .datum = "bottom",
                           .nominal = 7.0,
                           .tolerance = ToleranceLimits{-0.01, 0.01}}};
  const Inspection found = inspect_part(brick(), nullptr, plan);
  ASSERT_EQ(found.characteristics.size(), 3U);
  EXPECT_NEAR(found.characteristics[0].value, 0.0, 1e-5);
  EXPECT_NEAR(found.characteristics[2].value, 7.0, 1e-5);
  EXPECT_EQ(found.verdict, Conformity::In);
}

TEST(InspectPart, MovesWhatItMeasuresOntoTheReference) {
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  moved.linear() =
      Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  moved.translation() = Eigen::Vector3d(30, -40, 5);
  const InspectionReference reference = reference_of_mesh(brick());
  const Inspection found =
      inspect_part(transform_mesh(brick(), moved), &reference, best_fit_plan(1));
  // In any of the four poses the brick covers the reference.
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : found.mesh.vertices_mm)
    box.extend(vertex);
  EXPECT_LT((box.min() - Eigen::Vector3f(0, 0, 0)).norm(), 1e-2F);
  EXPECT_LT((box.max() - Eigen::Vector3f(20, 12, 7)).norm(), 1e-2F);
}

/// Three balls of which each view sees a part.
Mesh three_balls() {
  Mesh mesh = testing::sphere({0, 0, 40}, 15.0, 24);
  append_mesh(mesh, testing::sphere({0, 40, 40}, 10.0, 20));
  append_mesh(mesh, testing::sphere({15, 20, 70}, 6.0, 16));
  return mesh;
}

TEST(InspectPart, CountsWhatTheViewsSeeWhereverTheReferenceLies) {
  Scan scan;
  scan.rig = rig_preset("digital");
  scan.views = {{0.0, "views/000"}};
  const InspectOptions options{.scan = &scan};
  InspectionPlan plan;
  plan.align = "none";
  // Of the mesh, only what faces the camera of the view is there.
  Mesh half = three_balls();
  const Eigen::Vector3d camera = scan.rig.rig_from_object(0.0).inverse().translation();
  std::erase_if(half.triangles, [&](const Mesh::Triangle& t) {
    const Eigen::Vector3d a = half.vertices_mm[t[0]].cast<double>();
    const Eigen::Vector3d b = half.vertices_mm[t[1]].cast<double>();
    const Eigen::Vector3d c = half.vertices_mm[t[2]].cast<double>();
    return (b - a).cross(c - a).dot(camera - a) < 0.0;
  });
  const InspectionReference here = reference_of_mesh(three_balls());
  const double share = inspect_part(half, &here, plan, options).statistics->completeness.share;
  EXPECT_GT(share, 0.95);
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  moved.linear() =
      Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  moved.translation() = Eigen::Vector3d(300, -400, 50);
  const InspectionReference elsewhere = reference_of_mesh(transform_mesh(three_balls(), moved));
  const Inspection aligned = inspect_part(half, &elsewhere, best_fit_plan(1), options);
  EXPECT_NEAR(aligned.statistics->completeness.share, share, 0.01);
}

TEST(InspectPart, ReadsAReferenceInTheUnitOfThePlan) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "brick.ply";
  write_mesh(file, testing::box({0.0, 0.0, 0.0}, {2.0F, 1.2F, 0.7F}));
  std::ofstream(folder.path() / "plan.toml") << "format = \"frangia-inspection\"\nversion = "
                                                "1\nreference = \"brick.ply\"\nunits = \"cm\"\n";
  const InspectionPlan plan = read_inspection_plan(folder.path() / "plan.toml");
  ASSERT_TRUE(plan.unit_mm);
  const InspectionReference reference =
      read_inspection_reference(plan.reference, {.unit_mm = plan.unit_mm});
  EXPECT_LT(std::abs(inspect_part(brick(), &reference, plan).surface->summary.max_mm), 1e-4);
  std::ofstream(folder.path() / "plan.toml")
      << "format = \"frangia-inspection\"\nversion = 1\nunits = \"ell\"\n";
  const auto refused =
      error_of([&] { static_cast<void>(read_inspection_plan(folder.path() / "plan.toml")); });
  EXPECT_NE(refused.find("plan.toml: units is \"ell\"; it must be um, mm, cm"), std::string::npos)
      << refused;
}

TEST(InspectPart, StopsInEveryStage) {
  const InspectionReference reference = reference_of_mesh(testing::sphere({5, 0, 0}, 20.0, 20));
  InspectionPlan plan = ball_plan(0.05);
  plan.align = "none";
  plan.thickness = true;
  std::set<std::string> stages;
  frangia::Run listening;
  listening.on_stage = [&](const std::string& stage) { stages.insert(stage); };
  const Mesh mesh = testing::sphere({5, 0, 0}, 20.01, 20);
  static_cast<void>(inspect_part(mesh, &reference, plan, {}, listening));
  EXPECT_TRUE(stages.contains("features") && stages.contains("statistics") &&
              stages.contains("thickness"));
  for (const std::string& wanted : stages) {
    std::stop_source source;
    frangia::Run run;
    run.stop = source.get_token();
    run.on_stage = [&](const std::string& stage) {
      if (stage == wanted) source.request_stop();
    };
    try {
      static_cast<void>(inspect_part(mesh, &reference, plan, {}, run));
      ADD_FAILURE() << wanted << " was not stopped";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Cancelled) << wanted;
    }
  }
}

}  // namespace
}  // namespace frangia

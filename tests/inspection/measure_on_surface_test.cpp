// Profiles of surfaces and lines, and the thickness of walls, as characteristics of a plan.
#include "frangia/inspection/measure_on_surface.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/random.h"
#include "frangia/inspection/inspect_part.h"

#include "support/error_of.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

constexpr double kSigma_mm = 0.004;

/// Two walls of 60 x 60 mm, 5 mm apart, a vertex each millimetre; the upper one bulges up around
/// (20, 40). Open at its sides.
Mesh lid(double bulge_mm, std::uint64_t seed) {
  Mesh mesh = testing::level_grid(61, 61);
  const auto count = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  const std::vector<Mesh::Triangle> upper = mesh.triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    Eigen::Vector3f below = mesh.vertices_mm[i];
    Eigen::Vector3f& above = mesh.vertices_mm[i];
    const double r =
        std::hypot(static_cast<double>(above.x()) - 20.0, static_cast<double>(above.y()) - 40.0);
    above.z() = static_cast<float>(5.0 + bulge_mm * std::exp(-r * r / 50.0));
    if (seed > 0) {
      above.z() += static_cast<float>(kSigma_mm * normal_from(hash(seed, i)));
      below.z() += static_cast<float>(kSigma_mm * normal_from(hash(seed, count + i)));
    }
    mesh.vertices_mm.push_back(below);
  }
  for (const auto& [a, b, c] : upper)
    mesh.triangles.push_back({a + count, c + count, b + count});
  return mesh;
}

Mesh measured_lid(double bulge_mm, std::uint64_t seed) {
  Mesh mesh = lid(bulge_mm, seed);
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), static_cast<float>(kSigma_mm));
  return mesh;
}

PlannedCharacteristic wanted(const char* name, Characteristic kind, const char* feature = "") {
  PlannedCharacteristic planned;
  planned.name = name;
  planned.kind = kind;
  planned.feature = feature;
  return planned;
}

InspectionPlan plan_of_lid() {
  InspectionPlan plan;
  plan.tolerance_mm = ToleranceLimits{-0.2, 0.2};
  PlannedFeature top;
  top.name = "top";
  top.kind = ShapeKind::Plane;
  top.near_mm = {30, 30, 5};
  PlannedFeature base = top;
  base.name = "base";
  base.near_mm = {30, 30, 0};
  plan.features = {top, base};
  plan.sections = {{"x=20", {20, 0, 0}, {1, 0, 0}, false}, {"x=50", {50, 0, 0}, {1, 0, 0}, false}};
  for (const char* name : {"top", "base"}) {
    plan.characteristics.push_back(wanted(name, Characteristic::SurfaceProfile, name));
    plan.characteristics.back().name += " profile";
    plan.characteristics.back().limit = 0.1;
  }
  plan.characteristics.push_back(wanted("whole profile", Characteristic::SurfaceProfile));
  plan.characteristics.back().limit = 0.1;
  for (const char* name : {"x=20", "x=50"}) {
    plan.characteristics.push_back(wanted(name, Characteristic::LineProfile));
    plan.characteristics.back().section = name;
    plan.characteristics.back().name += " profile";
    plan.characteristics.back().limit = 0.1;
  }
  plan.characteristics.push_back(wanted("wall", Characteristic::Thickness, "base"));
  plan.characteristics.back().nominal = 5.0;
  plan.characteristics.back().tolerance = ToleranceLimits{-0.05, 0.05};
  return plan;
}

const MeasuredCharacteristic& row_of(const Inspection& found, const std::string& name) {
  return *std::find_if(found.characteristics.begin(),
                       found.characteristics.end(),
                       [&](const auto& row) { return row.name == name; });
}

/// A bulge of 0.08 mm is a profile of 0.16 mm where it is, and of nothing elsewhere.
TEST(MeasureOnSurface, FindsABulgeInTheProfilesAndTheWallThatHaveIt) {
  const InspectionReference reference = reference_of_mesh(lid(0.0, 0));
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Inspection found = inspect_part(measured_lid(0.08, seed), &reference, plan_of_lid());
    ASSERT_EQ(found.characteristics.size(), 6U);
    for (const char* name : {"top profile", "whole profile", "x=20 profile"}) {
      const MeasuredCharacteristic& row = row_of(found, name);
      EXPECT_NEAR(row.value, 0.16, row.u95 + 0.02) << name;
      EXPECT_GT(row.u95, 0.001) << name;
      EXPECT_LT(row.u95, 0.05) << name;
      EXPECT_EQ(row.conformity, Conformity::Out) << name << " " << row.value << " " << row.u95;
    }
    for (const char* name : {"base profile", "x=50 profile"}) {
      const MeasuredCharacteristic& row = row_of(found, name);
      EXPECT_LT(row.value, 0.04) << name;
      EXPECT_EQ(row.conformity, Conformity::In) << name << " " << row.value << " " << row.u95;
    }
    const MeasuredCharacteristic& wall = row_of(found, "wall");
    EXPECT_NEAR(wall.value, 5.08, wall.u95 + 0.01);
    EXPECT_EQ(wall.conformity, Conformity::Out) << wall.value << " " << wall.u95;
    EXPECT_TRUE(found.walls);
    EXPECT_EQ(found.verdict, Conformity::Out);
  }
}

/// The systematic part of sigma keeps its size however many points there are.
TEST(MeasureOnSurface, CountsWhatNoNumberOfPointsReduces) {
  const InspectionReference reference = reference_of_mesh(lid(0.0, 0));
  Mesh mesh = measured_lid(0.0, 1);
  const Inspection without = inspect_part(mesh, &reference, plan_of_lid());
  mesh.sigma_noise_mm = mesh.sigma_mm;
  mesh.sigma_systematic_mm.assign(mesh.sigma_mm.size(), 0.02F);
  mesh.sigma_mm.assign(mesh.sigma_mm.size(), static_cast<float>(std::hypot(kSigma_mm, 0.02)));
  const Inspection with = inspect_part(mesh, &reference, plan_of_lid());
  for (const char* name : {"top profile", "whole profile", "wall"}) {
    const double more =
        std::sqrt(std::pow(row_of(with, name).u95, 2) - std::pow(row_of(without, name).u95, 2));
    EXPECT_NEAR(more, 1.96 * 2.0 * 0.02, 0.006) << name;
  }
}

TEST(MeasureOnSurface, HasNoUncertaintyWithoutSigmaAndSaysSo) {
  const InspectionReference reference = reference_of_mesh(lid(0.0, 0));
  const Inspection found = inspect_part(lid(0.08, 0), &reference, plan_of_lid());
  EXPECT_EQ(row_of(found, "top profile").conformity, Conformity::Out);
  EXPECT_EQ(row_of(found, "base profile").conformity, Conformity::In);
  for (const MeasuredCharacteristic& row : found.characteristics) {
    EXPECT_TRUE(std::isnan(row.u95)) << row.name;
    EXPECT_FALSE(row.uncertainty_known) << row.name;
  }
  for (const VerdictReason& reason : found.reasons)
    EXPECT_NE(reason.text().find("states no sigma"), std::string::npos) << reason.text();
}

/// A profile of which a part is not measured is undecided, although its value is well within.
TEST(MeasureOnSurface, SaysWhyAProfileIsUndecidedWhoseValueIsIn) {
  const InspectionReference reference = reference_of_mesh(lid(0.0, 0));
  Mesh mesh = measured_lid(0.0, 1);
  std::erase_if(mesh.triangles, [&](const Mesh::Triangle& triangle) {
    const Eigen::Vector3f& at = mesh.vertices_mm[triangle[0]];
    return at.z() > 2.5F && at.y() > 25.0F;
  });
  const Inspection found = inspect_part(std::move(mesh), &reference, plan_of_lid());
  const MeasuredCharacteristic& row = row_of(found, "x=20 profile");
  EXPECT_LT(row.value + row.u95, 0.1);
  EXPECT_EQ(row.conformity, Conformity::Undecided);
  EXPECT_NE(row.reason.find("not measured"), std::string::npos) << row.reason;
  EXPECT_EQ(row_of(found, "base profile").conformity, Conformity::In);
  EXPECT_EQ(row_of(found, "base profile").reason, "");
}

/// A face above which the part is 5 mm thick, and 30 mm from x = 37 mm: no wall is thicker.
TEST(MeasureOnSurface, KeepsWallsApartBetweenWhichTheThicknessJumps) {
  InspectionPlan plan;
  plan.characteristics = {wanted("wall", Characteristic::Thickness)};
  plan.characteristics.back().nominal = 5.0;
  plan.characteristics.back().tolerance = ToleranceLimits{-0.05, 0.05};
  Mesh mesh = measured_lid(0.0, 1);
  for (Eigen::Vector3f& vertex : mesh.vertices_mm)
    if (vertex.z() > 2.5F && vertex.x() > 36.5F) vertex.z() += 25.0F;
  const Inspection found = inspect_part(std::move(mesh), nullptr, plan);
  const MeasuredCharacteristic& row = row_of(found, "wall");
  EXPECT_NEAR(row.value, 30.0, 0.02);
  EXPECT_LT(row.u95, 0.05);
  EXPECT_EQ(row.conformity, Conformity::Out);
}

TEST(MeasureOnSurface, RefusesAProfileWithoutAReference) {
  InspectionPlan plan = plan_of_lid();
  const std::string why =
      testing::error_of([&] { static_cast<void>(inspect_part(lid(0.0, 0), nullptr, plan)); });
  EXPECT_NE(why.find("needs a reference"), std::string::npos) << why;
  plan.characteristics = {plan.characteristics.back()};
  const Inspection wall = inspect_part(measured_lid(0.08, 1), nullptr, plan);
  EXPECT_NEAR(wall.characteristics.front().value, 5.08, 0.02);
}

}  // namespace
}  // namespace frangia

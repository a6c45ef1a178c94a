// The decision about a surface by patches of the nominal one.
#include "frangia/inspect/surface_verdict.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "frangia/core/random.h"
#include "frangia/geometry/ray_scene.h"

#include "support/measured_plate.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

using testing::distance_from;
using testing::kSigma;
using testing::Plate;

TEST(SurfaceVerdict, OfAMeshAgainstItselfIsIn) {
  Mesh mesh = testing::sphere({0, 0, 0}, 20.0, 40);
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), 0.01F);
  const RayScene reference(mesh);
  const SurfaceVerdict verdict = judge_surface(
      mesh, deviations_of(mesh, reference), reference, {.limits = {-0.0784, 0.0784}});  // 4 U
  EXPECT_EQ(verdict.conformity, Conformity::In);
  EXPECT_GT(verdict.coverage, 0.995);
  EXPECT_EQ(sentence_of(verdict).find("in, over "), 0U) << sentence_of(verdict);
  EXPECT_NEAR(verdict.area_mm2, 4.0 * 3.14159 * 400.0, 30.0);
}

/// A vertex for each fiftieth of the size: a patch of one vertex would be as uncertain as that.
TEST(SurfaceVerdict, OfACoarseMeasurementAveragesOverSeveralVertices) {
  Plate plate;
  plate.add_noise(3, static_cast<double>(kSigma));
  const double limit_mm = 3.9 * 1.96 * static_cast<double>(kSigma);
  const SurfaceVerdict verdict = plate.verdict({.limits = {-limit_mm, limit_mm}});
  EXPECT_EQ(verdict.conformity, Conformity::In) << sentence_of(verdict);
  EXPECT_LT(verdict.share_of(PatchDecision::NotWellMeasured), 0.05);  // at the border
  EXPECT_NEAR(verdict.rule.min_feature_mm, 2.0 * 60.0 / 61.0, 0.01);
}

TEST(SurfaceVerdict, OfACoarseTessellationAgainstItselfIsIn) {
  const Mesh box = testing::box({0, 0, 0}, {30, 20, 10});  // 12 triangles
  const RayScene reference(box);
  const SurfaceVerdict verdict =
      judge_surface(box, deviations_of(box, reference), reference, {.min_feature_mm = 1.0});
  EXPECT_EQ(verdict.conformity, Conformity::In) << sentence_of(verdict);
  EXPECT_GT(verdict.coverage, 0.999);
}

/// The corners of a decimated mesh lie at edges, which are not compared; its faces are measured
/// between them.
TEST(SurfaceVerdict, OfADecimatedMeshAgainstItsSourceIsIn) {
  const RayScene source(testing::box({0, 0, 0}, {30, 20, 10}));
  Mesh few = testing::box({0, 0, 0}, {30, 20, 10});
  few.sigma_mm.assign(few.vertices_mm.size(), kSigma);
  const SurfaceVerdict verdict = judge_surface(
      few, deviations_of(few, source), source, {.limits = {-0.1, 0.1}, .min_feature_mm = 2.0});
  EXPECT_EQ(verdict.conformity, Conformity::In) << sentence_of(verdict);
  EXPECT_GT(verdict.coverage, 0.99);
  // The source is inside of the decimated one where that is too large.
  few = testing::box({0, 0, 0}, {30, 20, 10.2F});
  few.sigma_mm.assign(few.vertices_mm.size(), kSigma);
  EXPECT_EQ(
      judge_surface(
          few, deviations_of(few, source), source, {.limits = {-0.1, 0.1}, .min_feature_mm = 2.0})
          .conformity,
      Conformity::Out);
}

TEST(SurfaceVerdict, IsNotDecidedByOneVertexOfMany) {
  Plate plate;
  plate.add_noise(3, static_cast<double>(kSigma));
  plate.mesh().sigma_mm[61 * 30 + 30] = 5.0F;
  plate.mesh().sigma_mm[61 * 40 + 20] = std::nanf("");
  const SurfaceVerdict verdict = plate.verdict({.limits = {-0.05, 0.05}});
  EXPECT_EQ(verdict.conformity, Conformity::In) << sentence_of(verdict);
  // The vertices around them tell as much of the patches that they lie in.
  EXPECT_LT(verdict.share_of(PatchDecision::NotWellMeasured), 0.001);
}

TEST(SurfaceVerdict, DoesNotHideAPlaceWithoutAnyGoodVertex) {
  Plate plate;
  for (std::size_t i = 0; i < plate.mesh().vertices_mm.size(); ++i) {
    const Vector3f& at = plate.mesh().vertices_mm[i];
    if (distance_from(at, 30, 30) < 4.0) plate.mesh().sigma_mm[i] = 0.1F;
  }
  const SurfaceVerdict verdict = plate.verdict({.limits = {-0.05, 0.05}});
  EXPECT_GT(verdict.share_of(PatchDecision::NotWellMeasured), 0.005);
  EXPECT_LT(verdict.coverage, 0.995);
}

TEST(SurfaceVerdict, OfADentIsOutAtItsPlace) {
  const double u = static_cast<double>(kSigma) / std::sqrt(3.1);  // of a patch of 2 mm
  const double depth = 0.05 + 3.0 * 1.96 * u;
  int out = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Plate plate;
    plate.raise([&](const Vector3f& at) { return distance_from(at, 20, 40) < 3.1 ? -depth : 0.0; });
    plate.add_noise(seed, static_cast<double>(kSigma));
    const SurfaceVerdict verdict = plate.verdict({.limits = {-0.05, 0.05}});
    if (verdict.conformity != Conformity::Out) continue;
    ASSERT_FALSE(verdict.places.empty());
    const SurfacePlace& place = verdict.places.front();
    EXPECT_EQ(place.decision, PatchDecision::Out);
    EXPECT_LT(distance_from(place.at_mm.cast<float>(), 20, 40), 3.5);
    EXPECT_NEAR(place.deviation_mm, -depth, 0.015);
    ++out;
  }
  EXPECT_GE(out, 19);
}

TEST(SurfaceVerdict, ProvesOutButNeverInWhereTheUncertaintyIsLarge) {
  Plate noisy;
  noisy.mesh().sigma_mm.assign(noisy.mesh().vertices_mm.size(), 0.2F);
  const SurfaceVerdict open = noisy.verdict({.limits = {-0.1, 0.1}});
  EXPECT_EQ(open.conformity, Conformity::Undecided);
  EXPECT_EQ(open.reason, UndecidedReason::Noise);
  EXPECT_EQ(open.share_of(PatchDecision::In), 0.0);
  EXPECT_NE(sentence_of(open).find("mostly noise"), std::string::npos) << sentence_of(open);
  // The tolerance that it asks for is decided.
  ASSERT_GT(open.decidable_mm, 0.1);
  const auto with_half_width = [&](double mm) {
    return noisy.verdict({.limits = {-mm, mm}}).conformity;
  };
  EXPECT_EQ(with_half_width(1.0001 * open.decidable_mm), Conformity::In);
  EXPECT_NE(with_half_width(0.9 * open.decidable_mm), Conformity::In);
  Mesh& mesh = noisy.mesh();
  mesh.sigma_noise_mm.assign(mesh.vertices_mm.size(), 0.001F);
  const SurfaceVerdict biased = noisy.verdict({.limits = {-0.1, 0.1}});
  EXPECT_EQ(biased.reason, UndecidedReason::Systematic);
  EXPECT_NE(sentence_of(biased).find("this rig can decide"), std::string::npos);
  noisy.raise([](const Vector3f&) { return 1.6; });
  EXPECT_EQ(noisy.verdict({.limits = {-0.1, 0.1}}).conformity, Conformity::Out);
}

/// The guard band grows with the uncertainty, and is the proof; a plan may ask for more.
TEST(SurfaceVerdict, ProvesInByTheGuardBandAlone) {
  Plate noisy;
  const double noise = 0.02;
  noisy.mesh().sigma_mm.assign(noisy.mesh().vertices_mm.size(), static_cast<float>(noise));
  noisy.add_noise(2, noise);
  const double u95 = 1.96 * noisy.verdict({.limits = {-1, 1}}).median_u_mm;
  SurfaceRule rule{.limits = {-2.5 * u95, 2.5 * u95}};  // 0.4 of the half-width
  const SurfaceVerdict proven = noisy.verdict(rule);
  EXPECT_EQ(proven.conformity, Conformity::In) << sentence_of(proven);
  EXPECT_EQ(proven.share_of(PatchDecision::NearLimit), 0.0);
  rule.max_uncertainty_share = 0.25;
  const SurfaceVerdict open = noisy.verdict(rule);
  EXPECT_EQ(open.conformity, Conformity::Undecided);
  EXPECT_GT(open.share_of(PatchDecision::NotWellMeasured), 0.9);
  // What lies at the limit is not proven, however large its uncertainty is.
  noisy.raise(
      [&](const Vector3f& at) { return distance_from(at, 30, 30) < 12.0 ? 2.5 * u95 : 0.0; });
  rule.max_uncertainty_share = 1.0;
  EXPECT_NE(noisy.verdict(rule).conformity, Conformity::In);
}

TEST(SurfaceVerdict, NamesWhatAMeshWithoutSigmaLacks) {
  Plate plate;
  plate.mesh().sigma_mm.clear();
  const SurfaceVerdict verdict = plate.verdict({.limits = {-0.1, 0.1}});
  EXPECT_EQ(verdict.conformity, Conformity::In);
  EXPECT_FALSE(verdict.uncertainty_known);
  EXPECT_NE(sentence_of(verdict).find("states no sigma"), std::string::npos);
}

TEST(SurfaceVerdict, CountsTheNominalAreaThatWasNotMeasured) {
  Plate plate;
  plate.remove([](const Vector3f& at) { return distance_from(at, 30, 30) < 10.2; });
  SurfaceRule rule{.limits = {-0.05, 0.05}};
  const SurfaceVerdict open = plate.verdict(rule);
  EXPECT_EQ(open.conformity, Conformity::Undecided);
  EXPECT_EQ(open.reason, UndecidedReason::NotMeasured);
  EXPECT_NEAR(open.gap_mm, 20.0, 4.0);
  EXPECT_LT((open.gap_at_mm - Vector3d(30, 30, 0)).norm(), 3.0);
  EXPECT_NEAR(open.share_of(PatchDecision::NotMeasured), 3.14159 * 100.0 / 3600.0, 0.04);
  EXPECT_NE(sentence_of(open).find("exclude it in the plan"), std::string::npos);
  rule.excluded = {{"bore", {18, 18, -1}, {42, 42, 1}}};
  const SurfaceVerdict judged = plate.verdict(rule);
  EXPECT_EQ(judged.conformity, Conformity::In) << sentence_of(judged);
  EXPECT_NEAR(judged.area_mm2, 3600.0 - 24.0 * 24.0, 30.0);
  rule.excluded.clear();
  rule.max_gap_mm = 30.0;
  rule.min_coverage = 0.8;
  EXPECT_EQ(plate.verdict(rule).conformity, Conformity::In);
  rule.min_coverage = 0.97;
  EXPECT_EQ(plate.verdict(rule).conformity, Conformity::Undecided);
}

/// A gap that is too wide is named also where enough of the area is measured well.
TEST(SurfaceVerdict, NamesAGapThatIsTooWideAndNotMeasuredWellEnough) {
  Plate plate;
  for (std::size_t v = 0; v < plate.mesh().vertices_mm.size(); ++v)
    if (distance_from(plate.mesh().vertices_mm[v], 30, 30) < 7.0) plate.mesh().sigma_mm[v] = 0.5F;
  const SurfaceVerdict verdict = plate.verdict({.limits = {-0.05, 0.05}});
  EXPECT_EQ(verdict.conformity, Conformity::Undecided);
  EXPECT_GT(verdict.coverage, 0.9);
  EXPECT_NE(sentence_of(verdict).find("wanted is 8.48 mm at most"), std::string::npos)
      << sentence_of(verdict);
  EXPECT_EQ(sentence_of(verdict).find("good enough"), std::string::npos) << sentence_of(verdict);
}

/// Many small places that are uncertain do not hide the large one that was not measured.
TEST(SurfaceVerdict, NamesTheLargestOfThePlacesThatLackAMeasurementFirst) {
  Plate plate;
  for (int i = 0; i < 36; ++i) {
    for (std::size_t v = 0; v < plate.mesh().vertices_mm.size(); ++v) {
      if (distance_from(plate.mesh().vertices_mm[v], 5 + 10 * (i % 6), 5 + 10 * (i / 6)) < 2.5)
        plate.mesh().sigma_mm[v] = 0.5F;
    }
  }
  plate.remove([](const Vector3f& at) { return distance_from(at, 30, 30) < 12.2; });
  const SurfaceVerdict verdict = plate.verdict({.limits = {-0.05, 0.05}});
  ASSERT_GE(verdict.places.size(), 24U);
  EXPECT_EQ(verdict.places.front().decision, PatchDecision::NotMeasured);
  EXPECT_LT(distance_from(verdict.places.front().at_mm.cast<float>(), 30, 30), 4.0);
}

/// Nominal: a box of 40 x 40 x 10 mm with a round boss. Measured: its top without the boss, and
/// nothing else.
TEST(SurfaceVerdict, OfAMissingBossIsOutThere) {
  Mesh nominal = testing::level_grid(41, 41);
  for (Vector3f& vertex : nominal.vertices_mm)
    vertex.z() = distance_from(vertex, 12, 25) < 6.5 ? 15.0F : 10.0F;
  testing::add_floor(nominal);
  Mesh measured = testing::level_grid(41, 41);
  for (Vector3f& vertex : measured.vertices_mm)
    vertex.z() = 10.0F;
  measured.sigma_mm.assign(measured.vertices_mm.size(), kSigma);
  const RayScene reference(nominal);
  const SurfaceVerdict verdict = judge_surface(measured,
                                               deviations_of(measured, reference),
                                               reference,
                                               {.limits = {-0.1, 0.1}, .min_feature_mm = 2.0});
  EXPECT_EQ(verdict.conformity, Conformity::Out);
  ASSERT_FALSE(verdict.places.empty());
  EXPECT_LT(distance_from(verdict.places.front().at_mm.cast<float>(), 12, 25), 9.0);
  const auto missing = std::find_if(verdict.places.begin(),
                                    verdict.places.end(),
                                    [](const SurfacePlace& place) { return place.missing; });
  ASSERT_NE(missing, verdict.places.end());
  EXPECT_GT(missing->area_mm2, 50.0);  // the cap of the boss has 133 mm2
}

TEST(SurfaceVerdict, DoesNotTakeTheFloorBelowAThinWallForMissingMaterial) {
  // A lid of 1 mm over a floor; its top was not measured, the floor lies 0.05 mm too high.
  Mesh nominal = testing::box({0, 0, 0}, {30, 30, 5});
  const Mesh lid = testing::box({0, 0, 20}, {30, 30, 21});
  const auto first = static_cast<std::uint32_t>(nominal.vertices_mm.size());
  nominal.vertices_mm.insert(
      nominal.vertices_mm.end(), lid.vertices_mm.begin(), lid.vertices_mm.end());
  for (const auto& [a, b, c] : lid.triangles)
    nominal.triangles.push_back({a + first, b + first, c + first});
  Mesh measured = testing::box({0, 0, 0}, {30, 30, 5.05F});
  const RayScene reference(nominal);
  const SurfaceVerdict verdict = judge_surface(
      measured, deviations_of(measured, reference), reference, {.min_feature_mm = 1.0});
  EXPECT_EQ(verdict.share_of(PatchDecision::Out), 0.0);
  EXPECT_EQ(verdict.reason, UndecidedReason::NotMeasured);
}

/// Where the reference has a surface at the root of the pin, what was measured there is that one.
TEST(SurfaceVerdict, TakesNoNarrowPinForMissing) {
  Mesh nominal = testing::level_grid(41, 41);
  const Mesh pin = testing::box({18, 18, -1}, {22, 22, 30});
  const auto first = static_cast<std::uint32_t>(nominal.vertices_mm.size());
  nominal.vertices_mm.insert(
      nominal.vertices_mm.end(), pin.vertices_mm.begin(), pin.vertices_mm.end());
  for (const auto& [a, b, c] : pin.triangles)
    nominal.triangles.push_back({a + first, b + first, c + first});
  const Mesh measured = testing::level_grid(41, 41);
  const RayScene reference(nominal);
  const SurfaceVerdict verdict = judge_surface(
      measured, deviations_of(measured, reference), reference, {.min_feature_mm = 1.0});
  EXPECT_TRUE(std::none_of(verdict.places.begin(),
                           verdict.places.end(),
                           [](const SurfacePlace& place) { return place.missing; }));
  EXPECT_GT(verdict.share_of(PatchDecision::NotMeasured), 0.1);
}

TEST(SurfaceVerdict, IsOpenWhereABaseWasNotMeasured) {
  // The base of a box was not measured: below it there is no measured surface that faces down.
  Mesh box = testing::box({0, 0, 0}, {30, 30, 10});
  const RayScene reference(box);
  std::erase_if(box.triangles, [&](const Mesh::Triangle& triangle) {
    return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t v) {
      return box.vertices_mm[v].z() < 0.1F;
    });
  });
  Deviations found = deviations_of(box, reference);
  const SurfaceVerdict verdict = judge_surface(box, found, reference, {.min_feature_mm = 1.0});
  EXPECT_EQ(verdict.share_of(PatchDecision::Out), 0.0);
  EXPECT_EQ(verdict.conformity, Conformity::Undecided);
  EXPECT_EQ(verdict.reason, UndecidedReason::NotMeasured);
}

/// A good part is called out no more often than in one of twenty cases, however many patches it
/// has, and also where all of them err alike.
TEST(SurfaceVerdict, DoesNotCallAGoodPartBad) {
  const RayScene reference(testing::level_grid(61, 61));
  Plate plate;
  Mesh& mesh = plate.mesh();
  mesh.sigma_noise_mm.assign(mesh.vertices_mm.size(), 0.02F);
  for (const double common : {0.0, 0.02}) {
    mesh.sigma_mm.assign(mesh.vertices_mm.size(), static_cast<float>(std::hypot(0.02, common)));
    for (Vector3f& vertex : mesh.vertices_mm)
      vertex.z() = 0.0F;
    Deviations found = deviations_of(mesh, reference);
    int bad = 0;
    constexpr int kTrials = 120;
    for (std::uint64_t seed = 0; seed < kTrials; ++seed) {
      const double alike = common * normal_from(hash(seed, 1U << 30U));
      for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
        // The whole part lies at its limit.
        if (found.status[i] != DeviationStatus::Compared) continue;
        found.deviation_mm[i] = static_cast<float>(0.1 + alike + 0.02 * normal_from(hash(seed, i)));
        mesh.vertices_mm[i].z() = found.deviation_mm[i];
      }
      const SurfaceVerdict verdict = judge_surface(mesh, found, reference, {.limits = {-0.1, 0.1}});
      bad += verdict.conformity == Conformity::Out ? 1 : 0;
    }
    EXPECT_LE(bad, kTrials / 20 + 7) << common;  // 5 % and 2.6 standard deviations
    if (common == 0.0) {
      EXPECT_GE(bad, 1);
    }
  }
}

TEST(SurfaceVerdict, SharesNeverRoundToNothingOrAll) {
  EXPECT_EQ(share_text(0.9999999), "99.9 %");
  EXPECT_EQ(share_text(1e-9), "0.1 %");
  EXPECT_EQ(share_text(0.9734), "97.3 %");
  EXPECT_EQ(share_text(0.0), "0 %");
  EXPECT_EQ(share_text(1.0), "100 %");
}

}  // namespace
}  // namespace frangia

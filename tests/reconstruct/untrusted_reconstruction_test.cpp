#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/frames/png.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/inspect/surface_error.h"
#include "frangia/reconstruct/internal/trust.h"
#include "frangia/reconstruct/reconstruct.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/rig.h"

#include "support/displaced_views.h"
#include "support/error_of.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::displace_every_other_view;
using testing::small_scan;
using testing::TemporaryFolder;

TEST(Reconstruct, MarksAMeshOfViewsThatContradictEachOther) {
  const TemporaryFolder folder;
  const Scan scan = small_scan(folder.path(), "bracket", "digital", 6, {}, 4);
  displace_every_other_view(scan);
  std::vector<std::string> notes;
  frangia::Run run;
  run.on_note = [&](const std::string& sentence) { notes.push_back(sentence); };
  const Reconstruction result = reconstruct(scan, {}, run);
  EXPECT_NE(result.untrusted_reason.find("the views contradict each other"), std::string::npos)
      << result.untrusted_reason;
  ASSERT_TRUE(result.registration.has_value());
  EXPECT_EQ(result.registration->untrusted_reason(), result.untrusted_reason);
  ASSERT_FALSE(result.mesh.sigma_mm.empty());
  EXPECT_TRUE(std::all_of(result.mesh.sigma_mm.begin(),
                          result.mesh.sigma_mm.end(),
                          [](float sigma) { return std::isnan(sigma); }));
  for (const std::string& note : notes)
    EXPECT_EQ(note.find("views agree"), std::string::npos) << note;
}

TEST(Reconstruct, BlamesNoPartForViewsWhoseFringesNothingNumbers) {
  const TemporaryFolder folder;
  Scan plan;
  plan.folder = folder.path();
  plan.name = "bust";
  plan.rig = testing::small_rig("digital", 3);
  plan.patterns = {default_patterns(plan.rig).back()};  // the finest fringes alone
  for (int i = 0; i < 6; ++i)
    plan.views.push_back({kTwoPi * i / 6, "views/" + std::to_string(i)});
  const Scan scan = simulate_scan(make_part("bust"), plan, {.samples_per_px = 1});
  std::string warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings += sentence + "\n"; };
  const Reconstruction result = reconstruct(scan, {}, run);
  EXPECT_NE(result.untrusted_reason.find("do not tell which fringe is which"), std::string::npos)
      << result.untrusted_reason;
  EXPECT_EQ(warnings.find("elsewhere"), std::string::npos) << warnings;
  EXPECT_EQ(warnings.find("moved"), std::string::npos) << warnings;
  EXPECT_EQ(warnings.find("slid"), std::string::npos) << warnings;
  ASSERT_TRUE(result.registration);
  EXPECT_EQ(result.registration->explanation.best, PoseCause::AsStated);
}

TEST(Reconstruct, CallsViewsThatMeasureNothingNoCopies) {
  const TemporaryFolder folder;
  const Scan scan = small_scan(folder.path(), "bracket", "digital", 6, {}, 3);
  // Fringes at a hundredth of the light, which leave no pixel of these views with a phase.
  for (const char* view : {"views/1", "views/4"}) {
    for (const auto& file : std::filesystem::directory_iterator(folder.path() / view)) {
      auto frame = read_png(file.path());
      auto& counts = std::get<Image<std::uint8_t>>(frame);
      for (std::uint8_t& pixel : counts.pixels())
        pixel /= 100;
      write_png(file.path(), frame);
    }
  }
  const Reconstruction result = reconstruct(scan);
  for (const ViewSummary& view : result.view_summaries)
    EXPECT_EQ(view.same_as, "") << view.name;
}

TEST(UntrustedReason, OfDistancesThatAreRelativeComesBeforeThatOfThePoses) {
  Reconstruction result;
  EXPECT_EQ(untrusted_reason_of(result, false), "");
  result.registration = RegistrationReport{};
  result.registration->trustworthy = false;
  EXPECT_NE(untrusted_reason_of(result, false).find("the part moved"), std::string::npos);
  EXPECT_EQ(untrusted_reason_of(result, true).find("the part moved"), std::string::npos);
}

TEST(Reconstruct, NamesTwoViewsThatHoldTheSameFrames) {
  const TemporaryFolder folder;
  const Scan scan = small_scan(folder.path(), "bracket", "digital", 6, {}, 3);
  std::filesystem::remove_all(folder.path() / "views/4");
  std::filesystem::copy(folder.path() / "views/1", folder.path() / "views/4");
  std::string warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings += sentence + "\n"; };
  const Reconstruction result = reconstruct(scan, {}, run);
  // The copy alone contradicts the others, which are sound without it.
  EXPECT_NE(warnings.find("views/1 and views/4 hold the same frames"), std::string::npos)
      << warnings;
  EXPECT_TRUE(result.view_summaries.at(4).left_out);
  EXPECT_FALSE(result.view_summaries.at(1).left_out);
  EXPECT_EQ(result.untrusted_reason, "");
  const RayScene truth(make_part("bracket"));
  EXPECT_LT(surface_error(result.mesh, truth).rms_mm, 0.04);
}

TEST(Reconstruct, NamesACopyOfAViewThatNoOtherDecides) {
  const TemporaryFolder folder;
  const Scan scan = small_scan(folder.path(), "bracket", "digital", 6, {}, 3);
  for (const auto& [from, to] : {std::pair{"1", "3"}, {"0", "2"}}) {
    std::filesystem::remove_all(folder.path() / "views" / to);
    std::filesystem::copy(folder.path() / "views" / from, folder.path() / "views" / to);
  }
  std::string warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings += sentence + "\n"; };
  const Reconstruction result = reconstruct(scan, {}, run);
  EXPECT_NE((warnings + result.untrusted_reason).find("hold the same frames"), std::string::npos)
      << warnings << result.untrusted_reason;
}

TEST(Reconstruct, KeepsARightRigWhereFewViewsOverlapTooLittleToRefineIt) {
  const Rig rig = read_rig(FRANGIA_SOURCE_DIR "/examples/python/small-rig.toml");
  // The refined axis slid along flat faces: errors of 0.8, 2.1, 0.1 and 1.4 mm.
  for (const auto& [part, views] :
       {std::pair{"bracket", 3}, {"bracket", 4}, {"plate", 4}, {"groove", 4}}) {
    const TemporaryFolder folder;
    Scan plan;
    plan.folder = folder.path();
    plan.rig = rig;
    plan.patterns = default_patterns(plan.rig, {.periods_px = {640.0, 80.0, 20.0}});
    for (int i = 0; i < views; ++i)
      plan.views.push_back({rad_from_deg(360.0 * i / views), "views/" + std::to_string(i)});
    const Reconstruction result = reconstruct(simulate_scan(make_part(part), plan));
    EXPECT_EQ(result.untrusted_reason, "") << part;
    const RayScene truth(make_part(part));
    EXPECT_LT(surface_error(result.mesh, truth).rms_mm, 0.04) << part << " " << views;
  }
}

TEST(Reconstruct, IsAnErrorWhereThePointsFormNoSurface) {
  const TemporaryFolder folder;
  Scan plan;
  plan.folder = folder.path();
  plan.rig = testing::small_rig("digital");
  // Three frames of a display of gamma 2.6, and beats that their harmonics make useless where
  // nobody corrects them.
  plan.patterns =
      default_patterns(plan.rig, {.periods_px = {20.0, 1280.0 / 58.0, 1280.0 / 53.0}, .shifts = 3});
  plan.views.push_back({0.0, "views/0"});
  SimulateOptions options{.samples_per_px = 1};
  options.display_gamma = 2.6;
  const Scan scan = simulate_scan(make_part("bust"), plan, options);
  ReconstructOptions uncorrected;
  uncorrected.decode.undo_own_response = false;
  const std::string error =
      testing::error_of([&] { static_cast<void>(reconstruct(scan, uncorrected)); });
  EXPECT_NE(error.find("points do not form a surface: the fringe orders of most lit pixels are "
                       "uncertain or jump from pixel to pixel"),
            std::string::npos)
      << error;
}

TEST(Reconstruct, MeasuresWithAProjectorAboveTheCamera) {
  Scan plan;
  plan.rig = testing::small_rig("digital");
  const Eigen::Vector3d target = crossing_of_axes(plan.rig);
  Projector& projector = plan.rig.projector;
  projector.position_mm = {0.0, -180.0, 30.0};
  const Eigen::Vector3d forward = (target - projector.position_mm).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(forward).normalized();
  projector.rotation.row(0) = right;
  projector.rotation.row(1) = forward.cross(right);
  projector.rotation.row(2) = forward;
  for (int i = 0; i < 4; ++i)
    plan.views.push_back({kTwoPi * i / 4, "views/" + std::to_string(i)});
  for (const bool vertical : {false, true}) {
    const TemporaryFolder folder;
    plan.folder = folder.path();
    PatternPlan patterns;
    if (vertical) patterns.direction = FringeDirection::Vertical;
    plan.patterns = default_patterns(plan.rig, patterns);
    const Scan scan = simulate_scan(make_part("plate"), plan, {.samples_per_px = 1});
    if (vertical) {
      const std::string error = testing::error_of([&] { static_cast<void>(reconstruct(scan)); });
      EXPECT_NE(error.find("vertical fringes do not measure depth"), std::string::npos) << error;
      continue;
    }
    const Reconstruction result = reconstruct(scan);
    EXPECT_EQ(result.untrusted_reason, "");
    EXPECT_LT(surface_error(result.mesh, RayScene(make_part("plate"))).rms_mm, 0.1);
  }
}

TEST(Reconstruct, RefusesViewsAtSeveralAnglesWithoutAnAxis) {
  const TemporaryFolder folder;
  Scan scan = small_scan(folder.path(), "plate", "digital", 2, {}, 4);
  scan.rig.turntable.reset();
  const std::string error = testing::error_of([&] { static_cast<void>(reconstruct(scan)); });
  EXPECT_NE(error.find("at different angles, but rig.toml has no [turntable]"), std::string::npos)
      << error;
  for (ScanView& view : scan.views)
    view.angle_rad = 0.0;
  EXPECT_EQ(testing::error_of([&] { static_cast<void>(reconstruct(scan)); }), "");
}

TEST(Reconstruct, SaysThatNothingDeterminesTheFringeOrders) {
  const TemporaryFolder folder;
  Scan plan;
  plan.folder = folder.path();
  plan.rig = read_rig(FRANGIA_SOURCE_DIR "/tests/data/small-interferometer.toml");
  plan.patterns = default_patterns(plan.rig);
  for (int i = 0; i < 2; ++i)
    plan.views.push_back({kTwoPi * i / 2, "views/" + std::to_string(i)});
  const Scan scan = simulate_scan(make_part("shaft"), plan, {.samples_per_px = 1});
  const std::string error = testing::error_of([&] { static_cast<void>(reconstruct(scan)); });
  EXPECT_NE(error.find("points is unknown; capture a laser sheet"), std::string::npos) << error;
}

TEST(Reconstruct, RemovesTheRimOfATurntableTopSeenEdgeOn) {
  const TemporaryFolder folder;
  Scan plan;
  plan.folder = folder.path();
  plan.name = "bracket";
  plan.rig = testing::small_rig("digital", 3);
  plan.rig.turntable = Turntable{{3.5, 12.0, 516.0}, -Eigen::Vector3d::UnitY()};
  plan.patterns = default_patterns(plan.rig);
  for (int i = 0; i < 6; ++i)
    plan.views.push_back({kTwoPi * i / 6, "views/" + std::to_string(i)});
  SimulateOptions options{.samples_per_px = 4};
  options.turntable_top_radius_mm = 70.0;
  const Scan scan = simulate_scan(make_part("bracket"), plan, options);
  const auto widest_mm = [](const Mesh& mesh) {
    float widest = 0.0F;
    for (const Eigen::Vector3f& vertex : mesh.vertices_mm)
      widest = std::max(widest, vertex.head<2>().norm());
    return widest;
  };
  std::vector<std::string> notes;
  frangia::Run run;
  run.on_note = [&](const std::string& sentence) { notes.push_back(sentence); };
  const Reconstruction result = reconstruct(scan, {}, run);
  EXPECT_NEAR(result.turntable_top_height_mm, 0.0, 1.0);
  EXPECT_LT(widest_mm(result.mesh), 60.0F);
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.find("rim of the turntable top") != std::string::npos;
  }));
  ReconstructOptions keep;
  keep.keep_turntable_top = true;
  EXPECT_GT(widest_mm(reconstruct(scan, keep).mesh), 65.0F);
}

}  // namespace
}  // namespace frangia

// Indirect light from the frames to the mesh.
#include <algorithm>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/reconstruct/reconstruct.h"
#include "frangia/rig/read_rig.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/rig_presets.h"
#include "frangia/simulate/simulate_scan.h"

#include "support/temporary_folder.h"

namespace frangia {
namespace {

/// Two views of the groove by a camera with a third of its pixels on a side.
Scan small_groove(const std::filesystem::path& folder, const SimulateOptions& options) {
  Scan plan;
  plan.folder = folder;
  plan.rig = rig_preset("digital");
  CameraModel& model = plan.rig.reference().model;
  model.width_px /= 3;
  model.height_px /= 3;
  model.focal_px /= 3.0;
  model.principal_point_px = (model.principal_point_px.array() + 0.5) / 3.0 - 0.5;
  plan.patterns = default_patterns(plan.rig, {.periods_px = {1280.0, 160.0, 40.0}});
  plan.views = {{0.0, "views/0"}, {0.4, "views/1"}};
  return simulate_scan(make_part("groove"), plan, options);
}

/// 0 without a systematic part.
double largest_systematic_mm(const Mesh& mesh) {
  const auto& all = mesh.sigma_systematic_mm;
  return all.empty() ? 0.0 : static_cast<double>(*std::max_element(all.begin(), all.end()));
}

TEST(IndirectLight, OfAGrooveIsFoundAndCountedInSigma) {
  const testing::TemporaryFolder folder;
  SimulateOptions options;
  options.bounces = 1;
  options.albedo = 0.8;
  const Scan scan = small_groove(folder.path() / "scan", options);
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  const Reconstruction found = reconstruct(scan, {}, run);
  ASSERT_TRUE(found.indirect_light);
  EXPECT_NEAR(found.indirect_light->albedo, 0.8, 0.15);
  EXPECT_GT(found.indirect_light->affected, 0.01);
  EXPECT_GT(largest_systematic_mm(found.mesh), found.sigma.noise_mm);
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& sentence) {
    return sentence.find("indirect light: the part lights its own concave sides") !=
           std::string::npos;
  }));
  const Reconstruction ignored = reconstruct(scan, {.indirect_light = false});
  EXPECT_FALSE(ignored.indirect_light);
  EXPECT_LT(largest_systematic_mm(ignored.mesh), 0.5 * largest_systematic_mm(found.mesh));
}

TEST(IndirectLight, DoesNotStopAScanOfFewPixels) {
  const testing::TemporaryFolder folder;
  Scan plan;
  plan.folder = folder.path() / "scan";
  plan.name = "bust";
  plan.rig = read_rig(std::filesystem::path(FRANGIA_SOURCE_DIR) / "tests" / "data" /
                      "small-interferometer.toml");
  plan.patterns = default_patterns(plan.rig);
  for (int i = 0; i < 4; ++i)
    plan.views.push_back({kTwoPi * i / 4, "views/" + std::to_string(i)});
  const Scan scan = simulate_scan(make_part("bust"), plan, {.samples_per_px = 4});
  EXPECT_GT(reconstruct(scan).mesh.triangles.size(), 1000U);
}

TEST(IndirectLight, IsNotFoundWhereThereIsNone) {
  const testing::TemporaryFolder folder;
  const Scan scan = small_groove(folder.path() / "scan", {});
  const Reconstruction found = reconstruct(scan);
  EXPECT_FALSE(found.indirect_light);
}

}  // namespace
}  // namespace frangia

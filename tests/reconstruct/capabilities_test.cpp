// What is done for a scan: as a table, and from the frames to the mesh over all kinds of rigs.
#include "frangia/reconstruct/capabilities.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/statistics.h"
#include "frangia/inspect/surface_error.h"
#include "frangia/phase/temporal/unwrap_temporally.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/rig_presets.h"
#include "frangia/simulate/simulate_scan.h"

#include "support/temporary_folder.h"

namespace frangia {
namespace {

std::vector<Pattern> patterns_in(FringeDirection direction, const std::vector<double>& periods_px) {
  std::vector<Pattern> out;
  for (const double period : periods_px)
    out.push_back({.direction = direction, .period_px = period, .shifts_rad = {0.0, 1.0, 2.0}});
  return out;
}

std::vector<Pattern> columns() {
  return patterns_in(FringeDirection::Vertical, {1280.0, 160.0, 20.0});
}

std::vector<Pattern> both_directions() {
  std::vector<Pattern> out = columns();
  for (const Pattern& pattern : patterns_in(FringeDirection::Horizontal, {800.0, 100.0}))
    out.push_back(pattern);
  return out;
}

std::vector<Pattern> gray() {
  return {{.name = "gray", .kind = PatternKind::Gray, .bits = 7}};
}

Rig one_camera() {
  return rig_preset("digital");
}

Rig without_turntable() {
  Rig rig = one_camera();
  rig.turntable.reset();
  return rig;
}

Rig two_cameras() {
  return rig_preset("binocular");
}

Rig label() {
  Rig rig = two_cameras();
  rig.projector.is_label = true;
  return rig;
}

TEST(Capabilities, FollowFromRigPlanAndOptions) {
  using Use = IndirectLightUse;
  struct Row {
    const char* name;
    Rig (*rig)();
    std::vector<Pattern> patterns;
    ReconstructOptions options;
    Use indirect_light;
    bool before_registration;
    std::string left_out;  ///< begins so; empty: nothing
  };
  const std::vector<Row> rows = {
      {"one camera", one_camera, columns(), {}, Use::Corrected, true, ""},
      {"without a turntable", without_turntable, columns(), {}, Use::Corrected, false, ""},
      {"not registered",
       one_camera,
       columns(),
       {.register_views = false},
       Use::Corrected,
       false,
       ""},
      {"not wanted", one_camera, columns(), {.indirect_light = false}, Use::Ignored, false, ""},
      {"both directions",
       one_camera,
       both_directions(),
       {},
       Use::Counted,
       true,
       "points are not corrected for indirect light, because two directions"},
      {"no fringes",
       one_camera,
       gray(),
       {},
       Use::Ignored,
       false,
       "indirect light is not looked for, because the scan holds no fringes"},
      {"two cameras",
       two_cameras,
       columns(),
       {},
       Use::Counted,
       false,
       "points are not corrected for indirect light, because several cameras"},
      {"two cameras, not wanted",
       two_cameras,
       columns(),
       {.indirect_light = false},
       Use::Ignored,
       false,
       ""},
      {"label",
       label,
       columns(),
       {},
       Use::Ignored,
       false,
       "indirect light is not looked for, because the projector is a label"},
  };
  for (const Row& row : rows) {
    const Rig rig = row.rig();
    const Capabilities can =
        capabilities_of(rig, plan_decoding(row.patterns, rig, row.options.decode), row.options);
    EXPECT_EQ(can.indirect_light, row.indirect_light) << row.name;
    EXPECT_EQ(can.corrects_before_registration, row.before_registration) << row.name;
    EXPECT_EQ(can.registers_views, rig.turntable && row.options.register_views) << row.name;
    EXPECT_EQ(can.removes_turntable_top, rig.turntable.has_value()) << row.name;
    std::vector<std::string> said;
    frangia::Run run;
    run.on_note = [&](const std::string& sentence) { said.push_back(sentence); };
    report(can, run);
    ASSERT_EQ(said.size(), row.left_out.empty() ? 0U : 1U) << row.name;
    for (const std::string& sentence : said)
      EXPECT_EQ(sentence.rfind(row.left_out, 0), 0U) << sentence;
  }
}

/// Views of the groove by a rig whose cameras have a fifth of their pixels on a side, and a quarter
/// where indirect light is to be found.
Scan small_groove(const std::filesystem::path& folder, bool bounces, int setups) {
  Scan plan;
  plan.folder = folder;
  plan.rig = two_cameras();
  const int shrink = bounces ? 4 : 5;
  const auto reduce = [&](CameraModel& model) {
    model.width_px /= shrink;
    model.height_px /= shrink;
    model.focal_px /= shrink;
    model.principal_point_px = (model.principal_point_px.array() + 0.5) / shrink - 0.5;
  };
  for (PosedCamera& posed : plan.rig.cameras)
    reduce(posed.camera.model);
  plan.patterns = default_patterns(plan.rig, {.periods_px = {1280.0, 160.0, 40.0}});
  const Mesh part = make_part("groove");
  for (int setup = 0; setup < setups; ++setup) {
    for (const double angle_rad : {-0.2, 0.2})
      plan.views.push_back({angle_rad, "views/" + std::to_string(plan.views.size()), setup});
    if (setup > 0) plan.part_poses[setup] = pose_on_table(part, rad_from_deg(180.0), 0.1);
  }
  SimulateOptions options;
  options.bounces = bounces ? 1 : 0;
  options.albedo = 0.8;
  options.samples_per_px = 4;  // as a camera averages over its pixels
  return simulate_scan(part, plan, options);
}

/// One cell of the matrix.
struct Cell {
  int cameras = 1;
  bool is_label = false;
  bool refines_rig = false;
  bool own_phase = false;

  [[nodiscard]] std::string name() const {
    return std::string(is_label       ? "label"
                       : cameras == 2 ? "two cameras"
                                      : "one camera") +
           (refines_rig ? ", refined rig" : "") + (own_phase ? ", own phase" : "");
  }
};

Reconstruction reconstruct_cell(Scan scan, const Cell& cell) {
  if (cell.cameras == 1) scan.rig.cameras.resize(1);
  scan.rig.projector.is_label = cell.is_label;
  ReconstructOptions options;
  options.refine_rig = cell.refines_rig;
  const Projector projector = scan.rig.projector;
  if (cell.own_phase) {
    options.decode.own.unwrap = [projector](std::span<const WrappedPhase> maps) {
      return unwrap_temporally(maps, projector);
    };
  }
  return reconstruct(scan, options);
}

/// Quantiles of the distance from the truth over sigma.
struct ErrorOverSigma {
  double median = 0.0;
  double p95 = 0.0;
};

ErrorOverSigma error_over_sigma(const Mesh& mesh) {
  const std::vector<float> errors_mm = vertex_errors_mm(mesh, RayScene(make_part("groove")));
  std::vector<float> ratios;
  for (std::size_t i = 0; i < errors_mm.size(); ++i) {
    const float ratio = std::abs(errors_mm[i]) / mesh.sigma_mm[i];
    if (std::isfinite(ratio)) ratios.push_back(ratio);
  }
  if (ratios.empty()) return {};
  std::sort(ratios.begin(), ratios.end());
  return {static_cast<double>(ratios[ratios.size() / 2]),
          static_cast<double>(ratios[ratios.size() * 19 / 20])};
}

/// All rigs are right within sigma or refused by name. Two setups of two views each do not
/// determine the drift of a rig, which is not yet refused.
void expect_honest_cells(bool bounces, int setups) {
  const testing::TemporaryFolder folder;
  const Scan scan = small_groove(folder.path() / "scan", bounces, setups);
  for (const bool refines : {false, true}) {
    for (const bool own : {false, true}) {
      if ((refines && setups == 2) || (own && bounces && (refines || setups == 2))) continue;
      for (const Cell& cell : {Cell{1, false, refines, own},
                               Cell{2, false, refines, own},
                               Cell{2, true, refines, own}}) {
        SCOPED_TRACE(cell.name());
        try {
          const Reconstruction found = reconstruct_cell(scan, cell);
          EXPECT_FALSE(cell.is_label && cell.refines_rig);
          EXPECT_EQ(found.untrusted_reason, "");
          EXPECT_EQ(found.indirect_light.has_value(), bounces && !cell.is_label);
          const ErrorOverSigma error = error_over_sigma(found.mesh);
          EXPECT_LT(error.median, 1.3);
          EXPECT_LT(error.p95, 4.0);
        } catch (const Error& error) {
          EXPECT_TRUE(cell.is_label && cell.refines_rig) << error.what();
          EXPECT_NE(std::string(error.what()).find("its projector is a label"), std::string::npos);
        }
      }
    }
  }
}

TEST(CapabilitiesHold, UnderDirectLight) {
  expect_honest_cells(false, 1);
}

TEST(CapabilitiesHold, UnderDirectLightInTwoSetups) {
  expect_honest_cells(false, 2);
}

TEST(CapabilitiesHold, UnderIndirectLight) {
  expect_honest_cells(true, 1);
}

TEST(CapabilitiesHold, UnderIndirectLightInTwoSetups) {
  expect_honest_cells(true, 2);
}

}  // namespace
}  // namespace frangia

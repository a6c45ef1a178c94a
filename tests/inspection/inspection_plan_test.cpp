// Plans, what they refuse, and the characteristics that they ask for.
#include "frangia/inspection/inspection_plan.h"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/inspection/measured_characteristics.h"
#include "frangia/inspection/write_inspection_plan.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"

namespace frangia {
namespace {

constexpr const char* kHead = "format = \"frangia-inspection\"\nversion = 1\n";

InspectionPlan plan_from(const std::string& text) {
  const testing::TemporaryFolder folder;
  std::ofstream(folder.path() / "inspection.toml") << kHead << text;
  return read_inspection_plan(folder.path() / "inspection.toml");
}

constexpr const char* kTwoBalls = R"(
part = "ball bar"
tolerance_mm = [-0.05, 0.08]
[[features]]
name = "A"
kind = "sphere"
near_mm = [0, -35, 60]
diameter_mm = 40
tolerance_mm = [-0.01, 0.01]
roundness_mm = 0.02
[[features]]
name = "B"
kind = "sphere"
near_mm = [0, 35, 60]
[[characteristics]]
name = "spacing"
kind = "distance"
feature = "A"
datum = "B"
nominal = 70
tolerance = [-0.01, 0.01]
)";

TEST(InspectionPlan, KeepsPairsOfPoints) {
  const std::string text =
      "align = \"points\"\n[[points]]\nscan_mm = [1, 2, 3]\nreference_mm = [4, "
      "5, 6]\n[[points]]\nscan_mm = [2, 2, 3]\nreference_mm = [5, 5, 6]\n";
  const std::string third = "[[points]]\nscan_mm = [1, 3, 3]\nreference_mm = [4, 6, 6]\n";
  const InspectionPlan plan = plan_from(text + third);
  ASSERT_EQ(plan.points.size(), 3U);
  EXPECT_EQ(plan.points[1].scan_mm, Eigen::Vector3d(2, 2, 3));
  EXPECT_EQ(plan.points[2].reference_mm, Eigen::Vector3d(4, 6, 6));
  const InspectionPlan again = parse_inspection_plan(inspection_plan_text(plan, {}), "plan.toml");
  EXPECT_EQ(again.points[2].reference_mm, plan.points[2].reference_mm);
  EXPECT_EQ(again.align, "points");
  const auto refused = [](const std::string& what) {
    return testing::error_of([&] { static_cast<void>(plan_from(what)); });
  };
  EXPECT_NE(refused(text).find("points needs three pairs"), std::string::npos);
  EXPECT_NE(refused("align = \"points\"\n").find("points needs three pairs"), std::string::npos);
  EXPECT_NE(refused("align = \"roughly\"\n").find("best-fit, datum, points, none"),
            std::string::npos);
}

MeasuredFeature ball(const Eigen::Vector3d& center, double diameter) {
  MeasuredFeature measured;
  measured.feature.fit.shape = {
      .kind = ShapeKind::Sphere, .center_mm = center, .radius_mm = 0.5 * diameter};
  measured.feature.uncertainty.u95_mm = 0.004;
  measured.feature.uncertainty.center_u95_mm = 0.003;
  for (int i = 0; i < 400; ++i) {
    const double z = -1.0 + 2.0 * i / 399.0;
    const double r = std::sqrt(1.0 - z * z);
    measured.points_mm.emplace_back(
        center + 0.5 * diameter * Eigen::Vector3d(r * std::cos(2.4 * i), r * std::sin(2.4 * i), z));
  }
  return measured;
}

TEST(InspectionPlan, ReadsTheReferenceOfForms) {
  constexpr const char* kBall =
      "[[features]]\nname = \"A\"\nkind = \"sphere\"\nnear_mm = [0, 0, 0]\n";
  EXPECT_EQ(plan_from(kBall).features[0].form, FormReference::LeastSquares);
  EXPECT_EQ(plan_from(std::string(kBall) + "fit = \"minimum-zone\"\n").features[0].form,
            FormReference::MinimumZone);
  EXPECT_THROW(static_cast<void>(plan_from(std::string(kBall) + "fit = \"widest\"\n")), Error);
}

TEST(InspectionPlan, MeasuresItsFeaturesAndDecides) {
  const InspectionPlan plan = plan_from(kTwoBalls);
  EXPECT_EQ(plan.part, "ball bar");
  ASSERT_TRUE(plan.tolerance_mm);
  EXPECT_EQ(plan.tolerance_mm->upper, 0.08);
  const std::vector<MeasuredFeature> found{ball({0.1, 35, 60}, 39.9),
                                           ball({0, -35.02, 60}, 40.002)};
  const auto rows = measure_characteristics(plan, found);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].name, "A diameter");
  EXPECT_NEAR(rows[0].value, 40.002, 1e-9);
  EXPECT_EQ(rows[0].conformity, Conformity::In);
  EXPECT_NEAR(rows[1].value, 0.0, 1e-9);  // round
  EXPECT_EQ(rows[1].conformity, Conformity::In);
  EXPECT_NEAR(rows[2].value, std::hypot(0.1, 70.02), 1e-9);
  EXPECT_NEAR(rows[2].u95, std::hypot(0.003, 0.003), 1e-9);
  EXPECT_EQ(rows[2].conformity, Conformity::Out);
  EXPECT_EQ(overall(rows), Conformity::Out);
}

TEST(InspectionPlan, StatesHowTheSurfaceIsJudgedAndTheHeadOfTheReport) {
  const InspectionPlan plan = plan_from(
      "min_feature_mm = 3\nmax_uncertainty_share = 0.2\nmin_coverage = 0.95\nmax_gap_mm = 8\n"
      "edge_mm = 0\n"
      "[[excluded]]\nname = \"base\"\nmin_mm = [-50, -50, -1]\nmax_mm = [50, 50, 0.5]\n"
      "[report]\ndrawing = \"D-17\"\noperator = \"A. Smith\"\npaper = \"Letter\"\n"
      "logo = \"logo.png\"\npages = [\"annex\", \"results\"]\n");
  EXPECT_EQ(plan.surface.min_feature_mm, 3.0);
  EXPECT_EQ(plan.surface.max_uncertainty_share, 0.2);
  EXPECT_EQ(plan.surface.min_coverage, 0.95);
  EXPECT_EQ(plan.surface.max_gap_mm, 8.0);
  EXPECT_EQ(plan.surface.edge_mm, 0.0);  // all is judged
  EXPECT_FALSE(plan_from("min_feature_mm = 3\n").surface.edge_mm);
  ASSERT_EQ(plan.surface.excluded.size(), 1U);
  EXPECT_EQ(plan.surface.excluded[0].max_mm.z(), 0.5);
  EXPECT_EQ(plan.report.drawing, "D-17");
  EXPECT_EQ(plan.report.inspector, "A. Smith");
  EXPECT_EQ(plan.report.paper, "Letter");
  EXPECT_EQ(plan.report.logo.filename(), "logo.png");
  EXPECT_TRUE(plan.report.logo.has_parent_path());
  EXPECT_TRUE(plan.report.prints(ReportPage::Results));
  EXPECT_TRUE(plan.report.prints(ReportPage::Annex));
  EXPECT_FALSE(plan.report.prints(ReportPage::Features));
  EXPECT_FALSE(plan_from("[report]\npages = []\n").report.prints(ReportPage::Results));
  EXPECT_TRUE(plan_from("[report]\n").report.prints(ReportPage::Features));
}

TEST(InspectionPlan, ReportsAFeatureThatIsNotFound) {
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& text) { warnings.push_back(text); };
  const auto rows = measure_characteristics(plan_from(kTwoBalls), {ball({0, -35, 60}, 40.0)}, run);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_TRUE(std::isnan(rows[2].value));
  EXPECT_EQ(rows[2].conformity, Conformity::Undecided);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("B: no sphere was found"), std::string::npos) << warnings[0];
}

TEST(InspectionPlan, GivesNoFeatureTheSizeOfItsNeighbor) {
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& text) { warnings.push_back(text); };
  const std::string ball_of =
      "kind = \"sphere\"\ndiameter_mm = 4\ntolerance_mm = [-0.1, 0.1]\nnear_mm = ";
  const auto named = [&](const char* name, const char* place) {
    return "[[features]]\nname = \"" + std::string(name) + "\"\n" + ball_of + place + "\n";
  };
  const std::vector<MeasuredFeature> found{ball({0, 0, 0}, 4.0), ball({100, 0, 0}, 4.0)};
  const auto rows = measure_characteristics(
      plan_from(named("left", "[0, 0, 0]") + named("missing", "[9, 0, 0]")), found, run);
  EXPECT_EQ(rows[0].conformity, Conformity::In);
  EXPECT_TRUE(std::isnan(rows[1].value)) << rows[1].value;
  EXPECT_EQ(rows[1].conformity, Conformity::Undecided);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("missing: the sphere that is nearest to it is that of left"),
            std::string::npos)
      << warnings[0];
  // Two names of one feature.
  warnings.clear();
  const auto both = measure_characteristics(
      plan_from(named("left", "[0, 0, 0]") + named("also left", "[1, 0, 0.5]")), found, run);
  EXPECT_EQ(both[1].conformity, Conformity::In);
  EXPECT_TRUE(warnings.empty());
  // It may have moved so far, and be another one.
  const auto moved = measure_characteristics(plan_from(named("left", "[9, 0, 0]")), found, run);
  EXPECT_NEAR(moved[0].value, 4.0, 1e-9);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("a sphere that is 7.01 mm from its near_mm"), std::string::npos)
      << warnings[0];
  const auto names =
      named_features(plan_from(named("left", "[0, 0, 0]") + named("missing", "[9, 0, 0]")), found);
  EXPECT_EQ(names.size(), 1U);
}

TEST(InspectionPlan, NamesTheKeyThatIsWrong) {
  const auto message = [](const std::string& text) {
    try {
      static_cast<void>(plan_from(text));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const auto expect = [&](const std::string& text, const std::string& part) {
    EXPECT_NE(message(text).find(part), std::string::npos) << message(text);
  };
  expect("align = \"roughly\"\n", "align is \"roughly\"");
  expect("align = \"datum\"\n", "datums must name one to three of [[features]]");
  expect("datums = [\"A\"]\n", "datums names \"A\", which is no name of [[features]]");
  expect("min_coverage = 1.5\n", "min_coverage must be 1 at most");
  expect("edge_mm = -1\n", "edge_mm must be 0 or more");
  expect("[report]\npaper = \"A3\"\n", "paper is \"A3\"; it must be A4 or Letter");
  expect("[report]\npages = [\"annex\", \"walls\"]\n",
         "pages is \"walls\"; it must be one of results, pictures, places, thickness, sections, "
         "features, annex");
  expect("[report]\npages = \"annex\"\n", "pages must be a list of strings");
  expect("[[excluded]]\nname = \"b\"\nmin_mm = [0, 0, 0]\nmax_mm = [1, 1, 0]\n",
         "max_mm must be larger than min_mm");
  expect("tolerance_mm = [0.1, -0.1]\n", "tolerance_mm must be [LOWER, UPPER]");
  expect("[[features]]\nname = \"A\"\nkind = \"ball\"\nnear_mm = [0, 0, 0]\n",
         "features[0].kind is \"ball\"");
  expect("[[features]]\nname = \"A\"\nkind = \"sphere\"\nnear_mm = [0, 0]\n",
         "features[0].near_mm must be a list of 3 numbers");
  expect("[[characteristics]]\nname = \"d\"\nkind = \"distance\"\nfeature = \"A\"\ndatum = \"B\"\n",
         "refers to \"A\"");
  expect("[[sections]]\nname = \"s\"\npoint_mm = [0, 0, 1]\nnormal = [0, 0, 0]\n",
         "sections[0].normal must not be zero");
}

TEST(InspectionPlan, NamesTheCharacteristicThatIsWrongByItsName) {
  const auto refused = [](const std::string& text) {
    return testing::error_of([&] { static_cast<void>(plan_from(kTwoBalls + text)); });
  };
  constexpr const char* kRunOut =
      "[[characteristics]]\nname = \"run-out of A\"\nkind = \"run-out\"\nfeature = \"A\"\ndatum = "
      "\"B\"\n";
  EXPECT_NE(refused(std::string(kRunOut) + "limit = -1\n")
                .find("\"run-out of A\": characteristics[1].limit is -1; it must be above 0"),
            std::string::npos);
  EXPECT_NE(refused(std::string(kRunOut) + "limt = 1\n")
                .find("\"run-out of A\": characteristics[1].limt is unknown here; perhaps limit"),
            std::string::npos);
  EXPECT_NE(refused("[[characteristics]]\nname = \"a\\u001Bb\"\nkind = \"waves\"\n")
                .find("toml: characteristics[1].kind is \"waves\""),
            std::string::npos);
  // A table without a name is found by its place.
  EXPECT_NE(refused("[[characteristics]]\nkind = \"run-out\"\n")
                .find("characteristics[1].name is missing"),
            std::string::npos);
}

TEST(InspectionPlan, RefusesAToleranceWithoutWidth) {
  const auto refused =
      testing::error_of([] { static_cast<void>(plan_from("tolerance_mm = [0, 0]\n")); });
  EXPECT_NE(refused.find("tolerance_mm has no width"), std::string::npos) << refused;
}

TEST(InspectionPlan, RefusesAnUnknownKeyAndNamesTheNearest) {
  const auto message = [](const std::string& text) {
    return testing::error_of([&] { static_cast<void>(plan_from(text)); });
  };
  const auto expect = [&](const std::string& text, const std::string& part) {
    EXPECT_NE(message(text).find(part), std::string::npos) << message(text);
  };
  const std::string ball = "[[features]]\nname = \"A\"\nkind = \"sphere\"\nnear_mm = [0, 0, 0]\n";
  expect("tolerence_mm = [-0.01, 0.01]\n",
         "inspection.toml: tolerence_mm is unknown here; perhaps tolerance_mm was meant");
  expect(ball + "diametr_mm = 40\n",
         "features[0].diametr_mm is unknown here; perhaps diameter_mm was meant");
  expect("[[section]]\nname = \"s\"\n", "section is unknown here; perhaps sections was meant");
  // A key that must be there names what the table has in its place.
  expect("[[features]]\nnane = \"A\"\nkind = \"sphere\"\nnear_mm = [0, 0, 0]\n",
         "features[0].name is missing; perhaps nane is meant as name: rename it");
  expect("[[features]]\nname = \"A\"\nkind = \"sphere\"\nnaer_mm = [0, 0, 0]\n",
         "near_mm is missing; perhaps naer_mm is meant as near_mm");
  expect("[[features]]\nname = \"A\"\nkind = \"sphere\"\n", "features[0].near_mm is missing");
  expect("[[sections]]\nname = \"s\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n",
         "sections[0].point_mm is missing; perhaps point is meant as point_mm");
  expect("align = \"datum\"\ndatms = [\"A\"]\n" + ball,
         "datms is unknown here; perhaps datums was meant");
  expect(
      "[[feature]]\nname = \"A\"\nkind = \"sphere\"\nnear_mm = [0, 0, 0]\ndiameter_mm = 5\n"
      "[[characteristics]]\nname = \"c\"\nkind = \"roundness\"\nfeature = \"A\"\nlimit = 1\n",
      "feature is unknown here; perhaps features was meant");
  expect(
      ball +
          "[[features]]\nname = \"B\"\nkind = \"sphere\"\nnear_mm = [9, 0, 0]\n"
          "[[characteristics]]\nname = \"c\"\nkind = \"distance\"\nfeature = \"A\"\ndatum = \"B\"\n"
          "nominl = 5\ntolerance = [-1, 1]\n",
      "nominl is unknown here; perhaps nominal was meant");
  expect(ball + "colour = \"red\"\n", "features[0].colour is unknown here; leave it out. The keys");
  expect("[[characteristics]]\nname = \"c\"\nkind = \"line-profile\"\nsection = \"z=60\"\n",
         "\"c\" refers to \"z=60\", which is no name of [[sections]]");
  // A key that is stated is not what another one was meant to be.
  expect("part = \"shaft\"\nparts = \"shaft\"\n", "parts is unknown here; leave it out");
}

/// Every key, each with a value that is not its default.
constexpr const char* kEverything = R"(part = "a \"part\", ä"
reference = "nominal.step"
units = "25.4mm"
align = "datum"
datums = ["A", "B"]
start = 2
tolerance_mm = [-0.05, 0.08]
min_feature_mm = 1.5
edge_mm = 0
max_uncertainty_share = 0.2
min_coverage = 0.8
max_gap_mm = 12
thickness = true
expansion_ppm_per_k = 11.5
temperature_u_k = 0.5

[[features]]
name = "A"
kind = "cylinder"
near_mm = [1, -2.5, 1e-05]
diameter_mm = 36
tolerance_mm = [-0.02, 0.02]
roundness_mm = 0.01
fit = "minimum-zone"

[[features]]
name = "B"
face = 3

[[characteristics]]
name = "place"
kind = "position"
feature = "A"
position_mm = [1, 2, 3]
limit = 0.2

[[characteristics]]
name = "far"
kind = "distance"
feature = "A"
datum = "B"
nominal = 70
tolerance = [-0.01, 0.01]

[[characteristics]]
name = "line"
kind = "line-profile"
section = "middle"
limit = 0.1

[[characteristics]]
name = "walls"
kind = "thickness"
nominal = 2
tolerance = [-0.1, 0.1]

[[excluded]]
name = "base"
min_mm = [-1, -1, -1]
max_mm = [1, 1, 0.5]

[[sections]]
name = "middle"
point_mm = [0, 0, 60]
normal = [0, 0, 1]
blade = true

[report]
drawing = "D-1"
order = "4711"
serial = "17"
customer = "Example"
operator = "A. Smith"
date = "2026-01-02"
paper = "Letter"
logo = "logo.png"
pages = ["results", "features"]
)";

TEST(InspectionPlan, IsWrittenAsItWasRead) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "inspection.toml";
  std::ofstream(path) << kHead << kEverything;
  const InspectionPlan plan = read_inspection_plan(path);
  write_inspection_plan(path, plan);
  EXPECT_EQ(testing::text_of(path), std::string(kHead) + kEverything);
  EXPECT_EQ(inspection_plan_text({}, "/"), kHead);
}

TEST(InspectionPlan, NamesAReferenceElsewhereByItsWholePath) {
  InspectionPlan plan;
  plan.reference = "/parts/nominal.step";
  EXPECT_NE(inspection_plan_text(plan, "/plans").find("reference = \"/parts/nominal.step\"\n"),
            std::string::npos);
  EXPECT_NE(inspection_plan_text(plan, "/parts").find("reference = \"nominal.step\"\n"),
            std::string::npos);
}

}  // namespace
}  // namespace frangia

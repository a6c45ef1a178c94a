// What a model asks for beside its shape, and its way from the second process.
#include "frangia/cad/cad_pmi.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/cad/internal/pmi_record.h"
#include "frangia/cad/read_cad.h"
#include "frangia/inspection/plan_from_pmi.h"
#include "frangia/inspection/write_inspection_plan.h"

#include "cad/made_cad_parts.h"
#include "support/error_of.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using Kind = CadRequirementKind;

class CadPmiOfFiles : public testing::MadeCadParts {
 protected:
  static std::unique_ptr<CadModel> model(const std::string& name) {
    CadOptions options;
    options.pmi = true;
    return read_cad(at(name), options);
  }
};

const CadRequirement* first_of(const CadPmi& pmi, Kind kind) {
  for (const CadRequirement& one : pmi.requirements)
    if (one.kind == kind) return &one;
  return nullptr;
}

TEST_F(CadPmiOfFiles, NamesFacesSizesZonesAndDatums) {
  const auto block = model("toleranced.stp");
  const CadPmi& pmi = block->pmi();
  EXPECT_EQ(pmi.schema, "AP242");
  const CadRequirement* bore = first_of(pmi, Kind::Diameter);
  ASSERT_NE(bore, nullptr);
  EXPECT_NEAR(bore->value, 16.0, 1e-9);
  EXPECT_NEAR(bore->lower, -0.05, 1e-9);
  EXPECT_NEAR(bore->upper, 0.05, 1e-9);
  ASSERT_EQ(bore->faces.size(), 1U);
  const CadFace& cylinder = block->faces().at(bore->faces[0] - 1);
  EXPECT_EQ(cylinder.shape->kind, ShapeKind::Cylinder);
  EXPECT_NEAR(cylinder.shape->radius_mm, 8.0, 1e-9);
  const CadRequirement* height = first_of(pmi, Kind::Distance);
  ASSERT_NE(height, nullptr);
  ASSERT_EQ(height->other_faces.size(), 1U);
  EXPECT_NEAR(block->faces().at(height->faces[0] - 1).shape->center_mm.z(), 20.0, 1e-6);
  EXPECT_NEAR(block->faces().at(height->other_faces[0] - 1).shape->center_mm.z(), 0.0, 1e-6);
  const CadRequirement* parallel = first_of(pmi, Kind::Parallelism);
  ASSERT_NE(parallel, nullptr);
  EXPECT_NEAR(parallel->value, 0.06, 1e-9);
  EXPECT_EQ(parallel->datums, std::vector<std::string>{"A"});
  const CadRequirement* datum = first_of(pmi, Kind::Datum);
  ASSERT_NE(datum, nullptr);
  EXPECT_EQ(datum->faces, height->other_faces);
}

TEST_F(CadPmiOfFiles, BecomeAPlanThatItsReaderAccepts) {
  const auto block = model("toleranced.stp");
  const PmiPlan found = plan_from_pmi(block->faces(), block->pmi(), at("toleranced.stp"));
  const InspectionPlan plan = parse_inspection_plan(
      inspection_plan_text(found.plan, at("").parent_path()), at("inspection.toml"));
  EXPECT_EQ(plan.reference, at("toleranced.stp"));
  EXPECT_EQ(plan.align, "datum");
  EXPECT_EQ(plan.datums, std::vector<std::string>{"A"});
  int diameters = 0;
  int forms = 0;
  for (const PlannedFeature& feature : plan.features) {
    diameters += feature.tolerance_mm ? 1 : 0;
    forms += static_cast<int>(feature.forms_mm.size());
  }
  EXPECT_EQ(diameters, 1);
  EXPECT_EQ(forms, 1);
  ASSERT_EQ(plan.characteristics.size(), 2U);
  EXPECT_EQ(plan.characteristics[0].kind, Characteristic::Distance);
  EXPECT_EQ(plan.characteristics[0].datum, "A");
  EXPECT_EQ(plan.characteristics[0].nominal, 20.0);
  EXPECT_EQ(plan.characteristics[1].kind, Characteristic::Parallelism);
  ASSERT_EQ(found.left_out.size(), 1U);
  EXPECT_EQ(found.left_out[0].find("straightness of face "), 0U) << found.left_out[0];
}

TEST_F(CadPmiOfFiles, SayWhyThereIsNoPlan) {
  const auto plate = model("plate.stp");
  EXPECT_TRUE(plate->pmi().requirements.empty());
  const std::string refused = testing::error_of(
      [&] { static_cast<void>(plan_from_pmi(plate->faces(), plate->pmi(), "plate.stp")); });
  EXPECT_EQ(refused,
            "plate.stp: it is STEP AP214, which holds no tolerances; export it as STEP AP242 with "
            "semantic PMI, or write the plan by hand");
}

TEST_F(CadPmiOfFiles, HaveNoUnitWhereTheFileStatesNone) {
  std::string text = testing::text_of(at("toleranced.stp"));
  const std::string context = "GLOBAL_UNIT_ASSIGNED_CONTEXT\n((#430,#431,#432))";
  ASSERT_NE(text.find(context), std::string::npos);
  text.replace(text.find(context), context.size(), "");
  const auto file = written("unitless.stp", text);
  CadOptions options;
  options.units = 25.4;
  const auto shape = read_cad(file, options);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : shape->mesh().vertices_mm)
    box.extend(vertex.cast<double>());
  EXPECT_NEAR(box.sizes().z(), 25.4 * 20.0, 1e-3);
  options.pmi = true;  // a tolerance of another unit would be read as one in mm
  const std::string refused =
      testing::error_of([&] { static_cast<void>(read_cad(file, options)); });
  EXPECT_NE(refused.find("unitless.stp: it states no unit of length, so its tolerances have none"),
            std::string::npos)
      << refused;
}

CadFace face_of(ShapeKind kind, double radius_mm = 0.0) {
  return {Shape{.kind = kind, .radius_mm = radius_mm}, 1.0};
}

TEST(PlanFromPmi, LeavesOutWhatItCannotMeasureAndSaysWhy) {
  const std::vector<CadFace> faces{
      face_of(ShapeKind::Plane), face_of(ShapeKind::Cylinder, 5.0), CadFace{std::nullopt, 1.0}};
  CadPmi pmi;
  pmi.requirements = {{Kind::Perpendicularity, "", 0.1, kMissing, kMissing, {1}, {}, {}},
                      {Kind::Parallelism, "", 0.1, kMissing, kMissing, {1}, {}, {"B"}},
                      {Kind::Diameter, "", 10.0, kMissing, kMissing, {2}, {}, {}},
                      {Kind::Diameter, "", 10.0, -0.1, 0.1, {1}, {}, {}},
                      {Kind::Flatness, "", 0.1, kMissing, kMissing, {3}, {}, {}},
                      {Kind::SurfaceProfile, "", 0.1, kMissing, kMissing, {3}, {}, {}},
                      {Kind::Distance, "", 10.0, -0.1, 0.1, {1}, {}, {}}};
  const auto refused =
      testing::error_of([&] { static_cast<void>(plan_from_pmi(faces, pmi, "part.stp")); });
  EXPECT_EQ(refused,
            "part.stp: none of its 7 dimensions and tolerances can be planned, such as "
            "perpendicularity of face 1: it names no datum; write the plan by hand");
  pmi.requirements.push_back({Kind::SurfaceProfile, "", 0.4, kMissing, kMissing, {}, {}, {}});
  const PmiPlan found = plan_from_pmi(faces, pmi, "part.stp");
  EXPECT_EQ(found.plan.tolerance_mm->upper, 0.2);
  EXPECT_EQ(found.plan.align, "best-fit");
  ASSERT_EQ(found.left_out.size(), 7U);
  EXPECT_EQ(found.left_out[1],
            "parallelism of face 1: it refers to datum B, which the file does not define");
  EXPECT_EQ(found.left_out[2], "diameter of face 2: it has no tolerance");
  EXPECT_EQ(found.left_out[3], "diameter of face 1: its face is no cylinder or sphere");
  EXPECT_EQ(found.left_out[4], "flatness of face 3: the file names no flat or round face for it");
  EXPECT_EQ(found.left_out[5].find("surface profile"), 0U) << found.left_out[5];
  EXPECT_NE(found.left_out[5].find("face 3 is no plane"), std::string::npos);
  EXPECT_EQ(found.left_out[6], "distance of face 1: the file names no second face for it");
}

TEST(PlanFromPmi, TakesTheProfileOfASingleFace) {
  const std::vector<CadFace> faces{face_of(ShapeKind::Plane), face_of(ShapeKind::Cylinder, 5.0)};
  CadPmi pmi;
  pmi.requirements = {{Kind::SurfaceProfile, "", 0.1, kMissing, kMissing, {2}, {}, {}}};
  const PmiPlan found = plan_from_pmi(faces, pmi, "part.stp");
  ASSERT_EQ(found.plan.characteristics.size(), 1U);
  EXPECT_EQ(found.plan.characteristics[0].kind, Characteristic::SurfaceProfile);
  EXPECT_EQ(found.plan.characteristics[0].feature, "face 2");
  EXPECT_EQ(found.plan.characteristics[0].limit, 0.1);
  EXPECT_FALSE(found.plan.tolerance_mm);
}

TEST(PlanFromPmi, SaysThatToleranceIsOnlyDrawn) {
  CadPmi drawn;
  drawn.schema = "AP242";
  drawn.has_graphics = true;
  const auto refused =
      testing::error_of([&] { static_cast<void>(plan_from_pmi({}, drawn, "part.stp")); });
  EXPECT_NE(refused.find("drawn for people"), std::string::npos) << refused;
}

TEST(PmiRecord, ReadsWhatItWrote) {
  const CadRequirement sent{
      Kind::Position, "bore\t1\n", 0.1, kMissing, 0.25, {3, 17}, {2}, {"A", "B,C"}};
  const auto found = parsed_pmi_record(pmi_record(sent));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, Kind::Position);
  EXPECT_EQ(found->name, "bore_1_");
  EXPECT_EQ(found->value, 0.1);
  EXPECT_TRUE(std::isnan(found->lower));
  EXPECT_EQ(found->upper, 0.25);
  EXPECT_EQ(found->faces, sent.faces);
  EXPECT_EQ(found->other_faces, sent.other_faces);
  EXPECT_EQ(found->datums, (std::vector<std::string>{"A", "B_C"}));
}

TEST(PmiRecord, RefusesWhatNoProcessOfOursWrote) {
  for (const char* line : {"",
                           "1\tname",
                           "99\t\t1\t\t\t1\t\t",
                           "1\t\tinf\t\t\t1\t\t",
                           "1\t\tnan\t\t\t1\t\t",
                           "1\t\t1x\t\t\t1\t\t",
                           "1\t\t1\t\t\t0\t\t",
                           "1\t\t1\t\t\t-1\t\t",
                           "1\t\t1\t\t\t9999999\t\t",
                           "1\t\t1\t\t\t1,,2\t\t",
                           "1\t\t1\t\t\t1\t\t\tmore"})
    EXPECT_FALSE(parsed_pmi_record(line)) << line;
  EXPECT_TRUE(parsed_pmi_record("1\t\t1\t\t\t1\t\t"));
}

}  // namespace
}  // namespace frangia

// The words of a report in the languages of its readers.
#include "frangia/report/report_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/inspection/inspect_part.h"
#include "frangia/report/internal/report_rows.h"
#include "frangia/report/write_report.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

/// The places for values in a text of the catalogue, in order of their digits.
std::multiset<char> places_in(std::string_view text) {
  std::multiset<char> places;
  for (std::size_t at = text.find('{'); at != std::string_view::npos; at = text.find('{', at + 1))
    places.insert(text.at(at + 1));
  return places;
}

TEST(ReportWords, HaveTheSameValuesInEachLanguage) {
  for (const auto rows : {report::sheet_rows(), report::annex_rows()}) {
    for (const report::ReportRow& row : rows) {
      for (const char* text : row) {
        EXPECT_NE(std::string(text), "") << row[0];
        EXPECT_EQ(places_in(text), places_in(row[0])) << text;
      }
    }
  }
}

TEST(ReportWords, TranslateSentencesWithTheirValues) {
  const ReportWords german("de");
  EXPECT_EQ(german("in, over 97.3 % of the nominal area"), "innerhalb, auf 97.3 % der Sollfläche");
  EXPECT_EQ(german("noise of a vertex, median (camera noise, speckle)"),
            "Rauschen eines Eckpunkts, Median (Kamerarauschen, Speckle)");
  EXPECT_EQ(german("bore 3"), "bore 3");
  EXPECT_EQ(german(""), "");
  EXPECT_EQ(ReportWords("en")("out"), "out");
  EXPECT_EQ(
      ReportWords("it").sentence("measure with a smaller uncertainty; a clause without a row; "
                                 "the widest gap is 3 mm at (1, 2, 3) mm"),
      "misurare con un'incertezza minore; a clause without a row; la lacuna più larga è di 3 mm a "
      "(1, 2, 3) mm");
  EXPECT_EQ(german.sentence("what; calibrate again, or state a tolerance that this rig can decide"),
            "what; neu kalibrieren oder eine Toleranz wählen, die dieser Aufbau entscheiden kann");
  EXPECT_THROW(ReportWords("fr"), Error);
}

TEST(ReportWords, KeepTheNamesOfAPlan) {
  const ReportWords german("de");
  EXPECT_EQ(german("axis"), "Achse");
  EXPECT_EQ(german.name("axis"), "axis");
  EXPECT_EQ(german.name("axis diameter"), "axis, Durchmesser");
  EXPECT_EQ(german("axis: plane"), "axis: Ebene");
  EXPECT_EQ(german("the worst is plane: 10.2 mm, U95 0.01"),
            "am schlechtesten ist plane: 10.2 mm, U95 0.01");
  EXPECT_EQ(german("axis diameter was not measured"), "axis, Durchmesser wurde nicht gemessen");
}

/// The texts of a page, without its style.
std::vector<std::string> texts_of(const std::string& page) {
  std::vector<std::string> texts;
  std::size_t at = page.find("<body>");
  while ((at = page.find('>', at)) != std::string::npos) {
    const std::size_t end = page.find('<', at);
    const std::string text = page.substr(at + 1, end - at - 1);
    at = at + 1;
    if (text.find_first_not_of(" \n") != std::string::npos) texts.push_back(text);
  }
  return texts;
}

/// More than a unit.
bool holds_words(const std::string& text) {
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  return std::count_if(text.begin(), text.end(), is_letter) > 2;
}

/// A ball of which everything was asked for, against one that is larger by 0.1 mm.
Inspection inspected_ball(const InspectionPlan& plan) {
  Mesh mesh = testing::sphere({0, 0, 0}, 20.0, 30);
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), 0.01F);
  mesh.sigma_noise_mm = mesh.sigma_mm;
  mesh.sigma_systematic_mm.assign(mesh.vertices_mm.size(), 0.005F);
  const InspectionReference reference = reference_of_mesh(testing::sphere({0, 0, 0}, 20.1, 30));
  return inspect_part(std::move(mesh), &reference, plan);
}

InspectionReport everything(const std::string& language) {
  InspectionPlan plan;
  plan.report.language = language;
  plan.part = "Name";
  plan.align = "best-fit";
  plan.tolerance_mm = ToleranceLimits{-0.02, 0.02};
  PlannedFeature ball;
  ball.name = "Name";
  ball.kind = ShapeKind::Sphere;
  ball.diameter_mm = 40.0;
  ball.tolerance_mm = ToleranceLimits{-0.1, 0.1};
  ball.forms_mm[Characteristic::Roundness] = 0.1;
  plan.features.push_back(ball);
  PlannedSection section;
  section.name = "Name";
  section.normal = Eigen::Vector3d::UnitZ();
  plan.sections.push_back(section);
  section.point_mm = {0.0, 0.0, 90.0};
  plan.sections.push_back(section);
  plan.surface.excluded.push_back({"Name", {15, 15, 15}, {25, 25, 25}});
  static const Inspection ball_of_plan = inspected_ball(plan);  // in any language
  ReportSources sources;
  sources.version = "Name";
  sources.mesh.clear();
  InspectionReport report = report_of(ball_of_plan, plan, sources);
  report.mesh = "Name";
  report.fields.drawing = report.fields.order = report.fields.serial = "Name";
  report.fields.customer = report.fields.inspector = "Name";
  // What one part cannot show at once.
  for (const PatchDecision decision : {PatchDecision::Out,
                                       PatchDecision::NearLimit,
                                       PatchDecision::NotWellMeasured,
                                       PatchDecision::NotMeasured}) {
    report.surface->places.push_back({.decision = decision, .missing = false});
    report.surface->places.push_back({.decision = PatchDecision::Out, .missing = true});
  }
  for (std::size_t& count : report.deviation->count)
    ++count;
  report.thickness.emplace();
  for (std::size_t& count : report.thickness->count)
    ++count;
  for (const ShapeKind kind : {ShapeKind::Plane, ShapeKind::Cylinder, ShapeKind::Cone}) {
    Feature feature;
    feature.fit.shape.kind = kind;
    feature.hole = kind != ShapeKind::Plane;
    report.features.push_back(feature);
    report.nominals.emplace_back();
  }
  BladeSection blade;
  report.sections.front().blade = blade;
  report.sections.front().nominal_blade = blade;
  MeasuredCharacteristic lost;
  lost.name = "Name roundness";
  lost.limits = ToleranceLimits{9.9, 10.1};
  lost.value = kMissing;
  report.characteristics.push_back(lost);
  return report;
}

TEST(ReportWords, AreThoseOfEveryTextOfAReport) {
  const std::vector<std::string> english = texts_of(html_of(everything("en")));
  const std::vector<std::string> german = texts_of(html_of(everything("de")));
  ASSERT_EQ(english.size(), german.size());
  // Names of the part and the plan, and words that both languages have.
  const std::set<std::string> names{"Name", "U95", "U95, mm", "RMS, mm", "plan", "software"};
  for (std::size_t i = 0; i < english.size(); ++i) {
    if (english[i] != german[i] || !holds_words(english[i])) continue;
    EXPECT_TRUE(names.count(english[i]) > 0 || english[i].starts_with("(") ||
                english[i].find("UTC") != std::string::npos)
        << english[i];
  }
}

}  // namespace
}  // namespace frangia

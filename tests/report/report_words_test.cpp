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
#include "frangia/report/internal/fault_rows.h"
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

/// "{0} of {1} in" fits it, too.
TEST(ReportWords, TakeTheRowThatFitsMost) {
  EXPECT_EQ(ReportWords("de")("coverage: decided share, and least share of a part that is in"),
            "Abdeckung: entschiedener Anteil, und kleinster Anteil eines Teils, das innerhalb ist");
  for (const char* language : {"de", "it"}) {
    const ReportWords words(language);
    for (const auto rows : {report::sheet_rows(), report::annex_rows()}) {
      for (const report::ReportRow& row : rows) {
        if (std::string(row[0]).find('{') != std::string::npos) continue;
        EXPECT_EQ(words(row[0]), row[language == std::string("de") ? 1 : 2]) << row[0];
      }
    }
  }
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

TEST(ReportWords, WordWarningsAsTheAppDoes) {
  const ReportWords german("de");
  EXPECT_EQ(german.warning("sphere: no sphere was found near (1, 2, 3); its values are missing"),
            "sphere: bei (1, 2, 3) ist kein Element Kugel zu finden; seine Werte fehlen");
  EXPECT_EQ(german
                .warning("part.ply: 12 % of it lies on the reference; it is another part, or "
                         "`align` best-fit must find its pose")
                .find("of it lies"),
            std::string::npos);
  // A name that is a word of the catalogue, and a file, stay.
  EXPECT_TRUE(
      german.warning("is missing: no plane was found near (1, 2, 3); its values are missing")
          .starts_with("is missing: bei"));
  EXPECT_EQ(ReportWords("en").warning("state `align` best-fit"), "state align best-fit");
  EXPECT_EQ(german.warning("no sentence of ours"), "no sentence of ours");
}

TEST(ReportWords, HoldTheSentencesOfTheApp) {
  std::size_t rows = 0;
  for (const std::string_view source : report::fault_sources())
    rows += report::parse_fault_rows(source).size();
  EXPECT_GT(rows, 1000U);
  const auto parsed = report::parse_fault_rows(
      "'fault.a': ['it\\'s {0}', \"es ist {0}\", 'e\\' {0}'], // 'x'\n'fault.b': [\n'b', 'c', "
      "'d',\n],");
  ASSERT_EQ(parsed.size(), 2U);
  EXPECT_EQ(parsed[0].text[0], "it's {0}");
  EXPECT_EQ(parsed[0].text[1], "es ist {0}");
  EXPECT_EQ(parsed[0].text[2], "e' {0}");
  EXPECT_EQ(parsed[0].fixed, 5U);
  EXPECT_EQ(parsed[1].text[2], "d");
  EXPECT_THROW(static_cast<void>(report::parse_fault_rows("'fault.a': ['one', 'two']")), Error);
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
  report.warnings = {"Name: no sphere was found near (1, 2, 3); its values are missing"};
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

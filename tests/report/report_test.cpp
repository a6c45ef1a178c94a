// Batches, sections and pages of reports.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/report/batch.h"
#include "frangia/report/inspection_report.h"

namespace frangia {
namespace {

MeasuredCharacteristic row_of(double value) {
  MeasuredCharacteristic row;
  row.name = "d";
  row.limits = ToleranceLimits{9.9, 10.1};
  row.value = value;
  row.u95 = 0.002;
  row.conformity = conformity_of(value, 0.001, *row.limits);
  return row;
}

TEST(Batch, StatesTheCapabilityOfTheProcess) {
  std::vector<BatchPart> parts;
  for (const double value : {10.00, 10.02, 10.04})
    parts.push_back({"part", {row_of(value)}});
  parts.push_back({"lost", {row_of(std::nan(""))}});
  const auto all = batch_characteristics(parts);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_NEAR(all[0].mean, 10.02, 1e-12);
  EXPECT_NEAR(all[0].deviation, 0.02, 1e-12);
  EXPECT_NEAR(all[0].cp, 0.2 / 0.12, 1e-9);
  EXPECT_NEAR(all[0].cpk, 0.08 / 0.06, 1e-9);
  // Three parts prove nothing: 1.333 - 1.645 sqrt(1 / 27 + 1.333^2 / 4).
  EXPECT_NEAR(all[0].cpk_lower_95, 0.1919, 1e-4);
  const std::string csv = batch_csv(parts, all);
  EXPECT_NE(csv.find("Cpk,1.33"), std::string::npos) << csv;
  EXPECT_NE(batch_html("<batch>", parts, all).find("&lt;batch&gt;"), std::string::npos);
  // Two parts prove no Cpk above 0, although the mean is amid the limits.
  const std::vector<BatchPart> two{{"a", {row_of(9.97)}}, {"b", {row_of(10.03)}}};
  const auto few = batch_characteristics(two);
  EXPECT_GT(few[0].cpk, 0.7);
  EXPECT_LT(few[0].cpk_lower_95, 0.0);
  EXPECT_NE(batch_csv(two, few).find("95 %,too few parts"), std::string::npos)
      << batch_csv(two, few);
  // A limit on one side has a Cpk and no Cp.
  for (BatchPart& part : parts)
    part.rows[0].limits->lower = -std::numeric_limits<double>::infinity();
  const auto one_sided = batch_characteristics(parts);
  EXPECT_TRUE(std::isnan(one_sided[0].cp));
  EXPECT_NEAR(one_sided[0].cpk, 0.08 / 0.06, 1e-9);
  parts.back().rows.clear();
  EXPECT_THROW(static_cast<void>(batch_characteristics(parts)), Error);
}

/// The table says of a part what its own report says.
TEST(Batch, DecidesByTheSurfaceTooAndKeepsPartsThatWereNotInspected) {
  const std::vector<BatchPart> parts{
      {"first", {}, Conformity::Undecided, "another part", false},
      {"good", {row_of(10.0)}, Conformity::In, "surface: in"},
      {"dented", {row_of(10.0)}, Conformity::Out, "surface: out at (1, 2, 3) mm"}};
  const auto all = batch_characteristics(parts);
  ASSERT_EQ(all.size(), 1U);
  ASSERT_EQ(all[0].values.size(), 3U);
  EXPECT_TRUE(std::isnan(all[0].values[0]));
  EXPECT_NEAR(all[0].mean, 10.0, 1e-12);
  const std::string csv = batch_csv(parts, all);
  EXPECT_NE(csv.find("\"first\",,,not inspected,\"another part\"\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\"dented\",10.000000,0.002000,out,\"surface: out"), std::string::npos) << csv;
  const std::string page = batch_html("batch", parts, all);
  EXPECT_NE(page.find("dented: out; surface: out at (1, 2, 3) mm"), std::string::npos);
  EXPECT_NE(page.find("first: not inspected; another part"), std::string::npos);
  EXPECT_EQ(page.find("good: "), std::string::npos);
}

/// A sheet is as wide as the columns of four characteristics; each table has the decisions.
TEST(Batch, IsNotCutOffHoweverManyCharacteristicsAPlanHas) {
  std::vector<BatchPart> parts{{"a", {}, Conformity::In}};
  for (int i = 0; i < 13; ++i) {
    parts[0].rows.push_back(row_of(10.0));
    parts[0].rows.back().name = "diameter " + std::to_string(i);
  }
  const std::string page = batch_html("batch", parts, batch_characteristics(parts));
  std::size_t columns = 0;
  std::size_t tables = 0;
  for (std::size_t at = page.find("<th"); at != std::string::npos; at = page.find("<th", at + 1)) {
    if (page.compare(at, 6, "<thead") != 0) ++columns;
    if (page.compare(at, 6, "<thead") == 0) ++tables;
    if (page.compare(at, 6, "<thead") == 0) columns = 0;
    EXPECT_LE(columns, 6U);
  }
  EXPECT_EQ(tables, 4U);
}

TEST(Batch, StatesNoIntervalThatIsNotKnown) {
  std::vector<BatchPart> parts{{"a", {row_of(10.0)}, Conformity::In}};
  parts[0].rows[0].u95 = kMissing;
  EXPECT_EQ(batch_html("batch", parts, batch_characteristics(parts)).find("nan"),
            std::string::npos);
}

TEST(InspectionReport, IsOnePageWithEscapedTexts) {
  InspectionReport report;
  report.part = "<script>alert(1)</script>";
  report.mesh = "a&b.ply";
  report.characteristics = {row_of(10.0), row_of(10.2)};
  report.pictures.push_back({"picture", Image<Rgb>(4, 3, Rgb{255, 0, 0})});
  const std::string page = html_of(report);
  EXPECT_EQ(page.find("<script>"), std::string::npos);
  EXPECT_NE(page.find("a&amp;b.ply"), std::string::npos);
  EXPECT_NE(page.find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);
  EXPECT_NE(page.find("Out of tolerance"), std::string::npos);
  for (const char* reference : {"src=\"http", "href=", "url(", "@import"})
    EXPECT_EQ(page.find(reference), std::string::npos) << reference;
  EXPECT_EQ(verdict_of(report), Conformity::Out);
  EXPECT_EQ(csv_of(report.characteristics),
            "name,unit,nominal,lower,upper,value,u95,conformity\n"
            "\"d\",mm,,9.9,10.1,10,0.002,in\n"
            "\"d\",mm,,9.9,10.1,10.2,0.002,out\n");
}

TEST(InspectionReport, ClaimsNoUncertaintyForAMeshWithoutSigma) {
  InspectionReport report;
  report.deviation.emplace();
  report.surface.emplace();
  report.surface->conformity = Conformity::In;
  report.surface->uncertainty_known = false;
  EXPECT_NE(html_of(report).find("In tolerance, but without an uncertainty"), std::string::npos);
  report.surface->uncertainty_known = true;
  EXPECT_NE(html_of(report).find("In tolerance, the uncertainty counted"), std::string::npos);
}

TEST(SectionResult, IsWrittenAsDxfAndSvg) {
  SectionResult section;
  section.name = "z=1";
  section.measured.push_back({{{0, 0}, {10, 0}, {10, 5}}, {0.0, 0.1, -0.05}, true});
  section.reference.push_back({{{0, 0}, {10, 0}, {10, 5}}, {}, true});
  const std::string dxf = dxf_of(section);
  EXPECT_NE(dxf.find("POLYLINE\n  8\nMEASURED\n 66\n1\n"), std::string::npos);
  EXPECT_NE(dxf.find("VERTEX\n  8\nREFERENCE\n 10\n10.00000\n 20\n5.00000\n"), std::string::npos);
  EXPECT_TRUE(dxf.ends_with("ENDSEC\n  0\nEOF\n"));
  const std::string svg = svg_of(section);
  EXPECT_NE(svg.find("M0.0000 -0.0000L10.0000 -0.0000L10.0000 -5.0000Z"), std::string::npos) << svg;
  EXPECT_NE(svg.find("deviations enlarged 10 times"), std::string::npos) << svg;
  EXPECT_NE(profile_plot(section, {-0.1, 0.1}).find("+0.1"), std::string::npos);
}

}  // namespace
}  // namespace frangia

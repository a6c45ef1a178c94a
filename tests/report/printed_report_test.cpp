// Words and colors of a report as it is printed.
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/durable_file.h"
#include "frangia/report/inspection_report.h"

#include "support/temporary_folder.h"

namespace frangia {
namespace {

/// A word on a sheet.
struct PrintedWord {
  double left, top, right, bottom;
};

bool overlap(const PrintedWord& a, const PrintedWord& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

TEST(PrintedReport, ALabelWithoutAToleranceHasNoColorOfADecision) {
  ReportPicture picture;
  picture.picture = Image<Rgb>(72, 44, Rgb{90, 90, 90});
  picture.labels = {{"9.9965 mm", "hole", {}, {20, 20}}};
  const std::string drawing = labelled_picture(picture);
  EXPECT_NE(drawing.find("9.9965 mm"), std::string::npos);
  for (const char* color : {"#b00020", "#0a6b2d", "#8a5a00"})
    EXPECT_EQ(drawing.find(color), std::string::npos) << color;
}

/// The words of the table of features, of which there are eleven columns, are whole in each
/// language.
TEST(PrintedReport, KeepsTheWordsOfTheTableOfFeaturesWhole) {
  if (std::system("command -v weasyprint pdftotext > /dev/null") != 0)
    GTEST_SKIP() << "needs weasyprint and pdftotext (packages weasyprint, poppler-utils)";
  const testing::TemporaryFolder folder;
  InspectionReport report;
  Feature bore;
  bore.hole = true;
  bore.fit.shape.kind = ShapeKind::Cylinder;
  bore.fit.shape.center_mm = {-123.456, 234.567, -345.678};
  bore.fit.shape.axis = {-0.5774, 0.5774, -0.5774};
  bore.fit.shape.radius_mm = 61.7284;
  bore.fit.points = 1'234'567;
  report.features = {bore};
  report.feature_names = {"bore"};
  report.fields.pages = {ReportPage::Features};
  report.nominals = {NominalFace{123, bore.fit.shape}};
  const std::vector<std::pair<const char*, std::vector<const char*>>> wanted{
      {"en", {">feature<", ">cylinder,<", ">diameter,<", ">difference,<", ">nominal,<"}},
      {"de", {">Element<", ">Zylinder,<", ">Durchmesser,<", ">Differenz,<", ">Nennwert,<"}},
      {"it", {">elemento<", ">cilindro,<", ">diametro,<", ">differenza,<", ">nominale,<"}}};
  for (const auto& [language, words] : wanted) {
    report.fields.language = language;
    write_text_file(folder.path() / "r.html", html_of(report));
    const auto boxes = folder.path() / "boxes.html";
    const std::string command = "weasyprint " + (folder.path() / "r.html").string() + " " +
                                (folder.path() / "r.pdf").string() +
                                " 2> /dev/null && pdftotext -bbox " +
                                (folder.path() / "r.pdf").string() + " " + boxes.string();
    ASSERT_EQ(std::system(command.c_str()), 0);
    std::ifstream file(boxes);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    text.erase(0, text.rfind("<page "));
    for (const char* word : words)
      EXPECT_NE(text.find(word), std::string::npos) << word;
    for (const char* number : {">123.4568<", ">-345.678<", ">-0.5774<", ">1234567<"})
      EXPECT_NE(text.find(number), std::string::npos) << number;
    // No word runs into the next one of its line.
    static const std::regex kWord(
        R"re(xMin="([0-9.]+)" yMin="([0-9.]+)" xMax="([0-9.]+)" yMax="([0-9.]+)">(.*)</word>)re");
    std::vector<PrintedWord> found;
    for (std::sregex_iterator i(text.begin(), text.end(), kWord), end; i != end; ++i) {
      const PrintedWord box{std::stod((*i)[1]),
                            std::stod((*i)[2]) + 1.0,
                            std::stod((*i)[3]),
                            std::stod((*i)[4]) - 1.0};
      for (const PrintedWord& other : found)
        EXPECT_FALSE(overlap(box, other)) << (*i)[5];
      found.push_back(box);
    }
  }
}

}  // namespace
}  // namespace frangia

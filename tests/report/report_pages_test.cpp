// The sheets of a report: labels, the table of results, the head.
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/random.h"
#include "frangia/inspection/verdict_reasons.h"
#include "frangia/report/inspection_report.h"
#include "frangia/report/result_table.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::error_of;

/// A rectangle of a drawing.
struct Box {
  double x, y, width, height;
};

bool overlap(const Box& a, const Box& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

std::vector<Box> labels_of(const std::string& drawing) {
  static const std::regex kLabel(
      R"re(<rect class="label" x="([-0-9.]+)" y="([-0-9.]+)" width="([0-9.]+)" height="([0-9.]+)")re");
  std::vector<Box> boxes;
  for (std::sregex_iterator i(drawing.begin(), drawing.end(), kLabel), end; i != end; ++i) {
    const std::smatch& found = *i;
    boxes.push_back(
        {std::stod(found[1]), std::stod(found[2]), std::stod(found[3]), std::stod(found[4])});
  }
  return boxes;
}

ReportPicture random_picture(std::uint64_t seed) {
  ReportPicture picture;
  picture.caption = "picture";
  picture.picture = Image<Rgb>(kReportPictureWidth_px, kReportPictureHeight_px, Rgb{1, 2, 3});
  const auto uniform = [&](std::uint64_t i) { return uniform_from(hash(seed, i)); };
  const auto count = static_cast<std::uint64_t>(30.0 * uniform(0));
  // Half of the pictures have all places in one corner.
  const double spread = seed % 2 == 0 ? 1.0 : 0.1;
  for (std::uint64_t i = 0; i < count; ++i) {
    picture.labels.push_back(
        {"+0.1234 ± 0.0123",
         std::string(static_cast<std::size_t>(40.0 * uniform(3 * i + 1)), 'W'),
         Conformity::Out,
         {spread * 720.0 * uniform(3 * i + 2), 440.0 * (1.0 - spread * uniform(3 * i + 3))}});
  }
  return picture;
}

TEST(ReportPages, LabelsDoNotOverlapInRandomReports) {
  std::size_t labels = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const ReportPicture picture = random_picture(seed);
    const std::vector<Box> boxes = labels_of(labelled_picture(picture));
    EXPECT_EQ(boxes.size(), std::min<std::size_t>(picture.labels.size(), 12)) << seed;
    labels += boxes.size();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      // Within the drawing, and beside the picture.
      EXPECT_GE(boxes[i].y, 0.0);
      EXPECT_LE(boxes[i].y + boxes[i].height, 440.0 + 0.1);
      EXPECT_TRUE(boxes[i].x + boxes[i].width <= kLabelColumn_px ||
                  boxes[i].x >= kLabelColumn_px + 720.0);
      EXPECT_LE(boxes[i].x + boxes[i].width, 720.0 + 2.0 * kLabelColumn_px);
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_FALSE(overlap(boxes[i], boxes[k])) << seed;
    }
  }
  EXPECT_GT(labels, 300U);
}

/// What a person must read: the whole value, and the whole name where two lines hold it.
TEST(ReportPages, LabelsAreNotCut) {
  ReportPicture picture = random_picture(1);
  picture.labels = {
      {"-100.2345 ± 0.0123 mm", "Łożysko przednie, cylindryczność", Conformity::In, {9, 9}},
      {"+0.1 mm", "journal", Conformity::In, {9, 9}}};
  const std::string html = labelled_picture(picture);
  for (const char* text :
       {">-100.2345 ± 0.0123 mm<", ">Łożysko przednie,<", ">cylindryczność<", ">journal<"})
    EXPECT_NE(html.find(text), std::string::npos) << text;
  EXPECT_EQ(html.find("…"), std::string::npos);
  const std::vector<Box> boxes = labels_of(html);
  ASSERT_EQ(boxes.size(), 2U);
  EXPECT_EQ(boxes[0].height, 51.0);  // 38 and a line
  picture.labels.assign(40, {"12: cylinder", "", Conformity::In, {9, 9}});
  EXPECT_EQ(labels_of(labelled_picture(picture)).size(), 32U);  // a line each
}

TEST(ReportPages, ALabelStandsAtTheHeightOfItsPlaceWhereThereIsRoom) {
  std::vector<PictureLabel> labels(2);
  labels[0].at_px = {100.0, 300.0};
  labels[1].at_px = {600.0, 100.0};
  const auto boxes = place_labels(labels, 720.0, 440.0);
  ASSERT_EQ(boxes.size(), 2U);
  EXPECT_FALSE(boxes[0].right);
  EXPECT_NEAR(boxes[0].top_px, 300.0 - 19.0, 1e-9);
  EXPECT_TRUE(boxes[1].right);
  EXPECT_NEAR(boxes[1].top_px, 100.0 - 19.0, 1e-9);
}

MeasuredCharacteristic result(const std::string& name, double value, double u95 = 0.004) {
  MeasuredCharacteristic row;
  row.name = name;
  row.nominal = 10.0;
  row.limits = ToleranceLimits{9.9, 10.1};
  row.value = value;
  row.u95 = u95;
  row.conformity = conformity_of(value, u95 / 1.96, *row.limits);
  return row;
}

TEST(ReportPages, ShowTheWorstRowsFirst) {
  const auto rows = worst_first({result("good", 10.01),
                                 result("fair", 9.93),
                                 result("out", 10.2),
                                 result("open", 10.099),
                                 result("worse", 9.7)});
  std::string order;
  for (const auto& row : rows)
    order += row.name + " ";
  EXPECT_EQ(order, "worse out open fair good ");
  EXPECT_NEAR(tolerance_used(rows[3]), 0.7, 1e-9);
  MeasuredCharacteristic form;
  form.limits = ToleranceLimits{-std::numeric_limits<double>::infinity(), 0.02};
  form.value = 0.005;
  EXPECT_NEAR(tolerance_used(form), 0.25, 1e-9);
  InspectionReport report;
  for (int i = 0; i < 30; ++i)
    report.characteristics.push_back(result("d" + std::to_string(i), 10.0 + 0.001 * i));
  report.characteristics.push_back(result("worst", 10.5));
  report.pictures.push_back(random_picture(4));
  const std::string page = html_of(report);
  const auto sheet = page.find("class=\"sheet\"");
  EXPECT_LT(page.find("<td>worst</td>"), sheet);
  EXPECT_LT(page.find("<td>d29</td>"), sheet);
  EXPECT_GT(page.find("<td>d0</td>"), sheet);
  EXPECT_NE(page.find(" worst of 31 rows"), std::string::npos);
}

TEST(ReportPages, SayWhyARowIsUndecidedWhoseIntervalIsWithin) {
  InspectionReport report;
  report.characteristics.push_back(result("profile", 10.0));
  report.characteristics.back().conformity = Conformity::Undecided;
  report.characteristics.back().reason = "undecided: 20.0 % was not measured & more";
  const std::string page = html_of(report);
  EXPECT_NE(page.find("undecided: 20.0 % was not measured &amp; more"), std::string::npos);
}

TEST(ReportPages, NameTheFeaturesOfThePlan) {
  InspectionReport report;
  report.features.resize(2);
  report.feature_names = {"datum <A>", ""};
  const std::string page = html_of(report);
  EXPECT_NE(page.find("<td>datum &lt;A&gt;: plane</td>"), std::string::npos);
  EXPECT_NE(page.find("<td>plane</td>"), std::string::npos);
}

TEST(ReportPages, DrawTheToleranceThatAValueUses) {
  // The limits stand at 32 and 128 of 160.
  EXPECT_NE(tolerance_bar(result("", 10.0)).find("cx=\"80.00\""), std::string::npos);
  EXPECT_NE(tolerance_bar(result("", 10.1)).find("cx=\"128.00\""), std::string::npos);
  EXPECT_NE(tolerance_bar(result("", 10.0, 0.05)).find("M56.00 10H104.00"), std::string::npos);
  const std::string beyond = tolerance_bar(result("", 12.0));
  EXPECT_EQ(beyond.find("circle"), std::string::npos);
  EXPECT_NE(beyond.find("M159 10L149 4"), std::string::npos) << beyond;
  MeasuredCharacteristic lost = result("", 0.0);
  lost.value = kMissing;
  EXPECT_EQ(tolerance_bar(lost), "");
}

TEST(ReportPages, BeginWithPartVerdictAndReason) {
  InspectionReport report;
  report.part = "flange";
  report.fields = {.drawing = "D-17 rev B",
                   .order = "4711",
                   .serial = "SN <9>",
                   .customer = "Müller & Co",
                   .inspector = "A. Smith",
                   .date = "2026-11-26",
                   .paper = "Letter",
                   .logo = {}};
  report.logo = ReportLogo{"image/png", {'a', 'b', 'c'}};
  report.reference = "flange.step";
  report.surface.emplace();
  report.surface->conformity = Conformity::In;
  report.surface->coverage = 0.973;
  report.deviation.emplace();
  report.deviation->median_u_mm = 0.01;
  const std::string page = html_of(report);
  const std::string cover = page.substr(0, page.find("class=\"sheet\""));
  for (const char* text : {"flange",
                           "D-17 rev B",
                           "4711",
                           "SN &lt;9&gt;",
                           "Müller &amp; Co",
                           "A. Smith",
                           "2026-11-26",
                           "flange.step",
                           ">signature<",
                           "data:image/png;base64,YWJj",
                           "In tolerance",
                           "surface: in, over 97.3 % of the nominal area"})
    EXPECT_NE(cover.find(text), std::string::npos) << text;
  EXPECT_NE(page.find("@page{size:Letter"), std::string::npos);
  EXPECT_NE(page.find("SN \\3c 9\\3e "), std::string::npos);  // at the head of each sheet
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("display:grid"), std::string::npos);
}

/// A report with something on each of its pages.
InspectionReport full_report() {
  InspectionReport report;
  report.part = "flange";
  report.surface.emplace();
  report.surface->places.push_back({});
  report.deviation.emplace();
  report.thickness.emplace();
  for (std::uint64_t i = 0; i < 2; ++i)
    report.pictures.push_back(random_picture(i));
  for (int i = 0; i < 60; ++i)
    report.characteristics.push_back({.name = fmt::format("row {}", i), .limits = {{0.0, 1.0}}});
  report.sections.push_back({.name = "middle"});
  report.features.emplace_back();
  return report;
}

TEST(ReportPages, AreThoseThatThePlanNames) {
  const std::map<ReportPage, std::string> headings{
      {ReportPage::Results, "Results, the worst first"},
      {ReportPage::Pictures, "<h2>Pictures"},
      {ReportPage::Places, "Places that are out, undecided or not measured"},
      {ReportPage::Thickness, "Thickness of the walls"},
      {ReportPage::Sections, "<h2>Sections"},
      {ReportPage::Features, "Features that were found"},
      {ReportPage::Annex, "<h1>Annex"}};
  InspectionReport report = full_report();
  const std::string all = html_of(report);
  EXPECT_NE(all.find("all of them follow"), std::string::npos);
  for (const auto& [page, heading] : headings) {
    EXPECT_NE(all.find(heading), std::string::npos) << heading;
    report.fields.pages = {page};
    const std::string one = html_of(report);
    for (const auto& [other, text] : headings)
      EXPECT_EQ(one.find(text) != std::string::npos, other == page) << heading << ": " << text;
  }
  // The first sheet alone, without an empty one behind it.
  report.fields.pages.emplace();
  report.warnings.assign(5, "the part moved");
  const std::string cover = html_of(report);
  EXPECT_EQ(cover.find("class=\"sheet\""), std::string::npos);
  EXPECT_NE(cover.find("the JSON beside this report lists all"), std::string::npos);
  EXPECT_NE(cover.find("2 more warnings: see the JSON beside this report."), std::string::npos);
}

/// The text of a sheet of a report, as WeasyPrint prints it.
std::string printed_sheet(const std::filesystem::path& pdf, int sheet) {
  const auto text = pdf.parent_path() / "sheet.txt";
  const std::string command = "pdftotext -layout -f " + std::to_string(sheet) + " -l " +
                              std::to_string(sheet) + " " + pdf.string() + " " + text.string();
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::ifstream file(text);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ReportPages, ArePrintedWithTheVerdictOnTheFirstSheetAndRepeatedHeads) {
  if (std::system("command -v weasyprint pdftotext > /dev/null") != 0)
    GTEST_SKIP() << "needs weasyprint and pdftotext (packages weasyprint, poppler-utils)";
  const testing::TemporaryFolder folder;
  InspectionReport report;
  report.part = "flange";
  report.created = "2026-11-26";
  report.fields.serial = "0017";
  for (int i = 0; i < 100; ++i)
    report.characteristics.push_back(result("diameter " + std::to_string(i), 10.0 + 0.0005 * i));
  report.characteristics.push_back(result("worst", 10.5));
  ReportPicture picture = random_picture(4);
  picture.picture = Image<Rgb>(72, 44, Rgb{90, 90, 90});
  report.pictures = {picture, picture};
  write_text_file(folder.path() / "r.html", html_of(report));
  const auto pdf = folder.path() / "r.pdf";
  const std::string command =
      "weasyprint " + (folder.path() / "r.html").string() + " " + pdf.string() + " 2> /dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string first = printed_sheet(pdf, 1);
  for (const char* text :
       {"flange", "0017", "Out of tolerance", "worst", " worst of 101", "page 1 of"})
    EXPECT_NE(first.find(text), std::string::npos) << text << first;
  for (const int sheet : {2, 3}) {
    const std::string next = printed_sheet(pdf, sheet);
    EXPECT_NE(next.find("Inspection report: flange, 0017"), std::string::npos) << next;
    EXPECT_NE(next.find("deviation"), std::string::npos) << next;
  }
}

/// However long the name of a part is, the first sheet ends with the rule of its decisions, and the
/// heads of the others are one line.
TEST(ReportPages, BeginWithOneSheetHoweverLongTheNameOfThePartIs) {
  if (std::system("command -v weasyprint pdftotext > /dev/null") != 0)
    GTEST_SKIP() << "needs weasyprint and pdftotext (packages weasyprint, poppler-utils)";
  const testing::TemporaryFolder folder;
  InspectionReport report;
  for (int i = 0; i < 40; ++i)
    report.part += "Flansch mit Ä&<b>";
  report.part += " ENDE";
  report.fields.customer = "a customer whose name fills a line and a half of the head";
  for (int i = 0; i < 30; ++i)
    report.characteristics.push_back(result("diameter " + std::to_string(i), 10.0 + 0.0005 * i));
  ReportPicture picture = random_picture(4);
  picture.picture = Image<Rgb>(72, 44, Rgb{90, 90, 90});
  report.pictures = {picture};
  write_text_file(folder.path() / "r.html", html_of(report));
  const auto pdf = folder.path() / "r.pdf";
  const std::string command =
      "weasyprint " + (folder.path() / "r.html").string() + " " + pdf.string() + " 2> /dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string first = printed_sheet(pdf, 1);
  for (const char* text : {"ENDE", "Decision rule", "its U95."})
    EXPECT_NE(first.find(text), std::string::npos) << text << first;
  const std::string second = printed_sheet(pdf, 2);
  EXPECT_NE(second.find("Results, the worst first"), std::string::npos) << second;
  EXPECT_EQ(second.find("ENDE"), std::string::npos) << second;
  EXPECT_NE(second.find("…"), std::string::npos) << second;
}

/// Names of any language, and words of the widest, within the sheet.
TEST(ReportPages, ArePrintedWithinTheMarginsInEveryLanguage) {
  if (std::system("command -v weasyprint pdftotext > /dev/null") != 0)
    GTEST_SKIP() << "needs weasyprint and pdftotext (packages weasyprint, poppler-utils)";
  const testing::TemporaryFolder folder;
  InspectionReport report;
  report.part = "Вал Άξονας";
  report.fields.inspector = "Şükrü Łoś";
  report.fields.serial = "⌀ ± Ωж";
  report.characteristics = {result("Łożysko ⌀ ğ", kMissing), result("B", 10.0)};
  for (const char* language : {"de", "it", "en"}) {
    report.fields.language = language;
    write_text_file(folder.path() / "r.html", html_of(report));
    const auto pdf = folder.path() / "r.pdf";
    const auto boxes = folder.path() / "boxes.html";
    const std::string command = "weasyprint " + (folder.path() / "r.html").string() + " " +
                                pdf.string() + " 2> /dev/null && pdftotext -bbox " + pdf.string() +
                                " " + boxes.string() + " && pdffonts " + pdf.string() + " > " +
                                (folder.path() / "fonts.txt").string();
    ASSERT_EQ(std::system(command.c_str()), 0);
    std::ifstream file(boxes);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (const char* word : {">Вал<", ">Άξονας<", ">Şükrü<", ">Łoś<", ">⌀<", ">Ωж<", ">ğ<"})
      EXPECT_NE(text.find(word), std::string::npos) << word;
    // Between margins of 14 mm of A4.
    static const std::regex kWord(R"re(xMin="([0-9.]+)".* xMax="([0-9.]+)".*>(.*)</word>)re");
    for (std::sregex_iterator i(text.begin(), text.end(), kWord), end; i != end; ++i) {
      EXPECT_GE(std::stod((*i)[1]), 39.0) << (*i)[3];
      EXPECT_LE(std::stod((*i)[2]), 556.0) << (*i)[3];
    }
    // One family of letters: what it lacks would come from another one, or be a box.
    std::ifstream fonts(folder.path() / "fonts.txt");
    std::string line;
    for (int i = 0; std::getline(fonts, line); ++i) {
      const bool is_head = i < 2;
      EXPECT_TRUE(is_head || line.find("DejaVu") != std::string::npos) << line;
    }
  }
}

TEST(ReportLogo, MustBeAPicture) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "logo.txt";
  std::ofstream(path) << "our company";
  EXPECT_NE(error_of([&] {
              static_cast<void>(read_logo(path));
            }).find("logo.txt: the logo of a report must be a PNG or JPEG picture"),
            std::string::npos);
}

/// The head of a PNG is no picture.
TEST(ReportLogo, IsRefusedWhenItIsCutShort) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "logo.png";
  std::ofstream(path, std::ios::binary) << "\x89PNG\r\n\x1A\n and no more";
  const std::string refused = testing::error_of([&] { static_cast<void>(read_logo(path)); });
  EXPECT_NE(refused.find("logo.png"), std::string::npos) << refused;
}

}  // namespace
}  // namespace frangia

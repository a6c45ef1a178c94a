#include "frangia/page/html_page.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/base64.h"
#include "frangia/core/text.h"
#include "frangia/frames/encode_picture.h"

namespace frangia {
namespace {

constexpr const char* kPageStyle = R"(
body{font:10pt/1.4 "DejaVu Sans",system-ui,sans-serif;margin:2em auto;max-width:190mm;padding:0 1em;color:#1c2126}
h1{font-size:17pt;margin:0 0 .3em}
h2{font-size:12pt;margin:1.5em 0 .4em;border-bottom:1.5pt solid #c8ced6;break-after:avoid}
p{margin:.4em 0}
table{border-collapse:collapse;margin:.5em 0;font-variant-numeric:tabular-nums;font-size:8.5pt}
thead{display:table-header-group}tr{break-inside:avoid}
td,th{padding:.22em .6em;border-bottom:.5pt solid #d8dce2;text-align:right;vertical-align:top}
td:first-child,th:first-child{text-align:left;overflow-wrap:anywhere}
th{background:#eef0f4;font-weight:600;vertical-align:bottom}
table.facts{width:100%;table-layout:fixed}table.facts td{text-align:left;overflow-wrap:anywhere}
table.facts td:first-child{width:27%;color:#5a6470}
table.short{break-inside:avoid}
table.fixed{width:100%;table-layout:fixed}
.fixed td,.fixed th{padding-left:.25em;padding-right:.25em;box-sizing:border-box}.fixed th{font-size:7pt}
.signature{width:100%;table-layout:fixed;margin:11mm 0 0}
.signature td{border:0;border-top:.5pt solid #5a6470;padding:.2em 0 0;text-align:left;color:#5a6470}
.signature .space{width:6%;border:0}
.in{color:#0a6b2d;font-weight:600}.out{color:#b00020;font-weight:600}.undecided{color:#8a5a00;font-weight:600}
.verdict{padding:.45em .8em;border-left:4pt solid #888;background:#f4f4f6;break-inside:avoid}
.good{border-color:#0a8a3d;background:#eaf6ee}.bad{border-color:#b00020;background:#fbeaec}
.open{border-color:#d99000;background:#fdf5e4}
figure{margin:.6em 0;break-inside:avoid}figcaption{font-size:8.5pt;color:#5a6470;margin-top:.2em}
figure img,figure svg{width:100%;height:auto;display:block}
.row figure{display:inline-block;width:48.5%;margin-right:1%;vertical-align:top}
.row figure svg{max-height:95mm}
.brand{width:100%;margin:0}.brand td{border:0;padding:0;vertical-align:middle}
.brand img{max-height:16mm;max-width:60mm}.brand td:last-child{text-align:right;color:#5a6470}
.fields{width:100%;table-layout:fixed;margin:.4em 0 .7em;font-size:9pt}
.fields td{box-sizing:border-box;text-align:left;overflow-wrap:anywhere;padding:.2em .4em}
.fields .name{color:#5a6470;width:15%}.fields .fact{width:35%}
.signal{width:100%;margin:.3em 0 .6em}.signal td{border:0;text-align:left;vertical-align:middle}
.signal .lamps{width:13mm;padding:.5em 0 .5em .8em}.signal .lamps svg{width:10mm;height:26mm;display:block}
.signal .word{font-size:15pt;font-weight:700}
.results{width:100%;table-layout:fixed}
.results td,.results th{box-sizing:border-box;padding-left:.25em;padding-right:.25em}
.results th{overflow-wrap:normal;font-size:7.5pt}.results th:first-child{width:19%}
.results .unit{width:4.6%}.results .value{width:9.3%}.results .deviation{width:11.4%}
.results .u95{width:7.1%}.results .limits{width:11%}
.results td.limits{white-space:nowrap}
.results td.why{color:#5a6470;text-align:left}
.results .bar{width:13%}.results .decision{width:15.3%}
.results svg{width:22mm;height:2.75mm;display:block;margin-left:auto}
.lead{break-after:avoid}
td.bad{color:#b00020;font-weight:600}
.small{font-size:8pt;color:#5a6470}
.labelled{position:relative;width:100%}
.labelled img{position:absolute;left:16.0377%;top:0;width:67.9245%;height:100%}
.labelled svg{position:absolute;left:0;top:0;width:100%;height:100%}
.labelled .frame{width:100%}
.sheet{break-before:page}
code{overflow-wrap:anywhere}
@media print{body{margin:0;max-width:none;padding:0}}
)";

constexpr std::string_view kSheet = "<div class=\"sheet\"></div>\n";

/// Text as a string of CSS within an element `style`.
std::string css_string(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const bool plain = c != '"' && c != '\\' && c != '<' && c != '>' && c != '&' &&
                       static_cast<unsigned char>(c) >= 0x20U;
    quoted += plain ? std::string(1, c)
                    : fmt::format("\\{:x} ", static_cast<unsigned>(static_cast<unsigned char>(c)));
  }
  return quoted + "\"";
}

std::string translated(const HtmlPaper& paper, std::string_view english) {
  return paper.words ? paper.words(english) : std::string(english);
}

std::string sheet_style(const HtmlPaper& paper) {
  constexpr const char* kMargin = "font:8pt \"DejaVu Sans\",sans-serif;color:#5a6470;";
  return fmt::format(
      "@page{{size:{0};margin:18mm 14mm 16mm;"
      "@top-left{{content:{1};{3}}}"
      "@bottom-left{{content:{2};{3}}}"
      "@bottom-right{{content:{4} counter(page) {5} counter(pages);{3}}}}}\n"
      "@page:first{{margin-top:12mm;@top-left{{content:none}}}}\n",
      paper.size,
      css_string(paper.head),
      css_string(paper.foot),
      kMargin,
      css_string(translated(paper, "page") + " "),
      css_string(" " + translated(paper, "of") + " "));
}

/// A cell with the class of its decision, so that it is colored.
std::string cell_of(const std::string& text) {
  const bool decision = text == "in" || text == "out" || text == "undecided";
  return decision ? fmt::format("<td class=\"{}\">{}</td>", text, text)
                  : fmt::format("<td>{}</td>", html_escaped(text));
}

}  // namespace

HtmlPage::HtmlPage(std::string_view title, HtmlPaper paper, bool show_title)
    : title_(html_escaped(title)), paper_(std::move(paper)) {
  if (show_title) body_ = fmt::format("<h1>{}</h1>\n", title_);
}

std::string HtmlPage::word(std::string_view english) const {
  return html_escaped(translated(paper_, english));
}

void HtmlPage::heading(std::string_view text) {
  body_ += fmt::format("<h2>{}</h2>\n", word(text));
}

void HtmlPage::paragraph(std::string_view text) {
  body_ += fmt::format("<p>{}</p>\n", word(text));
}

void HtmlPage::verdict(std::string_view kind, std::string_view text) {
  body_ += fmt::format("<p class=\"verdict {}\">{}</p>\n", kind, word(text));
}

void HtmlPage::table(const std::vector<std::string>& columns,
                     const std::vector<std::vector<std::string>>& rows,
                     const std::vector<double>& shares) {
  // Without names a table lists facts.
  const bool named = std::any_of(
      columns.begin(), columns.end(), [](const auto& column) { return !column.empty(); });
  constexpr std::size_t kShort = 12;  // rows: such a table stays on one page
  const char* const classes = rows.size() <= kShort ? " short" : "";
  body_ += fmt::format("<table class=\"{}{}{}\">",
                       named ? "list" : "facts",
                       classes,
                       shares.empty() ? "" : " fixed");
  if (!shares.empty()) body_ += "<colgroup>";
  for (const double share : shares)
    body_ += fmt::format("<col style=\"width:{:.4g}%\">", 100.0 * share);
  if (!shares.empty()) body_ += "</colgroup>";
  if (named) {
    body_ += "<thead><tr>";
    for (const std::string& column : columns)
      body_ += fmt::format("<th>{}</th>", word(column));
    body_ += "</tr></thead>";
  }
  body_ += "<tbody>\n";
  for (const auto& row : rows) {
    body_ += "<tr>";
    for (const std::string& text : row)
      body_ += cell_of(text);
    body_ += "</tr>\n";
  }
  body_ += "</tbody></table>\n";
}

void HtmlPage::begin_figures() {
  body_ += "<div class=\"row\">\n";
}

void HtmlPage::picture(const Image<Rgb>& picture, std::string_view caption) {
  body_ +=
      fmt::format("<figure><img alt=\"{0}\" src=\"{1}\"><figcaption>{0}</figcaption></figure>\n",
                  word(caption),
                  data_uri("image/png", encode_picture(picture)));
}

void HtmlPage::drawing(const std::string& svg, std::string_view caption) {
  body_ += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", svg, word(caption));
}

void HtmlPage::end_figures() {
  body_ += "</div>\n";
}

void HtmlPage::html(const std::string& fragment) {
  body_ += fragment;
}

void HtmlPage::new_sheet() {
  if (!body_.ends_with(kSheet)) body_ += kSheet;
}

std::string HtmlPage::text() const {
  std::string_view body = body_;
  if (body.ends_with(kSheet)) body.remove_suffix(kSheet.size());
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"{}\"><head><meta charset=\"utf-8\"><title>{}</title>"
      "<style>{}{}</style></head><body>\n{}</body></html>\n",
      paper_.language,
      title_,
      kPageStyle,
      sheet_style(paper_),
      body);
}

std::string data_uri(std::string_view media_type, const std::vector<char>& bytes) {
  return fmt::format("data:{};base64,{}", media_type, encode_base64({bytes.data(), bytes.size()}));
}

}  // namespace frangia

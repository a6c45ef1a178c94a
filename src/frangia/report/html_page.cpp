#include "frangia/report/html_page.h"

#include <cstdint>

#include <fmt/format.h>

#include "frangia/core/html_escaped.h"
#include "frangia/frames/encode_picture.h"

namespace frangia {
namespace {

constexpr const char* kPageStyle = R"(<style>
body{font:14px/1.45 system-ui,sans-serif;margin:2em auto;max-width:1120px;padding:0 1em;color:#222}
h1{font-size:24px;margin-bottom:.2em}h2{font-size:17px;margin:1.6em 0 .4em;border-bottom:2px solid #ccd}
table{border-collapse:collapse;margin:.6em 0;font-variant-numeric:tabular-nums}
td,th{padding:.2em .8em;border-bottom:1px solid #ddd;text-align:right;vertical-align:top}
td:first-child,th:first-child{text-align:left}th{background:#f2f3f6}
.in{color:#0a6b2d;font-weight:600}.out{color:#b00020;font-weight:600}.undecided{color:#8a5a00;font-weight:600}
.verdict{padding:.5em .9em;border-left:6px solid #888;background:#f4f4f6;font-size:17px}
.good{border-color:#0a8a3d;background:#eaf6ee}.bad{border-color:#b00020;background:#fbeaec}
.open{border-color:#d99000;background:#fdf5e4}
.row{display:flex;flex-wrap:wrap;gap:1em}figure{margin:0;break-inside:avoid}
figcaption{font-size:13px;color:#555}figure img{width:540px;max-width:100%;height:auto}
code{overflow-wrap:anywhere}@media print{body{margin:0;max-width:none}h2{break-after:avoid}}
@page{size:A4;margin:14mm}
</style>)";

std::string base64_text(const std::vector<char>& bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(bytes.size() / 3 * 4 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t block = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool has = i + k < bytes.size();
      block = block << 8U | (has ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? kDigits[block >> (18U - 6U * k) & 63U] : '=';
  }
  return text;
}

/// A cell with the class of its decision, so that it is colored.
std::string cell_of(const std::string& text) {
  const bool decision = text == "in" || text == "out" || text == "undecided";
  return decision ? fmt::format("<td class=\"{}\">{}</td>", text, text)
                  : fmt::format("<td>{}</td>", html_escaped(text));
}

}  // namespace

HtmlPage::HtmlPage(std::string_view title) : title_(html_escaped(title)) {
  body_ = fmt::format("<h1>{}</h1>\n", title_);
}

void HtmlPage::heading(std::string_view text) {
  body_ += fmt::format("<h2>{}</h2>\n", html_escaped(text));
}

void HtmlPage::paragraph(std::string_view text) {
  body_ += fmt::format("<p>{}</p>\n", html_escaped(text));
}

void HtmlPage::verdict(std::string_view kind, std::string_view text) {
  body_ += fmt::format("<p class=\"verdict {}\">{}</p>\n", kind, html_escaped(text));
}

void HtmlPage::table(const std::vector<std::string>& columns,
                     const std::vector<std::vector<std::string>>& rows) {
  body_ += "<table><tr>";
  for (const std::string& column : columns)
    body_ += fmt::format("<th>{}</th>", html_escaped(column));
  body_ += "</tr>\n";
  for (const auto& row : rows) {
    body_ += "<tr>";
    for (const std::string& text : row)
      body_ += cell_of(text);
    body_ += "</tr>\n";
  }
  body_ += "</table>\n";
}

void HtmlPage::begin_figures() {
  body_ += "<div class=\"row\">\n";
}

void HtmlPage::picture(const Image<Rgb>& picture, std::string_view caption) {
  body_ += fmt::format(
      "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption>"
      "</figure>\n",
      html_escaped(caption),
      base64_text(encode_picture(picture)));
}

void HtmlPage::drawing(const std::string& svg, std::string_view caption) {
  body_ +=
      fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", svg, html_escaped(caption));
}

void HtmlPage::end_figures() {
  body_ += "</div>\n";
}

std::string HtmlPage::text() const {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}</title>{}"
      "</head><body>\n{}</body></html>\n",
      title_,
      kPageStyle,
      body_);
}

}  // namespace frangia

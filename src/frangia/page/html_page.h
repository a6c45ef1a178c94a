#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "frangia/core/image.h"
#include "frangia/frames/png.h"

namespace frangia {

/// What translates the texts of a page into the language of its reader.
using PageWords = std::function<std::string(std::string_view)>;

/// Size of the paper that a page is printed on, and what stands on each sheet.
struct HtmlPaper {
  std::string size = "A4";      ///< A4 or Letter
  std::string head;             ///< at the top of every sheet but the first
  std::string foot;             ///< at the bottom of every sheet, beside its number
  std::string language = "en";  ///< its code, as the attribute lang
  PageWords words;              ///< for texts in English; none: they stay
};

/// A page of HTML without references to other files, scripts or layout grids, which a browser shows
/// and WeasyPrint prints. Texts are escaped.
/// Headings, paragraphs, captions and names of columns are translated by the words of the paper;
/// cells may hold names, and stay.
class HtmlPage {
 public:
  /// A page with a title; `show_title`: as its first heading, too.
  explicit HtmlPage(std::string_view title, HtmlPaper paper = {}, bool show_title = true);

  void heading(std::string_view text);    ///< of a section
  void paragraph(std::string_view text);  ///< plain text
  /// A line that stands out: `kind` is "good", "bad" or "open".
  void verdict(std::string_view kind, std::string_view text);
  /// A table; a cell that is in, out or undecided is colored. Its head is repeated on each sheet.
  /// `shares` are the widths of the columns, of that of the sheet; empty: as their texts need.
  ///
  /// @shape    each row has one cell for each column, and `shares` one number
  void table(const std::vector<std::string>& columns,
             const std::vector<std::vector<std::string>>& rows,
             const std::vector<double>& shares = {});
  void begin_figures();  ///< figures until `end_figures` stand side by side
  /// A picture, as PNG within the page.
  void picture(const Image<Rgb>& picture, std::string_view caption);
  /// A drawing in SVG, taken over as it is.
  void drawing(const std::string& svg, std::string_view caption);
  void end_figures();                      ///< see `begin_figures`
  void html(const std::string& fragment);  ///< HTML, taken over as it is
  void new_sheet();                        ///< what follows begins a sheet; nothing: none is added

  /// A text in the language of the page, for `html`; escaped.
  [[nodiscard]] std::string word(std::string_view english) const;

  /// The finished page.
  [[nodiscard]] std::string text() const;

 private:
  std::string body_;
  std::string title_;
  HtmlPaper paper_;
};

/// Bytes as the data of an `img` element: "data:image/png;base64,...".
[[nodiscard]] std::string data_uri(std::string_view media_type, const std::vector<char>& bytes);

}  // namespace frangia

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frangia/core/image.h"
#include "frangia/frames/png.h"

namespace frangia {

/// A page of HTML without references to other files. Texts are escaped.
class HtmlPage {
 public:
  /// A page with a title and nothing else.
  explicit HtmlPage(std::string_view title);

  void heading(std::string_view text);    ///< of a section
  void paragraph(std::string_view text);  ///< plain text
  /// A line that stands out: `kind` is "good", "bad" or "open".
  void verdict(std::string_view kind, std::string_view text);
  /// A table; a cell that is in, out or undecided is colored.
  ///
  /// @shape    each row has one cell for each column
  void table(const std::vector<std::string>& columns,
             const std::vector<std::vector<std::string>>& rows);
  void begin_figures();  ///< figures until `end_figures` stand side by side
  /// A picture, as PNG within the page.
  void picture(const Image<Rgb>& picture, std::string_view caption);
  /// A drawing in SVG, taken over as it is.
  void drawing(const std::string& svg, std::string_view caption);
  void end_figures();  ///< see `begin_figures`

  /// The finished page.
  [[nodiscard]] std::string text() const;

 private:
  std::string body_;
  std::string title_;
};

}  // namespace frangia

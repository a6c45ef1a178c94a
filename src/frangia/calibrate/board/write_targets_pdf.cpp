#include "frangia/calibrate/board/write_targets_pdf.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "frangia/calibrate/board/internal/pdf_page.h"
#include "frangia/core/error.h"
#include "frangia/rig/aruco_dictionary.h"

namespace frangia {
namespace {

constexpr double kGap_mm = 4.0;  // between stickers, with the code of each

/// The circle to cut along, with ground for a fifth of the print on each side.
double cut_mm(const TargetSet& targets, bool coded) {
  constexpr double kGround = 1.4;
  const double printed = coded ? std::sqrt(2.0) * targets.marker_mm : kGround * targets.diameter_mm;
  return std::max({printed * (coded ? 1.1 : 1.0), targets.sticker_mm});
}

void fill_circle(HPDF_Page page, double x_mm, double y_mm, double diameter_mm, float grey) {
  HPDF_Page_SetGrayFill(page, grey);
  HPDF_Page_Circle(page, pdf_points(x_mm), pdf_points(y_mm), pdf_points(0.5 * diameter_mm));
  HPDF_Page_Fill(page);
  HPDF_Page_SetGrayFill(page, 0.0F);
}

void draw_disc(HPDF_Page page, const TargetSet& targets, double x_mm, double y_mm) {
  const bool light = targets.tone == TargetTone::Light;
  if (light) fill_circle(page, x_mm, y_mm, cut_mm(targets, false), 0.0F);
  fill_circle(page, x_mm, y_mm, targets.diameter_mm, light ? 1.0F : 0.0F);
}

void draw_marker(HPDF_Page page, const TargetSet& targets, int code, double x_mm, double y_mm) {
  const int cells = find_aruco_dictionary(targets.dictionary).value().cells + 2;
  const double cell_mm = targets.marker_mm / cells;
  const double half_mm = 0.5 * targets.marker_mm;
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const double right_mm = column * cell_mm - half_mm;
      const double down_mm = row * cell_mm - half_mm;
      if (!is_target_dark(targets, code, right_mm + 0.5 * cell_mm, down_mm + 0.5 * cell_mm))
        continue;
      HPDF_Page_Rectangle(page,
                          pdf_points(x_mm + right_mm),
                          pdf_points(y_mm - down_mm - cell_mm),
                          pdf_points(cell_mm),
                          pdf_points(cell_mm));
      HPDF_Page_Fill(page);
    }
  }
}

void draw_cut(HPDF_Page page, double x_mm, double y_mm, double diameter_mm) {
  constexpr float kGrey = 0.7F;
  HPDF_Page_SetLineWidth(page, pdf_points(0.1));
  HPDF_Page_SetGrayStroke(page, kGrey);
  HPDF_Page_Circle(page, pdf_points(x_mm), pdf_points(y_mm), pdf_points(0.5 * diameter_mm));
  HPDF_Page_Stroke(page);
  HPDF_Page_SetGrayStroke(page, 0.0F);
}

std::string table_text(const TargetSet& targets) {
  std::string text = "[targets]";
  if (targets.diameter_mm > 0.0) {
    text += fmt::format(
        "   diameter_mm = {:g}   disc = \"{}\"", targets.diameter_mm, name_of(targets.tone));
  }
  if (!targets.dictionary.empty()) {
    text += fmt::format(
        "   dictionary = \"{}\"   marker_mm = {:g}", targets.dictionary, targets.marker_mm);
  }
  return text;
}

}  // namespace

PrintedTargets write_targets_pdf(const std::filesystem::path& path,
                                 const TargetSet& targets,
                                 std::size_t discs,
                                 std::size_t coded,
                                 int first_code,
                                 const PaperSize& paper) {
  check_targets(targets);
  if (coded > 0) {
    const int markers = find_aruco_dictionary(targets.dictionary).value().markers;
    if (first_code + static_cast<int>(coded) > markers) {
      throw Error(
          ErrorKind::Input,
          fmt::format("{} has the codes 0 to {}, not {} from {} on; take a larger dictionary",
                      targets.dictionary,
                      markers - 1,
                      coded,
                      first_code));
    }
  }
  const PdfDocument document = new_pdf();
  HPDF_Page page = nullptr;
  PrintedTargets printed{discs, coded, 0};
  double x_mm = 0.0;
  double y_mm = 0.0;
  for (std::size_t i = 0; i < discs + coded; ++i) {
    const bool is_coded = i >= discs;
    const double size_mm = cut_mm(targets, is_coded);
    const double step_mm = size_mm + kGap_mm;
    const double left_mm = kPdfMargin_mm + 0.5 * size_mm;
    const double least_mm = kPdfMargin_mm + kPdfFoot_mm + 0.5 * step_mm;
    if (size_mm > paper.width_mm - 2.0 * kPdfMargin_mm ||
        step_mm > paper.height_mm - 2.0 * kPdfMargin_mm - kPdfFoot_mm) {
      throw Error(ErrorKind::Input,
                  fmt::format("a sticker of {:g} mm does not fit on paper of {:g} x {:g} mm",
                              size_mm,
                              paper.width_mm,
                              paper.height_mm));
    }
    const bool new_row =
        i == 0 || i == discs || x_mm + step_mm + 0.5 * size_mm > paper.width_mm - kPdfMargin_mm;
    if (new_row) {
      x_mm = left_mm;
      y_mm -= i == discs ? std::max(step_mm, cut_mm(targets, false) + kGap_mm) : step_mm;
    } else {
      x_mm += step_mm;
    }
    if (page == nullptr || y_mm < least_mm) {
      page = add_pdf_page(document, paper);
      ++printed.pages;
      draw_pdf_ruler(page);
      const double text_mm = kPdfMargin_mm + kPdfRuler_mm + 4.0;
      write_pdf_line(
          document,
          page,
          text_mm,
          kPdfMargin_mm + 4.0,
          fmt::format("The ruler is {:g} mm long. Print at 100 %; otherwise measure it and "
                      "scale the sizes by the ratio.",
                      kPdfRuler_mm));
      write_pdf_line(document, page, text_mm, kPdfMargin_mm, table_text(targets));
      y_mm = paper.height_mm - kPdfMargin_mm - 0.5 * size_mm;
      x_mm = left_mm;
    }
    if (is_coded) {
      const int code = first_code + static_cast<int>(i - discs);
      draw_marker(page, targets, code, x_mm, y_mm);
      write_pdf_line(document,
                     page,
                     x_mm - 0.5 * size_mm,
                     y_mm - 0.5 * size_mm - 2.5,
                     fmt::format("{}", code));
    } else {
      draw_disc(page, targets, x_mm, y_mm);
    }
    draw_cut(page, x_mm, y_mm, size_mm);
  }
  require(page != nullptr, "there is no target to print; ask for one at least");
  save_pdf(document, path);
  return printed;
}

}  // namespace frangia

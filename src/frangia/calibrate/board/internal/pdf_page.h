#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <type_traits>

#include <hpdf.h>

#include "frangia/calibrate/board/write_board_pdf.h"

namespace frangia {

inline constexpr double kPdfMargin_mm = 8.0;   ///< printers leave up to 6 mm white
inline constexpr double kPdfRuler_mm = 100.0;  ///< length of the ruler that shows the true scale
inline constexpr double kPdfFoot_mm = 16.0;    ///< height of the ruler and the text below the print

/// A document of libharu.
using PdfDocument = std::unique_ptr<std::remove_pointer_t<HPDF_Doc>, void (*)(HPDF_Doc)>;

/// A length in points of PDF.
[[nodiscard]] float pdf_points(double mm);

[[nodiscard]] PdfDocument new_pdf();

/// A page of this size, with its origin at the bottom left.
[[nodiscard]] HPDF_Page add_pdf_page(const PdfDocument& document, const PaperSize& paper);

/// The ruler, in the bottom left corner.
void draw_pdf_ruler(HPDF_Page page);

void write_pdf_line(const PdfDocument& document,
                    HPDF_Page page,
                    double left_mm,
                    double bottom_mm,
                    const std::string& text);

/// Writes the file, complete or not at all.
///
/// @errors   Error(Numeric) when libharu fails, Error(File) when it cannot be written
void save_pdf(const PdfDocument& document, const std::filesystem::path& path);

}  // namespace frangia

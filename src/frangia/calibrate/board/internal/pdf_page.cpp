#include "frangia/calibrate/board/internal/pdf_page.h"

#include <vector>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"

namespace frangia {

float pdf_points(double mm) {
  constexpr double kPointsPerMm = 72.0 / 25.4;
  return static_cast<float>(mm * kPointsPerMm);
}

PdfDocument new_pdf() {
  return {HPDF_New(nullptr, nullptr), HPDF_Free};
}

HPDF_Page add_pdf_page(const PdfDocument& document, const PaperSize& paper) {
  HPDF_Page page = HPDF_AddPage(document.get());
  HPDF_Page_SetWidth(page, pdf_points(paper.width_mm));
  HPDF_Page_SetHeight(page, pdf_points(paper.height_mm));
  return page;
}

void draw_pdf_ruler(HPDF_Page page) {
  const double left_mm = kPdfMargin_mm;
  const double bottom_mm = kPdfMargin_mm;
  constexpr double kTick_mm = 3.0;
  HPDF_Page_SetLineWidth(page, pdf_points(0.2));
  for (int i = 0; i <= 10; ++i) {
    const double x = left_mm + kPdfRuler_mm * i / 10.0;
    HPDF_Page_MoveTo(page, pdf_points(x), pdf_points(bottom_mm));
    HPDF_Page_LineTo(
        page, pdf_points(x), pdf_points(bottom_mm + (i % 5 == 0 ? 1.5 : 1.0) * kTick_mm));
  }
  HPDF_Page_MoveTo(page, pdf_points(left_mm), pdf_points(bottom_mm));
  HPDF_Page_LineTo(page, pdf_points(left_mm + kPdfRuler_mm), pdf_points(bottom_mm));
  HPDF_Page_Stroke(page);
}

void write_pdf_line(const PdfDocument& document,
                    HPDF_Page page,
                    double left_mm,
                    double bottom_mm,
                    const std::string& text) {
  constexpr float kSize = 8.0F;  // points
  HPDF_Page_BeginText(page);
  HPDF_Page_SetFontAndSize(page, HPDF_GetFont(document.get(), "Helvetica", nullptr), kSize);
  HPDF_Page_TextOut(page, pdf_points(left_mm), pdf_points(bottom_mm), text.c_str());
  HPDF_Page_EndText(page);
}

void save_pdf(const PdfDocument& owned, const std::filesystem::path& path) {
  HPDF_Doc document = owned.get();
  HPDF_SaveToStream(document);
  if (HPDF_GetError(document) != HPDF_OK) {
    throw Error(ErrorKind::Numeric,
                fmt::format("{}: the page cannot be drawn: libharu reports error {:#x}",
                            path.string(),
                            HPDF_GetError(document)));
  }
  std::vector<HPDF_BYTE> bytes(HPDF_GetStreamSize(document));
  HPDF_UINT32 size = static_cast<HPDF_UINT32>(bytes.size());
  HPDF_ResetStream(document);
  HPDF_ReadFromStream(document, bytes.data(), &size);
  AtomicFile file(path);
  file.stream().write(
      reinterpret_cast<const char*>(bytes.data()),  // NOLINT(*-reinterpret-cast) bytes are bytes
      static_cast<std::streamsize>(size));
  file.commit();
}

}  // namespace frangia

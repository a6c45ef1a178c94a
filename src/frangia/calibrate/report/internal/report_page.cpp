#include "frangia/calibrate/report/internal/report_page.h"

#include <algorithm>

#include <fmt/format.h>

#include "frangia/core/atomic_file.h"
#include "frangia/core/html_escaped.h"
#include "frangia/frames/png.h"

namespace frangia {
namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Calibration</title><style>
body{font:15px/1.45 system-ui,sans-serif;margin:2em auto;max-width:1100px;padding:0 1em;color:#222}
table{border-collapse:collapse;margin:.6em 0}td,th{padding:.2em .8em;border-bottom:1px solid #ddd;text-align:right}
td:first-child,th:first-child{text-align:left}.bad{color:#b00020;font-weight:600}
.row{display:flex;flex-wrap:wrap;gap:1.2em}figure{margin:0}figcaption{font-size:13px;color:#555}
svg{background:#f6f6f6;border:1px solid #ccc}.warning{background:#fff4e0;border-left:4px solid #e09000;padding:.4em .8em}
</style></head><body>
)";

std::string base64_of(const std::vector<char>& bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t block = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t byte =
          i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U;
      block = block << 8U | byte;
    }
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? kDigits[block >> (18U - 6U * k) & 63U] : '=';
  }
  return out;
}

}  // namespace

std::string report_head() {
  return kHead;
}

std::string picture_data(const Image<std::uint8_t>& picture) {
  return "data:image/png;base64," + base64_of(encode_png(picture));
}

std::string color_of(double share) {
  const double hue = 120.0 * (1.0 - std::clamp(share, 0.0, 1.0));
  return fmt::format("hsl({:.0f},85%,40%)", hue);
}

std::string residual_figure(const ResidualMap& map) {
  constexpr double kArrow = 0.03;  // of the width: length of an arrow of the RMS
  const double scale = kArrow * map.width / std::max(map.rms, 1e-6);
  std::string html =
      fmt::format("<figure><svg viewBox=\"0 0 {0} {1}\" width=\"520\" stroke-width=\"{2:.1f}\">\n",
                  map.width,
                  map.height,
                  map.width / 500.0);
  for (const ResidualArrow& arrow : map.arrows) {
    const Eigen::Vector2d to = arrow.from + scale * arrow.residual;
    html += fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n",
        arrow.from.x(),
        arrow.from.y(),
        to.x(),
        to.y(),
        color_of(arrow.residual.norm() / (3.0 * map.rms)));
  }
  return html + fmt::format(
                    "</svg><figcaption>{}: residuals of all points, an arrow of {:.0f} pixels is "
                    "{:.3f} {}, the RMS. Red is three times that or more. Arrows of neighbors that "
                    "agree are a fault of the model; a random pattern is noise.</figcaption>"
                    "</figure>\n",
                    html_escaped(map.title),
                    kArrow * map.width,
                    map.rms,
                    map.unit);
}

void write_report(const std::filesystem::path& path, const std::string& html) {
  AtomicFile file(path);
  file.stream().write(html.data(), static_cast<std::streamsize>(html.size()));
  file.commit();
}

}  // namespace frangia

#include "frangia/decode/write_stages.h"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <span>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/decode/stage_pictures.h"
#include "frangia/frames/float_tiff.h"
#include "frangia/frames/map_picture.h"
#include "frangia/frames/picture_legend.h"
#include "frangia/uncertainty/combined_sigma.h"

namespace frangia {
namespace {

class StageWriter {
 public:
  StageWriter(std::filesystem::path folder, const Run& run)
      : folder_(std::move(folder)), run_(run) {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error) {
      throw Error(ErrorKind::File,
                  fmt::format("{}: cannot be created: {}", folder_.string(), error.message()));
    }
  }
  void numbers(const std::string& name, const Image<float>& values, const std::string& what) {
    run_.check();
    write_float_tiff(folder_ / (name + ".tiff"), values);
    written.push_back({name + ".tiff", what});
  }
  void picture(const std::string& name, const Image<Rgb>& pixels, const std::string& caption) {
    run_.check();
    write_png(folder_ / (name + ".png"), pixels);
    written.push_back({name + ".png", caption});
  }
  void map(const std::string& name,
           const Image<float>& values,
           const std::string& what,
           const std::string& unit) {
    numbers(name, values, fmt::format("{}, {}", what, unit));
    ValueRange range = percentile_range(values);
    constexpr float kNothing = 1e-6F;  // of the range: rounding, which a caption shows as 0
    if (std::abs(range.low) < kNothing * std::abs(range.high)) range.low = 0.0F;
    picture(name,
            add_legend(map_picture(values, range, ColorMap::Viridis),
                       {.scales = {{ColorMap::Viridis, range, unit}}}),
            fmt::format(
                "{}: {:.4g} (dark blue) to {:.4g} {} (yellow)", what, range.low, range.high, unit));
  }

  std::vector<StageFile> written;

 private:
  std::filesystem::path folder_;
  const Run& run_;
};

std::string as_html(const std::string& text) {
  std::string out;
  for (const char letter : text) {
    if (letter == '&' || letter == '<' || letter == '>' || letter == '"') {
      out += fmt::format("&#{};", static_cast<int>(letter));
    } else {
      out += letter;
    }
  }
  return out;
}

/// Writes a page with all pictures; a click opens one at full size.
void write_page(const std::filesystem::path& path, const std::vector<StageFile>& files) {
  AtomicFile file(path);
  file.stream()
      << "<!doctype html><meta charset=\"utf-8\"><title>Stages of a view</title>\n"
         "<style>body{font:14px sans-serif;margin:1em;display:flex;flex-wrap:wrap;gap:1em}"
         "figure{margin:0;width:320px}img{width:100%}</style>\n";
  for (const StageFile& one : files) {
    if (std::filesystem::path(one.name).extension() != ".png") continue;
    file.stream() << fmt::format(
        "<figure><a href=\"{0}\"><img src=\"{0}\" alt=\"{0}\"></a><figcaption><b>{0}</b><br>{1}"
        "</figcaption></figure>\n",
        as_html(one.name),
        as_html(one.caption));
  }
  file.commit();
}

std::string mask_caption(const Image<PixelStatus>& status) {
  std::vector<std::string> parts;
  for (const StatusLegend& entry : status_legend()) {
    if (std::count(status.pixels().begin(), status.pixels().end(), entry.status) > 0)
      parts.push_back(fmt::format("{}: {}", entry.color_name, entry.meaning));
  }
  return fmt::format("pixel status; {}", fmt::join(parts, "; "));
}

void write_wrapped(const WrappedPhase& level, StageWriter& out) {
  const std::string& name = level.pattern.name;
  out.numbers(name + "-wrapped", level.phase_rad, "phase modulo 2 pi, rad");
  // As in the paper's Fig. 4: the phase modulo 2 pi, from black to white.
  out.picture(name + "-wrapped",
              add_legend(map_picture(level.phase_rad, {-3.14159265F, 3.14159265F}, ColorMap::Gray),
                         {.scales = {{ColorMap::Gray, {-3.14159265F, 3.14159265F}, "rad"}}}),
              "phase modulo 2 pi: -pi (black) to pi rad (white)");
  out.picture(name + "-residues",
              residue_picture(level.phase_rad),
              "the same with its residues, loops of pixels around which the phase gains 2 pi "
              "clockwise (red) or loses 2 pi (blue)");
  out.map(name + "-modulation", level.modulation_counts, "modulation", "counts");
  out.map(name + "-sigma", level.sigma_rad, "noise of the phase, standard deviation", "rad");
  if (!level.systematic_rad.empty()) {
    out.map(name + "-systematic",
            level.systematic_rad,
            "systematic standard uncertainty of the phase",
            "rad");
  }
}

void write_relative(const RelativePhase& relative, StageWriter& out) {
  if (!relative.growth_order.pixels().empty()) {
    out.picture("growth",
                growth_picture(relative.growth_order),
                "order in which the growth reaches the pixels: first (dark blue) to last (yellow)");
  }
  out.map("relative", relative.phase_rad, "spatially unwrapped phase, region by region", "rad");
  out.picture("regions",
              label_picture(relative.region),
              fmt::format("{} regions that could not be joined safely, a colour each",
                          relative.region_count));
}

/// Noise and systematic part of the points together.
Image<float> combine_parts(const RangeGrid& range) {
  if (range.systematic_mm.empty()) return range.sigma_mm;
  Image<float> combined(range.sigma_mm.width(), range.sigma_mm.height(), Uninitialized{});
  const auto noise = range.sigma_mm.pixels();
  const auto systematic = range.systematic_mm.pixels();
  for (std::size_t i = 0; i < noise.size(); ++i)
    combined.pixels()[i] = combined_sigma(noise[i], systematic[i]);
  return combined;
}

/// The uncertainty of the points along their rays: combined, and its parts where both are known.
void write_sigma(const RangeGrid& range, StageWriter& out) {
  if (range.systematic_mm.empty()) {
    out.map("sigma", range.sigma_mm, "standard uncertainty of the point along its ray", "mm");
    return;
  }
  out.map("sigma",
          combine_parts(range),
          "combined standard uncertainty of the point along its ray",
          "mm");
  out.map("sigma-noise", range.sigma_mm, "part of sigma that is noise", "mm");
  out.map("sigma-systematic", range.systematic_mm, "systematic part of sigma", "mm");
}

/// Noise and systematic part together.
Image<float> combined_sigma(const AbsolutePhase& phase) {
  Image<float> out = phase.sigma_rad;
  for (std::size_t i = 0; i < phase.systematic_rad.pixels().size(); ++i)
    out.pixels()[i] = std::hypot(out.pixels()[i], phase.systematic_rad.pixels()[i]);
  return out;
}

/// The coordinate of the projector that a Gray code alone gives.
void write_coordinate(const AbsolutePhase& phase, StageWriter& out) {
  const bool columns = phase.pattern.direction == FringeDirection::Vertical;
  Image<float> coordinate = phase.phase_rad;
  for (float& value : coordinate.pixels())
    value *= static_cast<float>(phase.pattern.period_px / kTwoPi);
  out.map(columns ? "columns" : "rows",
          coordinate,
          columns ? "column of the projector" : "row of the projector",
          "px");
}

/// The final phase and its noise, without the systematic part.
void write_phase(const AbsolutePhase& phase, StageWriter& out) {
  const std::string& name = phase.pattern.name;
  out.numbers(name + "-phase", phase.phase_rad, "final phase, rad");
  out.numbers(name + "-sigma", phase.sigma_rad, "noise of the final phase, rad");
}

}  // namespace

std::vector<StageFile> write_stages(const DecodedView& decoded,
                                    const RangeGrid& range,
                                    const std::filesystem::path& folder,
                                    const Run& run) {
  StageWriter out(folder, run);
  const DecodedDirection& leading = decoded.directions.front();
  for (const DecodedDirection& direction : decoded.directions | std::views::reverse) {
    for (const WrappedPhase& level : direction.wrapped)
      write_wrapped(level, out);
  }
  if (leading.relative) write_relative(*leading.relative, out);
  out.picture("mask", status_picture(leading.phase.status), mask_caption(leading.phase.status));
  for (const DecodedDirection& direction : decoded.directions)
    if (direction.wrapped.empty()) write_coordinate(direction.phase, out);
  if (!leading.wrapped.empty()) {
    const auto fringes = fringe_orders(leading.wrapped.back().phase_rad, leading.phase.phase_rad);
    out.picture("fringes", label_picture(fringes), "fringes of the finest pattern, a colour each");
  }
  out.map("absolute", leading.phase.phase_rad, "final phase", "rad");
  out.map("absolute-sigma",
          combined_sigma(leading.phase),
          "combined standard uncertainty of the final phase",
          "rad");
  for (const DecodedDirection& other : std::span(decoded.directions).subspan(1)) {
    const char* name =
        other.phase.pattern.direction == FringeDirection::Vertical ? "vertical" : "horizontal";
    out.map(fmt::format("absolute-{}", name),
            other.phase.phase_rad,
            fmt::format("final phase of the {} fringes", name),
            "rad");
  }
  if (!range.depth_mm.empty()) {
    out.map("depth", range.depth_mm, "depth along the camera's axis", "mm");
    write_sigma(range, out);
  }
  write_page(folder / "index.html", out.written);
  out.written.push_back({"index.html", "all pictures on one page"});
  return std::move(out.written);
}

std::vector<StageFile> write_maps(const DecodedView& decoded,
                                  const RangeGrid& range,
                                  const std::filesystem::path& folder,
                                  const Run& run) {
  StageWriter out(folder, run);
  for (const DecodedDirection& direction : decoded.directions)
    write_phase(direction.phase, out);
  const Image<PixelStatus>& status = decoded.directions.front().phase.status;
  out.picture("mask", status_picture(status), mask_caption(status));
  if (!range.depth_mm.empty()) {
    out.numbers("depth", range.depth_mm, "depth along the camera's axis, mm");
    out.numbers("depth-sigma", combine_parts(range), "standard uncertainty along the ray, mm");
  }
  return std::move(out.written);
}

}  // namespace frangia

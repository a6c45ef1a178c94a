#include "frangia/scan/write_stages.h"

#include <cmath>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "frangia/frames/float_tiff.h"
#include "frangia/frames/map_picture.h"

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
                  fmt::format("{}: cannot be made: {}", folder_.string(), error.message()));
    }
  }
  void numbers(const std::string& name, const Image<float>& values) {
    run_.check();
    write_float_tiff(folder_ / (name + ".tiff"), values);
    written.push_back(name + ".tiff");
  }
  void picture(const std::string& name, const Image<Rgb>& pixels) {
    run_.check();
    write_png(folder_ / (name + ".png"), pixels);
    written.push_back(name + ".png");
  }
  void map(const std::string& name, const Image<float>& values) {
    numbers(name, values);
    picture(name, map_picture(values, usual_range(values), ColorMap::Viridis));
  }

  std::vector<std::string> written;

 private:
  std::filesystem::path folder_;
  const Run& run_;
};

Image<Rgb> mask_picture(const Image<PixelFate>& fate) {
  Image<Rgb> picture(fate.width(), fate.height());
  for (std::size_t i = 0; i < fate.pixels().size(); ++i)
    picture.pixels()[i] = fate_legend()[static_cast<std::size_t>(fate.pixels()[i])].color;
  return picture;
}

/// Neighbouring regions in colors far apart, the largest in the calmest.
Image<Rgb> region_picture(const Image<std::int32_t>& region) {
  Image<Rgb> picture(region.width(), region.height(), Rgb{36, 40, 52});
  for (std::size_t i = 0; i < region.pixels().size(); ++i) {
    const std::int32_t label = region.pixels()[i];
    if (label < 0) continue;
    const double golden = 0.6180339887 * (label + 1);
    picture.pixels()[i] =
        pixel_of(ColorMap::Viridis, static_cast<float>(golden - std::floor(golden)));
  }
  return picture;
}

}  // namespace

const std::vector<FateLegend>& fate_legend() {
  static const std::vector<FateLegend> legend = {
      {PixelFate::Measured, {230, 230, 225}, "white", "measured"},
      {PixelFate::Filled, {110, 200, 120}, "green", "filled from its neighbours"},
      {PixelFate::Unmodulated, {36, 40, 52}, "dark", "unmodulated: background or shadow"},
      {PixelFate::Saturated, {220, 60, 50}, "red", "saturated in a frame"},
      {PixelFate::Residue, {160, 80, 200}, "purple", "phase jumps that do not close"},
      {PixelFate::Doubtful, {240, 170, 40}, "orange", "fringe order in doubt"},
      {PixelFate::Unanchored, {70, 130, 220}, "blue", "whole number of fringes not known"},
      {PixelFate::MixedEdge, {240, 220, 90}, "yellow", "sees two surfaces at a depth edge"},
      {PixelFate::OutOfField, {120, 100, 90}, "brown", "a phase that the projector does not show"}};
  return legend;
}

std::vector<std::string> write_stages(const DecodedView& decoded,
                                      const RangeGrid& range,
                                      const std::filesystem::path& folder,
                                      const Run& run) {
  StageWriter out(folder, run);
  for (const WrappedPhase& level : decoded.wrapped) {
    const std::string& name = level.pattern.name;
    out.numbers(name + "-wrapped", level.phase_rad);
    // As in the paper's Fig. 4: the phase modulo 2 pi, from black to white.
    out.picture(name + "-wrapped",
                map_picture(level.phase_rad, {-3.14159265F, 3.14159265F}, ColorMap::Grey));
    out.map(name + "-modulation", level.modulation_counts);
    out.map(name + "-sigma", level.sigma_rad);
  }
  if (decoded.relative) {
    out.map("relative", decoded.relative->phase_rad);
    out.picture("regions", region_picture(decoded.relative->region));
  }
  out.picture("mask", mask_picture(decoded.phase.fate));
  out.map("absolute", decoded.phase.phase_rad);
  out.map("depth", range.depth_mm);
  out.map("sigma", range.sigma_mm);
  return out.written;
}

}  // namespace frangia

#include "frangia/dataset/internal/write_imported_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/frames/float_tiff.h"
#include "frangia/frames/grey_image.h"
#include "frangia/frames/png.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;

/// Notes the range of the values of a frame.
void note_range(const Samples& samples, WrittenFrame& written) {
  if (const auto* const values = std::get_if<Image<float>>(&samples)) {
    written.bits = 32;
    double least = std::numeric_limits<double>::infinity();
    double greatest = -least;
    for (const float value : values->pixels()) {
      if (!std::isfinite(value)) continue;
      least = std::min(least, static_cast<double>(value));
      greatest = std::max(greatest, static_cast<double>(value));
    }
    written.least_value = std::min(least, greatest);
    written.greatest_value = std::max(least, greatest);
    if (least > greatest) written.least_value = written.greatest_value = 0.0;
    return;
  }
  const auto note = [&](const auto& image) {
    for (const auto value : image.pixels()) {
      written.largest = std::max(written.largest, static_cast<int>(value));
      written.all_bits |= static_cast<unsigned>(value);
    }
  };
  if (const auto* const narrow = std::get_if<Image<std::uint8_t>>(&samples)) {
    note(*narrow);
  } else {
    written.bits = 16;
    note(std::get<Image<std::uint16_t>>(samples));
  }
}

/// The folder of a view and a camera, relative to the scan.
fs::path folder_of(const ImportPlan& plan, std::size_t view, std::size_t camera) {
  const fs::path folder = view_folder(view);
  return camera == 0 ? folder : folder / plan.cameras[camera].name;
}

/// Writes one frame into `folder`.
WrittenFrame write_frame(const ImportPlan& plan,
                         const ImportedFrame& frame,
                         const fs::path& folder) {
  const ImageFile file(frame.file, plan.options.files);
  const ImageInfo& info = file.info();
  const ImageInfo& planned = plan.cameras[frame.camera].image;
  const int turned = plan.cameras[frame.camera].turned;
  const bool exchanged = exchanges_sides(turned);
  if ((exchanged ? info.height_px : info.width_px) != planned.width_px ||
      (exchanged ? info.width_px : info.height_px) != planned.height_px) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: changed during the import; import again", frame.file.string()));
  }
  const Pattern& pattern = plan.patterns[frame.pattern];
  fs::path name = folder_of(plan, frame.view, frame.camera) /
                  frame_file_name(pattern, static_cast<int>(frame.frame));
  WrittenFrame written{.file = name.generic_string(),
                       .codec = info.codec,
                       .bytes = file.bytes(),
                       .crc32 = file.crc32(),
                       .jpeg_quality = info.jpeg_quality,
                       .stated_white = info.white_level};
  RasterImage image = file.read(frame.page);
  if (turned != 1) image = turn_image(image, turned);
  if (pattern.kind == PatternKind::White || pattern.kind == PatternKind::Ambient) {
    if (const auto color = color_image(image, plan.options.color)) {
      written.is_color = true;
      write_png(folder / name, *color);
      return written;
    }
  }
  Samples samples;
  try {
    samples = grey_image(std::move(image), plan.options.color);
  } catch (const Error& error) {
    const std::string what = error.what();
    const bool named = what.find(frame.file.string()) != std::string::npos;
    if (named || error.kind() != ErrorKind::Input) throw;
    throw Error(error.kind(), fmt::format("{}: {}", frame.file.string(), what));
  }
  note_range(samples, written);
  if (auto* const values = std::get_if<Image<float>>(&samples)) {
    name.replace_extension(".tiff");
    write_float_tiff(folder / name, *values);
  } else if (auto* const narrow = std::get_if<Image<std::uint8_t>>(&samples)) {
    write_png(folder / name, Frame(std::move(*narrow)));
  } else {
    write_png(folder / name, Frame(std::move(std::get<Image<std::uint16_t>>(samples))));
  }
  written.file = name.generic_string();
  return written;
}

}  // namespace

std::string view_folder(std::size_t view) {
  return fmt::format("views/{:03}", view);
}

std::vector<WrittenFrame> write_imported_frames(const ImportPlan& plan,
                                                const fs::path& folder,
                                                const Run& run) {
  constexpr std::size_t kBatch = 8;  // between reports of progress
  for (std::size_t view = 0; view < plan.views; ++view) {
    for (std::size_t camera = 0; camera < plan.cameras.size(); ++camera)
      make_folder(folder / folder_of(plan, view, camera));
  }
  std::vector<WrittenFrame> written(plan.frames.size());
  for (std::size_t begin = 0; begin < plan.frames.size(); begin += kBatch) {
    run.report(static_cast<double>(begin) / static_cast<double>(plan.frames.size()));
    const std::size_t count = std::min(kBatch, plan.frames.size() - begin);
    std::array<std::exception_ptr, kBatch> errors{};
    parallel_chunks(count, 1, [&](std::size_t i, std::size_t) {
      try {
        run.check();
        written[begin + i] = write_frame(plan, plan.frames[begin + i], folder);
      } catch (...) {
        errors[i] = std::current_exception();
      }
    });
    for (const std::exception_ptr& error : errors)
      if (error) std::rethrow_exception(error);
  }
  run.report(1.0);
  return written;
}

}  // namespace frangia

#include "frangia/dataset/import_frames.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/atomic_file.h"
#include "frangia/core/make_folder.h"
#include "frangia/core/parallel.h"
#include "frangia/dataset/internal/new_folder.h"
#include "frangia/dataset/write_scan.h"
#include "frangia/frames/float_tiff.h"
#include "frangia/frames/jpeg_noise.h"
#include "frangia/frames/png.h"
#include "frangia/rig/toml_writer.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;

/// What is known of a frame after it was written.
struct WrittenFrame {
  std::string file;  ///< relative to the scan
  std::string codec;
  std::size_t bytes = 0;
  std::uint32_t crc32 = 0;
  std::optional<int> jpeg_quality{};
  int bits = 8;                 ///< of the frame in the scan; 32: floating point
  int stated_white = 0;         ///< full scale that the original states
  int largest = 0;              ///< of whole numbers
  unsigned all_bits = 0;        ///< of whole numbers: every bit that any pixel sets
  double least_value = 0.0;     ///< of floating point
  double greatest_value = 0.0;  ///< of floating point
};

std::string view_folder(std::size_t view) {
  return fmt::format("views/{:03}", view);
}

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

/// Writes one frame into `folder`.
WrittenFrame write_frame(const ImportPlan& plan,
                         const ImportedFrame& frame,
                         const fs::path& folder) {
  const ImageFile file(frame.file, plan.options.files);
  const ImageInfo& info = file.info();
  if (info.width_px != plan.image.width_px || info.height_px != plan.image.height_px) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: changed during the import; import again", frame.file.string()));
  }
  Samples samples;
  try {
    samples = grey_image(file.read(frame.page), plan.options.color);
  } catch (const Error& error) {
    const std::string what = error.what();
    const bool named = what.find(frame.file.string()) != std::string::npos;
    if (named || error.kind() != ErrorKind::Input) throw;
    throw Error(error.kind(), fmt::format("{}: {}", frame.file.string(), what));
  }
  WrittenFrame written{.codec = info.codec,
                       .bytes = file.bytes(),
                       .crc32 = file.crc32(),
                       .jpeg_quality = info.jpeg_quality,
                       .stated_white = info.white_level};
  note_range(samples, written);
  fs::path name = fs::path(view_folder(frame.view)) /
                  frame_file_name(plan.patterns[frame.pattern], static_cast<int>(frame.frame));
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

/// Writes all frames, several at a time. The error of the first frame that failed is thrown.
std::vector<WrittenFrame> write_all_frames(const ImportPlan& plan,
                                           const fs::path& folder,
                                           const Run& run) {
  constexpr std::size_t kBatch = 8;  // between reports of progress
  for (std::size_t view = 0; view < plan.views; ++view)
    make_folder(folder / view_folder(view));
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

/// The full scale of whole numbers: what the files state, or the least of the usual depths that
/// holds every value. Samples that are shifted to the left leave low bits unset.
int white_level_of(const std::vector<WrittenFrame>& frames, const Run& run) {
  int largest = 0;
  int stated = 0;
  unsigned all_bits = 0;
  for (const WrittenFrame& frame : frames) {
    largest = std::max(largest, frame.largest);
    stated = std::max(stated, frame.stated_white);
    all_bits |= frame.all_bits;
  }
  if (frames.front().bits == 8) return stated > 0 ? stated : 255;
  if (stated > 0) return stated;
  int white = 65535;
  for (const int depth : {10, 12, 14}) {
    if (largest < (1 << depth)) {
      white = (1 << depth) - 1;
      break;
    }
  }
  constexpr int kMaxShift = 6;  // 10 bits in 16
  int shift = 0;
  while (shift < kMaxShift && (all_bits >> static_cast<unsigned>(shift) & 1U) == 0)
    ++shift;
  if (white == 65535) white &= ~((1 << shift) - 1);
  run.note(
      fmt::format("the white level of the 16-bit frames is assumed to be {}, the least full scale "
                  "that holds their largest value, {}; set `white_level` if it is another",
                  white,
                  largest));
  return white;
}

/// The range of floating-point frames.
FrameStorage float_storage(const std::vector<WrittenFrame>& frames,
                           const ImportOptions& options,
                           const Run& run) {
  FrameStorage storage;
  storage.is_float = true;
  double greatest = 0.0;
  for (const WrittenFrame& frame : frames) {
    storage.zero = std::min(storage.zero, frame.least_value);
    greatest = std::max(greatest, frame.greatest_value);
  }
  storage.full_scale = options.float_white;
  if (storage.full_scale > 0.0) return storage;
  storage.full_scale = greatest > 0.0 ? greatest : 1.0;
  for (const double usual : {1.0, 255.0, 1023.0, 4095.0, 16383.0, 65535.0}) {
    if (greatest <= usual) {
      storage.full_scale = usual;
      break;
    }
  }
  run.note(
      fmt::format("the white level of the floating-point frames is assumed to be {}, the least "
                  "usual one above their largest value, {:.6g}; set `white_level` if it is another",
                  storage.full_scale,
                  greatest));
  return storage;
}

/// The scan of a plan whose frames were written.
Scan scan_of(const ImportPlan& plan, const std::vector<WrittenFrame>& frames, const Run& run) {
  Scan scan;
  scan.rig = plan.rig;
  scan.patterns = plan.patterns;
  for (std::size_t view = 0; view < plan.views; ++view) {
    const double angle = plan.options.angles_rad.empty() ? 0.0 : plan.options.angles_rad[view];
    scan.views.push_back({angle, view_folder(view)});
  }
  Camera& camera = scan.rig.camera;
  camera.model.width_px = plan.image.width_px;
  camera.model.height_px = plan.image.height_px;
  const int bits = frames.front().bits;
  if (bits == 32) {
    scan.frames = float_storage(frames, plan.options, run);
    if (camera.noise) {
      run.warn(
          "camera.noise of the rig is left out: its counts are not those of floating-point frames");
    }
    camera.noise.reset();
    camera.white_level = kFloatWhiteLevel;
  } else if (plan.options.white_level > 0) {
    camera.white_level = plan.options.white_level;
  } else {
    int largest = 0;
    for (const WrittenFrame& frame : frames)
      largest = std::max(largest, frame.largest);
    const bool fits = camera.white_level >= largest && (bits == 16) == (camera.white_level > 255);
    if (plan.options.rig.empty() || !fits) camera.white_level = white_level_of(frames, run);
  }
  if (plan.jpeg_quality > 0) {
    const double scale = bits == 16 ? 257.0 : 1.0;  // computed grey values have 16 bits
    scan.frames.compression_counts2 = scale * scale * jpeg_noise_counts2(plan.jpeg_quality);
  }
  return scan;
}

/// A rig.toml of the camera's size and white level alone.
void write_camera_only(const fs::path& path, const Camera& camera) {
  TomlWriter writer;
  writer.put("format", std::string("frangia-rig"));
  writer.put("version", 1);
  writer.begin_table("camera");
  writer.put("size_px", std::vector<int>{camera.model.width_px, camera.model.height_px});
  writer.put("white_level", camera.white_level);
  writer.save(path);
}

void write_record(const fs::path& path,
                  const ImportPlan& plan,
                  const std::vector<WrittenFrame>& written) {
  nlohmann::ordered_json json{{"format", "frangia-import"},
                              {"version", 1},
                              {"source", fs::absolute(plan.folder).lexically_normal().string()},
                              {"names", plan.names}};
  if (!plan.options.layout.empty()) json["layout"] = plan.options.layout;
  json["frames"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < written.size(); ++i) {
    const WrittenFrame& frame = written[i];
    nlohmann::ordered_json entry{
        {"file", frame.file},
        {"original", plan.frames[i].file.lexically_relative(plan.folder).generic_string()},
        {"page", plan.frames[i].page},
        {"bytes", frame.bytes},
        {"crc32", fmt::format("{:08x}", frame.crc32)},
        {"codec", frame.codec}};
    if (frame.jpeg_quality) entry["jpeg_quality"] = *frame.jpeg_quality;
    json["frames"].push_back(std::move(entry));
  }
  json["left_out"] = nlohmann::ordered_json::array();
  for (const fs::path& file : plan.left_out)
    json["left_out"].push_back(file.lexically_relative(plan.folder).generic_string());
  AtomicFile file(path);
  file.stream() << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  file.commit();
}

}  // namespace

ImportResult import_frames(const ImportPlan& plan, const fs::path& target, const Run& run) {
  require(!plan.frames.empty(), "import_frames: the plan has no frames");
  NewFolder folder(target);
  run.stage("import");
  const std::vector<WrittenFrame> written = write_all_frames(plan, folder.temporary(), run);
  ImportResult result{scan_of(plan, written, run)};
  Scan& scan = result.scan;
  result.compression_counts2 = scan.frames.compression_counts2;
  scan.folder = target.has_filename() ? target : target.parent_path();
  scan.name = scan.folder.filename().string();
  write_record(folder.temporary() / "import.json", plan, written);
  Scan inside = scan;
  inside.folder = folder.temporary();
  write_scan(inside);
  if (!plan.rig_has_projector) write_camera_only(folder.temporary() / "rig.toml", scan.rig.camera);
  folder.commit();
  return result;
}

}  // namespace frangia

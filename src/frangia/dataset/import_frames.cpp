#include "frangia/dataset/import_frames.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/dataset/internal/write_imported_frames.h"
#include "frangia/dataset/write_scan.h"
#include "frangia/frames/jpeg_noise.h"
#include "frangia/rig/toml_writer.h"

namespace frangia {
namespace {

/// A folder that appears under its final name only when it is complete. It is made under a
/// hidden name in the same parent folder and renamed by `commit`; the destructor removes a folder
/// that was not committed.
///
/// @errors   Error(File) when the final name exists and is not an empty folder, or when the folder
///           cannot be made
class NewFolder {
 public:
  explicit NewFolder(std::filesystem::path path);
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  NewFolder(NewFolder&&) = delete;
  NewFolder& operator=(NewFolder&&) = delete;
  ~NewFolder();

  /// The folder while it is being filled.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  /// Renames the folder to its final name.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
};

namespace fs = std::filesystem;

void require_free(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) return;
  if (fs::is_directory(path, error) && fs::is_empty(path, error)) return;
  throw Error(ErrorKind::File,
              fmt::format("{}: exists already; remove it or choose another name", path.string()));
}

NewFolder::NewFolder(fs::path path) : path_(std::move(path)) {
  // "scan/" names the folder "scan".
  if (!path_.has_filename()) path_ = path_.parent_path();
  require_free(path_);
  std::random_device random;
  const std::uint64_t number = (std::uint64_t{random()} << 32U) | random();
  temporary_ = path_.parent_path() /
               fmt::format(".{}.frangia-{:016x}.tmp", path_.filename().string(), number);
  make_folder(temporary_);
}

NewFolder::~NewFolder() {
  if (temporary_.empty()) return;
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

void NewFolder::commit() {
  require_free(path_);
  std::error_code error;
  fs::rename(temporary_, path_, error);
  if (error) {
    throw Error(ErrorKind::File,
                fmt::format("{}: cannot be created: {}", path_.string(), error.message()));
  }
  temporary_.clear();
}

namespace fs = std::filesystem;

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

/// Sets the white level of a camera from its grey frames.
void set_white_level(const ImportPlan& plan,
                     const std::vector<WrittenFrame>& frames,
                     Camera& camera,
                     const Run& run) {
  const int bits = frames.front().bits;
  if (plan.options.white_level > 0) {
    camera.white_level = plan.options.white_level;
    return;
  }
  int largest = 0;
  for (const WrittenFrame& frame : frames)
    largest = std::max(largest, frame.largest);
  const bool fits = camera.white_level >= largest && (bits == 16) == (camera.white_level > 255);
  const bool computed = bits == 16 && plan.image.bits == 8;  // grey of 8-bit colours, times 257
  if (computed) {
    camera.white_level = 65535;
  } else if (plan.options.rig.empty() || !fits) {
    camera.white_level = white_level_of(frames, run);
  }
}

/// Leaves out the noise that a rig states for a camera of another depth: its counts are others.
void leave_out_noise_of_other_depth(const Camera& of_rig, Camera& camera, const Run& run) {
  constexpr double kOtherDepth = 2.0;  // bits more or fewer double or halve the full scale
  const double factor = static_cast<double>(camera.white_level) / of_rig.white_level;
  if (!camera.noise || (factor < kOtherDepth && factor > 1.0 / kOtherDepth)) return;
  run.warn(
      fmt::format("camera.noise of the rig is left out: it is that of frames with a white level of "
                  "{} counts, and these have {}; it is estimated from the frames",
                  of_rig.white_level,
                  camera.white_level));
  camera.noise.reset();
}

/// The cameras beside the reference camera: those of the rig, or new ones of which the sizes alone
/// are known.
void add_cameras(const ImportPlan& plan, Scan& scan) {
  if (!plan.options.rig.empty()) return;
  const Eigen::Vector2d unknown = Eigen::Vector2d::Constant(std::nan(""));
  for (std::size_t i = 1; i < plan.cameras.size(); ++i) {
    PosedCamera posed;
    posed.camera.name = plan.cameras[i].name;
    posed.camera.model.width_px = plan.cameras[i].image.width_px;
    posed.camera.model.height_px = plan.cameras[i].image.height_px;
    posed.camera.model.focal_px = posed.camera.model.principal_point_px = unknown;
    posed.position_mm.setConstant(std::nan(""));
    posed.rotation.setConstant(std::nan(""));
    scan.rig.cameras.push_back(std::move(posed));
  }
  // Two cameras need no more of the projector than its size.
  scan.rig.projector.is_label = scan.rig.cameras.size() > 1;
}

/// The scan of a plan whose frames were written.
Scan scan_of(const ImportPlan& plan, const std::vector<WrittenFrame>& written, const Run& run) {
  std::vector<WrittenFrame> frames;  // in grey
  std::vector<std::vector<WrittenFrame>> of_cameras(plan.cameras.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    if (written[i].is_color) continue;
    frames.push_back(written[i]);
    of_cameras[plan.frames[i].camera].push_back(written[i]);
  }
  require(!frames.empty(), "the images are white or ambient frames alone; add those of patterns");
  Scan scan;
  scan.rig = plan.rig;
  scan.patterns = plan.patterns;
  scan.board = plan.board;
  scan.artifact = plan.artifact;
  for (std::size_t view = 0; view < plan.views; ++view) {
    const double angle = plan.options.angles_rad.empty() ? 0.0 : plan.options.angles_rad[view];
    scan.views.push_back({angle, view_folder(view)});
  }
  scan.rig.reference().model.width_px = plan.image.width_px;
  scan.rig.reference().model.height_px = plan.image.height_px;
  add_cameras(plan, scan);
  const int bits = frames.front().bits;
  if (bits == 32) scan.frames = float_storage(frames, plan.options, run);
  for (std::size_t i = 0; i < plan.cameras.size(); ++i) {
    Camera& camera = scan.rig.cameras[i].camera;
    if (bits != 32) {
      const Camera of_rig = camera;
      set_white_level(plan, of_cameras[i], camera, run);
      leave_out_noise_of_other_depth(of_rig, camera, run);
      continue;
    }
    if (camera.noise) {
      run.warn(
          "camera.noise of the rig is left out: its counts are not those of floating-point frames");
    }
    camera.noise.reset();
    camera.white_level = kFloatWhiteLevel;
  }
  if (plan.jpeg_quality > 0) {
    const double scale = bits == 16 ? 257.0 : 1.0;  // computed grey values have 16 bits
    scan.frames.compression_counts2 = scale * scale * jpeg_noise_counts2(plan.jpeg_quality);
  }
  return scan;
}

/// A rig.toml of sizes and white levels alone.
void write_sizes_only(const fs::path& path, const ImportPlan& plan, const Rig& rig) {
  TomlWriter writer;
  writer.put("format", std::string("frangia-rig"));
  writer.put("version", 1);
  const auto put = [&](const Camera& camera) {
    writer.put("size_px", std::vector<int>{camera.model.width_px, camera.model.height_px});
    writer.put("white_level", camera.white_level);
  };
  writer.begin_table("camera");
  put(rig.reference());
  for (std::size_t i = 1; i < rig.cameras.size(); ++i) {
    writer.begin_table_of_list("more_cameras");
    writer.put("name", rig.cameras[i].camera.name);
    put(rig.cameras[i].camera);
  }
  const auto* const model = std::get_if<PinholeModel>(&rig.projector.model);
  if (plan.rig_has_projector && model != nullptr) {
    writer.begin_table("projector");
    writer.put("model", std::string("label"));
    writer.put("size_px", std::vector<int>{model->width_px, model->height_px});
  }
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
  write_text_file(path, json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace

ImportResult import_frames(const ImportPlan& plan, const fs::path& target, const Run& run) {
  require(!plan.frames.empty(), "import_frames: the plan has no frames");
  NewFolder folder(target);
  run.stage("import");
  const std::vector<WrittenFrame> written = write_imported_frames(plan, folder.temporary(), run);
  ImportResult result{scan_of(plan, written, run)};
  Scan& scan = result.scan;
  result.compression_counts2 = scan.frames.compression_counts2;
  scan.folder = target.has_filename() ? target : target.parent_path();
  scan.name = scan.folder.filename().string();
  write_record(folder.temporary() / "import.json", plan, written);
  Scan inside = scan;
  inside.folder = folder.temporary();
  write_scan(inside);
  const bool several = plan.options.rig.empty() && plan.cameras.size() > 1;
  if (!plan.rig_has_projector || several)
    write_sizes_only(folder.temporary() / "rig.toml", plan, scan.rig);
  folder.commit();
  return result;
}

}  // namespace frangia

#include <algorithm>
#include <cmath>
#include <deque>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"
#include "frangia/files/read_mesh.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/rig/read_rig.h"
#include "frangia/simulate/internal/fault_script.h"
#include "frangia/simulate/internal/move_views.h"
#include "frangia/simulate/internal/simulated_devices.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/simulate_calibration.h"
#include "frangia/simulate/simulate_scan.h"

namespace frangia {
namespace {

SimulateOptions read_options(DeviceSettings& settings, const Rig& rig) {
  SimulateOptions options;
  options.seed = static_cast<std::uint64_t>(settings.integer_or("seed", 1, 0, 1'000'000'000));
  options.samples_per_px = settings.integer_or("samples", 1, 1, 64);
  // A further camera has noise of its own.
  for (const char letter : rig.reference().name)
    options.seed = hash(options.seed, static_cast<std::uint64_t>(letter));
  options.bits = static_cast<int>(std::lround(std::log2(rig.reference().white_level + 1)));
  if (rig.reference().noise) {
    const double e_per_count = 1.0 / rig.reference().noise->slope_counts;
    const double read2_counts = std::max(0.0, rig.reference().noise->floor_counts2 - 1.0 / 12.0);
    options.full_well_e = e_per_count * rig.reference().white_level;
    options.read_e = e_per_count * std::sqrt(read2_counts);
  }
  options.ambient = settings.number_or("ambient", options.ambient);
  options.camera_blur_px = settings.number_or("camera_blur_px", options.camera_blur_px);
  options.contrast = settings.number_or("contrast", options.contrast);
  options.gloss = settings.number_or("gloss", options.gloss);
  options.shininess = settings.number_or("shininess", options.shininess);
  options.texture = settings.number_or("texture", options.texture);
  options.speckle = settings.number_or("speckle", options.speckle);
  if (settings.has("platter_radius_mm"))
    settings.fail("platter_radius_mm", "is called turntable_top_radius_mm now; rename it");
  options.turntable_top_radius_mm =
      settings.number_or("turntable_top_radius_mm", options.turntable_top_radius_mm);
  if (!rig.projector.is_angular())
    options.display_gamma = settings.number_or("display_gamma", options.display_gamma);
  return options;
}

Mesh read_part(DeviceSettings& settings) {
  const std::string part = settings.text_or("part", "bracket");
  const auto known = part_names();
  if (std::find(known.begin(), known.end(), part) != known.end()) return make_part(part);
  const std::filesystem::path file = settings.path("part");
  if (!std::filesystem::exists(file)) {
    settings.fail("part",
                  fmt::format("is \"{}\"; it must be one of {}, or a .stl, .ply or .obj file",
                              part,
                              fmt::join(known, ", ")));
  }
  return read_mesh(file);
}

/// A board in the poses that a person, or the turntable, gives it.
std::shared_ptr<SimulatedScene> make_board_scene(DeviceSettings& settings,
                                                 const Rig& rig,
                                                 SimulatedBench& bench) {
  if (settings.has("part")) static_cast<void>(settings.text_or("part", ""));
  SimulateOptions options = read_options(settings, rig);
  const BoardPoses planned = plan_board_poses({.folder = {},
                                               .rig = rig,
                                               .board = bench.board->board,
                                               .poses = bench.board->poses,
                                               .on_turntable = bench.board->on_turntable,
                                               .turn_rad = bench.board->turn_rad,
                                               .patterns = {}},
                                              options.seed);
  const std::map<int, Eigen::Isometry3d>& poses = planned.scan.part_poses;
  const Eigen::Isometry3d first = poses.at(0);
  for (const auto& [number, pose] : poses)
    bench.moves.emplace_back(pose * first.inverse());
  options.board = planned.scan.board;
  Mesh plate = planned.plate;
  for (Eigen::Vector3f& vertex : plate.vertices_mm)
    vertex = (first * vertex.cast<double>()).cast<float>();
  const std::vector<SimulatedView> views{{0, 0.0}};
  return std::make_shared<SimulatedScene>(
      make_simulated_scene(plate, planned.scan.rig, views, options, first));
}

/// The rig that the simulation is; by default, the one that uses it.
Rig true_rig(DeviceSettings& settings, const Rig& known) {
  if (!settings.has("true_rig")) return known;
  Rig truth = read_rig(settings.path("true_rig"));
  if (truth.reference().model.width_px != known.reference().model.width_px ||
      truth.reference().model.height_px != known.reference().model.height_px)
    settings.fail("true_rig", "has a camera of another size; correct [camera] size_px");
  truth.reference().white_level = known.reference().white_level;
  truth.projector.response = known.projector.response;  // which its display compensates
  return truth;
}

/// What stands before the camera: a board, or the part as it is clamped in each setup.
class SceneOfSetups {
 public:
  SceneOfSetups(DeviceSettings& settings, const Rig& rig, SimulatedBench& bench)
      : tilt_rad_(rad_from_deg(settings.number_or("setup_tilt_deg", 180.0, -360.0, 360.0))),
        warm_up_mm_(settings.number_or("warm_up_mm", 0.0, -100.0, 100.0)),
        warm_up_s_(settings.number_or("warm_up_s", 60.0, 1e-3, 1e6)),
        warm_(rig.projector) {
    if (bench.board) {
      if (!rig.reference().name.empty())
        settings.fail("driver", "shows a simulated board to one camera; remove [[more_cameras]]");
      first_ = make_board_scene(settings, rig, bench);
      return;
    }
    part_ = read_part(settings);
    rig_ = rig;
    options_ = read_options(settings, rig);
    first_ = std::make_shared<SimulatedScene>(make(part_, Eigen::Isometry3d::Identity()));
  }

  /// Moves the projector to where it is at a time of the bench's clock.
  void warm_up(double clock_s) {
    if (warm_up_mm_ == 0.0) return;
    // In steps that frames hardly show, because each needs its light traced again. It ends where
    // the rig states it.
    constexpr double kSteps = 100.0;
    const double done = std::round(kSteps * -std::expm1(-clock_s / warm_up_s_)) / kSteps;
    for (const auto& scene : {first_, later_}) {
      if (scene) scene->rig.projector = drift(warm_, warm_up_mm_, done - 1.0);
    }
  }

  [[nodiscard]] std::shared_ptr<const SimulatedScene> of(int setup) {
    if (setup == 0 || part_.triangles.empty()) return first_;
    if (setup != later_setup_) {
      const double turn_rad =
          kTwoPi * uniform_from(hash(options_.seed, static_cast<std::uint64_t>(setup)));
      const Eigen::Isometry3d pose = pose_on_table(part_, setup * tilt_rad_, turn_rad);
      SimulatedScene scene = make(transform_mesh(part_, pose), pose);
      scene.exposure = first_->exposure;  // the camera does not adapt to another side of the part
      later_ = std::make_shared<SimulatedScene>(std::move(scene));
      later_setup_ = setup;
    }
    return later_;
  }

 private:
  [[nodiscard]] SimulatedScene make(const Mesh& part, const Eigen::Isometry3d& pose) const {
    // The brightest pixel of a full turn sets the exposure, independent of the plan's views.
    constexpr std::size_t kStations = 8;
    std::vector<SimulatedView> views;
    for (std::size_t i = 0; i < kStations; ++i)
      views.push_back({i, kTwoPi * static_cast<double>(i) / kStations});
    return make_simulated_scene(part, rig_, views, options_, pose);
  }

  Mesh part_;  ///< empty with a board
  Rig rig_;
  SimulateOptions options_;
  double tilt_rad_ = 0.0;    ///< from one setup to the next
  double warm_up_mm_ = 0.0;  ///< way of the projector until it is warm
  double warm_up_s_ = 60.0;  ///< after which 63 % of it are done
  Projector warm_;           ///< as the rig has it
  std::shared_ptr<SimulatedScene> first_;
  std::shared_ptr<SimulatedScene> later_;
  int later_setup_ = 0;
};

class SimulatedCamera final : public CameraDevice {
 public:
  SimulatedCamera(DeviceSettings& settings, const Rig& rig, BenchPtr bench)
      : bench_(std::move(bench)),
        faults_(read_faults(settings, {"lost", "incomplete", "saturated", "motion", "unplugged"})),
        real_time_(settings.flag_or("real_time", false)),
        late_frames_(static_cast<std::size_t>(settings.integer_or("late_frames", 0, 0, 100))),
        skip_frames_(static_cast<std::size_t>(settings.integer_or("skip_frames", 0, 0, 100))),
        scenes_(settings, true_rig(settings, rig), *bench_),
        reference_exposure_ms_(settings.number_or("reference_exposure_ms", 10.0, 1e-3, 1e5)) {
    const double mains_hz = settings.number_or("mains_hz", 0.0, 0.0, 1000.0);
    const double room_flicker = settings.number_or("room_flicker", 0.0, 0.0, 1.0);
    const int clips_at_counts = settings.integer_or("clips_at_counts", 0, 0, 65535);
    if (rig.reference().name.empty()) {  // it sets the bench for the others
      bench_->scene = scenes_.of(0);
      bench_->mains_hz = mains_hz;
      bench_->room_flicker = room_flicker;
      bench_->clips_at_counts = clips_at_counts;
    }
    info_.width_px = rig.reference().model.width_px;
    info_.height_px = rig.reference().model.height_px;
    info_.white_level = scenes_.of(0)->known_rig.reference().white_level;
    info_.min_exposure_ms = 1e-3;
    info_.max_gain_db = 24.0;
    info_.skip_frames = static_cast<int>(skip_frames_);
  }

  [[nodiscard]] std::string name() const override { return "simulated camera"; }
  [[nodiscard]] const CameraInfo& info() const override { return info_; }
  void make_safe() noexcept override {}

  [[nodiscard]] std::string test(const Deadline& /*deadline*/) override {
    if (unplugged_) fail_device(*this, "is unplugged; plug it in and scan again");
    return fmt::format("{} x {} pixels, white at {}, exposure {:.3g} ms",
                       info_.width_px,
                       info_.height_px,
                       info_.white_level,
                       bench_->camera.exposure_ms);
  }

  CameraSettings configure(const CameraSettings& settings, const Deadline& /*deadline*/) override {
    check_exposure(settings.exposure_ms);
    bench_->camera = settings;
    bench_->camera.gain_db = std::clamp(settings.gain_db, 0.0, info_.max_gain_db);
    return bench_->camera;
  }

  [[nodiscard]] CapturedFrame capture(const FrameLabel& label, const Deadline& deadline) override {
    deadline.check();
    const auto words = [&](const char* kind) {
      return std::vector<std::string>{
          kind, std::to_string(label.view), label.pattern, std::to_string(label.frame)};
    };
    unplugged_ = unplugged_ || faults_.triggers(words("unplugged"));
    if (unplugged_) fail_device(*this, "is unplugged; plug it in and scan again");
    if (faults_.triggers(words("lost"))) fail_device(*this, "no frame came; check its cable");
    CapturedFrame captured;
    captured.settings = bench_->camera;
    captured.id = ++taken_;
    if (real_time_) Deadline(deadline).sleep(1e-3 * bench_->camera.exposure_ms);
    captured.timestamp_s = bench_->clock_s;
    if (faults_.triggers(words("incomplete"))) {
      captured.complete = false;
      captured.incomplete_cause = "packets were lost";
      return captured;
    }
    FrameFaults faults;
    if (faults_.matches(words("saturated"))) faults.light = 8.0;
    if (label.attempt == 0 && faults_.matches(words("motion"))) faults.motion_rad = 0.5;
    SimulatedBench seen = *bench_;
    seen.scene = scenes_.of(label.setup);
    seen.reference_exposure_ms = reference_exposure_ms_;
    for (std::size_t i = 0; i <= skip_frames_; ++i) {
      seen.pictures = bench_->pictures;
      seen.clock_s = bench_->clock_s;
      scenes_.warm_up(bench_->clock_s);
      under_way_.push_back(camera_.capture(seen, label, faults));
      bench_->clock_s += 1e-3 * bench_->camera.exposure_ms;
      if (under_way_.size() > late_frames_ + 1) under_way_.pop_front();
    }
    captured.frame = under_way_.front();
    return captured;
  }

 private:
  BenchPtr bench_;
  FaultScript faults_;
  bool real_time_;           ///< an exposure takes its nominal time
  std::size_t late_frames_;  ///< exposures until a frame is delivered
  std::size_t skip_frames_;  ///< frames that a capture drops
  std::deque<Frame> under_way_;
  SceneOfSetups scenes_;
  double reference_exposure_ms_;
  CameraInfo info_;
  BenchCamera camera_;
  std::uint64_t taken_ = 0;
  bool unplugged_ = false;
};

}  // namespace

std::unique_ptr<CameraDevice> open_simulated_camera(DeviceSettings& settings,
                                                    const Rig& rig,
                                                    BenchPtr bench) {
  return std::make_unique<SimulatedCamera>(settings, rig, std::move(bench));
}

}  // namespace frangia

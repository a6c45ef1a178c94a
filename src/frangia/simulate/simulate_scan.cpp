#include "frangia/simulate/simulate_scan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/parallel.h"
#include "frangia/core/srgb.h"
#include "frangia/dataset/write_scan.h"
#include "frangia/files/ply.h"
#include "frangia/frames/png.h"
#include "frangia/geometry/transform_mesh.h"
#include "frangia/rig/rig.h"
#include "frangia/simulate/internal/move_views.h"
#include "frangia/simulate/internal/render_view.h"
#include "frangia/simulate/internal/simulated_scene.h"

namespace frangia {
namespace {

/// Marks the folder as an unfinished simulation. Only images in a marked folder are replaced.
std::filesystem::path claim(const std::filesystem::path& folder) {
  std::filesystem::path mark = folder / "simulation-not-finished";
  make_folder(folder);
  if (!std::filesystem::is_empty(folder) && !std::filesystem::exists(mark)) {
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: is not empty; name a new folder, or empty this one", folder.string()));
  }
  AtomicFile(mark).commit();
  std::filesystem::remove(folder / "scan.toml");
  return mark;
}

struct FrameFile {
  std::filesystem::path path;
  const Frame* frame;
  const FrameStack* stack;
};

/// The color of a stack in the depth of its frames.
RasterImage raster_of(const FrameStack& stack) {
  return std::visit(
      [&](const auto& grey) {
        using Sample = std::remove_cvref_t<decltype(grey.pixels()[0])>;
        Image<Sample> samples(3 * grey.width(), grey.height(), Uninitialized{});
        for (std::size_t i = 0; i < samples.pixels().size(); ++i) {
          const float light = stack.color.pixels()[i / 3][static_cast<Eigen::Index>(i % 3)];
          samples.pixels()[i] =
              static_cast<Sample>(std::lround(light * static_cast<float>(stack.white_level)));
        }
        return RasterImage{std::move(samples), 3};
      },
      stack.frames.front());
}

/// The part with the colors of its surface, as a screen shows them.
Mesh colored(Mesh part, double strength) {
  for (const Eigen::Vector3f& vertex : part.vertices_mm) {
    const Eigen::Vector3d color = surface_color(vertex.cast<double>(), strength);
    part.colors.push_back(
        {srgb_from_linear(color[0]), srgb_from_linear(color[1]), srgb_from_linear(color[2])});
  }
  return part;
}

/// Encoding a PNG takes longer than rendering it, so all frames of a view are encoded in parallel.
void write_frames(const std::filesystem::path& folder, const std::vector<FrameStack>& stacks) {
  std::vector<FrameFile> files;
  for (const FrameStack& stack : stacks) {
    for (std::size_t i = 0; i < stack.frames.size(); ++i) {
      files.push_back({folder / frame_file_name(stack.pattern, static_cast<int>(i), stack.exposure),
                       &stack.frames[i],
                       &stack});
    }
  }
  parallel_chunks(files.size(), 1, [&](std::size_t begin, std::size_t) {
    const FrameFile& file = files[begin];
    if (file.stack->color.empty()) {
      write_png(file.path, *file.frame);
    } else {
      write_png(file.path, raster_of(*file.stack));
    }
  });
}

/// A run whose progress is that of one view of `count`.
Run part_of(const Run& run, std::size_t index, std::size_t count) {
  Run part = run;
  if (run.progress) {
    part.progress = [&run, index, count](double done) {
      run.progress((static_cast<double>(index) + done) / static_cast<double>(count));
    };
  }
  return part;
}

/// The views of one setup and the scene with its part pose.
struct SimulatedSetup {
  std::vector<SimulatedView> views;
  std::vector<SimulatedScene> scenes;  ///< by camera
};

std::vector<SimulatedSetup> make_setups(const Mesh& part,
                                        const Scan& plan,
                                        const SimulateOptions& options,
                                        const Run& run) {
  std::map<int, std::vector<SimulatedView>> views;
  const double last = std::max(1.0, static_cast<double>(plan.views.size()) - 1.0);
  for (std::size_t i = 0; i < plan.views.size(); ++i) {
    views[plan.views[i].setup].push_back(
        {i, plan.views[i].angle_rad, static_cast<double>(i) / last});
  }
  std::vector<SimulatedSetup> setups;
  for (auto& [setup, stations] : views) {
    const auto part_pose = plan.part_poses.find(setup);
    const Mesh posed_part =
        part_pose == plan.part_poses.end() ? part : transform_mesh(part, part_pose->second);
    setups.push_back({std::move(stations), {}});
    for (std::size_t camera = 0; camera < plan.rig.cameras.size(); ++camera) {
      setups.back().scenes.push_back(make_simulated_scene(
          posed_part,
          plan.rig,
          setups.back().views,
          options,
          part_pose == plan.part_poses.end() ? Eigen::Isometry3d::Identity() : part_pose->second,
          run,
          camera));
    }
  }
  return setups;
}

void render_setup(SimulatedSetup& setup, const Scan& plan, const Run& run) {
  const std::size_t cameras = setup.scenes.size();
  for (const SimulatedView& view : setup.views) {
    Rig drifted = plan.rig;
    const double drift_mm = setup.scenes.front().options.motion.drift_mm;
    drifted.projector = drift(drifted.projector, drift_mm, view.drift_share);
    for (std::size_t camera = 0; camera < cameras; ++camera) {
      const Run view_run = part_of(run, view.index * cameras + camera, plan.views.size() * cameras);
      SimulatedScene& scene = setup.scenes[camera];
      scene.rig.projector = rig_of_camera(drifted, camera).projector;
      const std::filesystem::path folder =
          plan.folder / plan.views[view.index].folder / scene.known_rig.reference().name;
      const auto stacks = render_view(scene, plan.patterns, view, view_run);
      std::filesystem::remove_all(folder);  // with the folders of the further cameras
      make_folder(folder);
      write_frames(folder, stacks);
      run.check();
    }
  }
}

/// States the turntable as exact where no fault of it is simulated, as it is.
void state_turntable(Turntable& table, const SimulateOptions& options) {
  const auto state = [](double& sigma, double fault) {
    if (fault == 0.0 && std::isnan(sigma)) sigma = 0.0;
  };
  state(table.point_sigma_mm, options.axis_offset_mm);
  state(table.axis_sigma_rad, options.axis_tilt_rad);
  state(table.angle_sigma_rad, options.angle_error_rad);
}

}  // namespace

Eigen::Isometry3d pose_on_table(const Mesh& part, double tilt_rad, double turn_rad) {
  Eigen::Isometry3d part_pose = Eigen::Isometry3d::Identity();
  part_pose.linear() = (Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()) *
                        Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d::UnitX()))
                           .toRotationMatrix();
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : part.vertices_mm)
    box.extend(part_pose * vertex.cast<double>());
  part_pose.translation() = -box.center();
  part_pose.translation().z() = -box.min().z();
  return part_pose;
}

Scan simulate_scan(const Mesh& part,
                   const Scan& plan,
                   const SimulateOptions& options,
                   const Run& run) {
  require(!plan.patterns.empty() && !plan.views.empty(),
          "a scan needs at least one pattern and one view; add them to the plan");
  std::vector<SimulatedSetup> setups = make_setups(part, plan, options, run);
  const std::filesystem::path mark = claim(plan.folder);
  for (SimulatedSetup& setup : setups)
    render_setup(setup, plan, run);
  write_ply(plan.folder / "truth.ply", options.color > 0.0 ? colored(part, options.color) : part);
  if (!plan.part_poses.empty()) {
    write_part_poses(plan.folder / "truth-setups.toml", plan.part_poses);
  }
  Scan scan = plan;
  scan.rig = setups.front().scenes.front().known_rig;
  if (scan.rig.turntable) state_turntable(*scan.rig.turntable, options);
  scan.part_poses.clear();
  write_scan(scan);
  std::filesystem::remove(mark);
  return scan;
}

}  // namespace frangia

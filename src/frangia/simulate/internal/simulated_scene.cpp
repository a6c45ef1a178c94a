#include "frangia/simulate/internal/simulated_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/core/random.h"
#include "frangia/geometry/corner_normals.h"
#include "frangia/rig/rig.h"
#include "frangia/simulate/internal/gather_light.h"
#include "frangia/simulate/internal/light_sample.h"
#include "frangia/simulate/internal/move_views.h"
#include "frangia/simulate/internal/solid_builder.h"

namespace frangia {
namespace {

constexpr std::uint64_t kAxisStream = 1;
constexpr std::uint64_t kAngleStream = 2;

/// The exposure keeps this share of white for the brightest diffuse pixel.
constexpr double kBrightest = 0.8;

void check_range(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw Error(ErrorKind::Input,
              fmt::format("{} is {}; it must be from {} to {}", name, value, low, high));
}

void check(const SimulateOptions& options, const Rig& rig) {
  constexpr double kMany = 1e6;
  const bool known_depth =
      options.bits == 8 || options.bits == 10 || options.bits == 12 || options.bits == 16;
  if (!known_depth) {
    throw Error(ErrorKind::Input,
                fmt::format("bits is {}; a camera has 8, 10, 12 or 16", options.bits));
  }
  check_range("samples per pixel", options.samples_per_px, 1, 1024);
  check_range("full well", options.full_well_e, 10.0, 1e9);
  check_range("read noise", options.read_e, 0.0, kMany);
  check_range("exposure", options.exposure, 1e-6, kMany);
  check_range("ambient light", options.ambient, 0.0, 1.0);
  check_range("light of the backdrop", options.backdrop, 0.0, 1.0);
  check_range("strength of the color", options.color, 0.0, 0.95);
  check_range("contrast", options.contrast, 0.0, 1.0);
  check_range("step error", options.step_error, -0.9, 0.9);
  check_range("step jitter", options.step_jitter_rad, 0.0, kPi);
  check_range("display gamma", options.display_gamma, 0.1, 10.0);
  check_range("line width", options.line_sigma_mm, 1e-3, 100.0);
  check_range("line spill", options.line_spill, 0.0, 1.0);
  check_range("camera blur", options.camera_blur_px, 0.0, 20.0);
  check_range("size of the checker", options.checker_mm, 0.0, kMany);
  check_range("texture", options.texture, 0.0, 1.0);
  check_range("gloss", options.gloss, 0.0, 1000.0);
  check_range("shininess", options.shininess, 1.0, kMany);
  check_range("albedo", options.albedo, 0.0, 1.0);
  check_range("bounces", options.bounces, 0, 1);
  check_range("subsurface length", options.subsurface_mm, 0.0, kMany);
  check_range("speckle", options.speckle, 0.0, 1.0);
  check_range("speckle grain", options.speckle_grain_px, 0.0, 50.0);
  check_range("speckle correlation", options.speckle_correlation, 0.0, 1.0);
  check_range("angle error", options.angle_error_rad, 0.0, kPi);
  check_range("axis offset", options.axis_offset_mm, 0.0, kMany);
  check_range("axis tilt", options.axis_tilt_rad, 0.0, 0.5);
  check_range("turntable top radius", options.turntable_top_radius_mm, 0.0, kMany);
  check_range("slide of the part", options.motion.slide_mm, -100.0, 100.0);
  check_range("drift", options.motion.drift_mm, -100.0, 100.0);
  check_range("wobble", options.motion.wobble_mm, 0.0, 10.0);
  check_range("scale of the table", options.motion.table_scale, -10.0, 10.0);
  check_range("lost step", options.motion.lost_step_rad, -kPi, kPi);
  if (options.checker_mm > 0.0 && options.texture > 0.0)
    throw Error(ErrorKind::Input, "painted squares replace the texture: leave `texture` at 0");
  if (options.display_gamma != 1.0 && rig.projector.is_angular()) {
    throw Error(ErrorKind::Input,
                "display gamma is a fault of a digital projector, but the rig has an angular one; "
                "leave it at 1");
  }
  if (options.waveform != DisplayedWaveform::Sine && rig.projector.is_angular()) {
    throw Error(ErrorKind::Input,
                "binary and dithered patterns are those of a digital projector, but the rig has an "
                "angular one; leave `waveform` at sine");
  }
  if (rig.projector.is_label) {
    throw Error(
        ErrorKind::Input,
        "the rig's projector is a label, of which no fringes can be rendered; give its model "
        "and pose in rig.toml");
  }
  if (!rig.turntable) {
    throw Error(ErrorKind::Input,
                "the rig has no [turntable], which places the part; add it to rig.toml");
  }
}

/// The axis with an offset and a tilt in random directions. `point_mm` is its point nearest to the
/// given one, as the scan format defines for a refined axis.
Turntable true_turntable(const Turntable& given, const SimulateOptions& options) {
  const std::uint64_t stream = hash(options.seed, kAxisStream);
  const Eigen::Vector3d u = given.axis.unitOrthogonal();
  const auto across = [](const Eigen::Vector3d& axis, const Eigen::Vector3d& from, double angle) {
    return Eigen::Vector3d(Eigen::AngleAxisd(angle, axis) * from);
  };
  const Eigen::Vector3d hinge = across(given.axis, u, kTwoPi * uniform_from(hash(stream, 1)));
  Turntable real = given;
  real.axis = Eigen::AngleAxisd(options.axis_tilt_rad, hinge) * given.axis;
  const Eigen::Vector3d offset_direction =
      across(real.axis, real.axis.unitOrthogonal(), kTwoPi * uniform_from(hash(stream, 2)));
  real.point_mm += options.axis_offset_mm * offset_direction;
  return real;
}

/// White level and noise of a camera, as rig.toml states them.
void set_noise(Camera& camera, const SimulateOptions& options) {
  camera.white_level = (1 << options.bits) - 1;
  camera.noise.reset();
  if (!options.noise) return;
  camera.noise = NoiseModel::from_camera(options.full_well_e / camera.white_level, options.read_e);
}

Mesh with_turntable_top(const Mesh& part, double radius_mm) {
  if (radius_mm == 0.0) return part;
  constexpr double kThickness_mm = 6.0;
  const Loop high = circle(Eigen::Vector3d::Zero(), radius_mm, 360);
  const Loop low = circle({0.0, 0.0, -kThickness_mm}, radius_mm, 360);
  SolidBuilder turntable_top;
  turntable_top.add_fan(high, Eigen::Vector3d::Zero());
  turntable_top.add_band(low, high);
  turntable_top.add_fan({low.rbegin(), low.rend()}, {0.0, 0.0, -kThickness_mm});
  const Mesh disc = turntable_top.build();
  Mesh both;
  both.vertices_mm = part.vertices_mm;
  both.triangles = part.triangles;
  const auto first = static_cast<std::uint32_t>(part.vertices_mm.size());
  both.vertices_mm.insert(both.vertices_mm.end(), disc.vertices_mm.begin(), disc.vertices_mm.end());
  for (const auto& [a, b, c] : disc.triangles)
    both.triangles.push_back({first + a, first + b, first + c});
  return both;
}

/// The brightest diffuse light of a view, over every fourth pixel of every fourth row.
double brightest_of(const SimulatedScene& scene, const SimulatedView& view) {
  constexpr int kStride = 4;
  const Eigen::Isometry3d pose = true_pose(scene, view);
  std::vector<float> row_brightest(
      static_cast<std::size_t>((scene.rays.height() + kStride - 1) / kStride), 0.0F);
  parallel_rows(static_cast<int>(row_brightest.size()), [&](int row) {
    for (int x = 0; x < scene.rays.width(); x += kStride) {
      const Eigen::Vector2d ray = scene.rays(x, row * kStride).cast<double>();
      float& brightest = row_brightest[static_cast<std::size_t>(row)];
      constexpr double kTurn = 0.5;  // of the cells; any
      const auto gathered = static_cast<float>(total_light(gather_light(scene, pose, ray, kTurn)));
      const float direct =
          scene.options.subsurface_mm > 0.0 ? 0.0F : sample_light(scene, pose, ray).diffuse;
      brightest = std::max(brightest, direct + gathered);
    }
  });
  return static_cast<double>(*std::max_element(row_brightest.begin(), row_brightest.end()));
}

}  // namespace

Eigen::Isometry3d true_pose(const SimulatedScene& scene, const SimulatedView& view) {
  // The first view has no error: it defines the object frame.
  const double error =
      view.index == 0 ? 0.0
                      : scene.options.angle_error_rad *
                            normal_from(hash(hash(scene.options.seed, kAngleStream), view.index));
  return pose_with_motion(
      scene.rig, view.angle_rad + error, view.index, scene.options.motion, scene.options.seed);
}

SimulatedScene make_simulated_scene(const Mesh& part,
                                    const Rig& rig,
                                    std::span<const SimulatedView> views,
                                    const SimulateOptions& options,
                                    const Eigen::Isometry3d& part_pose,
                                    const Run& run,
                                    std::size_t camera) {
  require(!part.empty(), "the part has no triangles; give a surface, not points alone");
  check(options, rig);
  Mesh surface = with_turntable_top(part, options.turntable_top_radius_mm);
  auto normals = corner_normals(surface);
  SimulatedScene scene{.surface = RayScene(std::move(surface)),
                       .normals = std::move(normals),
                       .rig = rig,
                       .known_rig = rig,
                       .rays = rays_of(rig.reference().model),
                       .part_from_object = part_pose.inverse(),
                       .options = options};
  for (PosedCamera& posed : scene.known_rig.cameras)
    set_noise(posed.camera, options);
  scene.rig.turntable = true_turntable(*rig.turntable, options);
  if (camera > 0) {
    scene.camera = camera;
    scene.rig = rig_of_camera(scene.rig, camera);
    scene.known_rig = rig_of_camera(scene.known_rig, camera);
    scene.rays = rays_of(scene.rig.reference().model);
  }
  scene.working_distance_mm =
      (scene.rig.projector.position_mm - scene.rig.turntable->point_mm).norm();

  double brightest = 0.0;
  for (const SimulatedView& view : views) {
    run.check();
    brightest = std::max(brightest, brightest_of(scene, view));
  }
  const double headroom = std::max(kBrightest - options.ambient, 0.1);
  scene.exposure =
      options.exposure * headroom / (1.0 + options.contrast) / (brightest > 0.0 ? brightest : 1.0);
  return scene;
}

Mesh make_sheet(const Eigen::Vector2d& half) {
  constexpr double kThickness_mm = 3.0;
  const auto outline = [&](double z) {
    return Loop{{-half.x(), -half.y(), z},
                {half.x(), -half.y(), z},
                {half.x(), half.y(), z},
                {-half.x(), half.y(), z}};
  };
  const Loop face = outline(0.0);
  const Loop back = outline(kThickness_mm);
  SolidBuilder solid;
  solid.add_face(back);
  solid.add_band(face, back);
  solid.add_face({face.rbegin(), face.rend()});
  return solid.build();
}

Eigen::Vector3d surface_color(const Eigen::Vector3d& position_mm, double strength) {
  constexpr double kPeriod_mm = 40.0;
  const Eigen::Vector3d along(0.48, 0.36, 0.8);  // unit
  const double phase = kTwoPi * along.dot(position_mm) / kPeriod_mm;
  Eigen::Vector3d color;
  for (int channel = 0; channel < 3; ++channel)
    color[channel] = 1.0 - strength * (0.5 + 0.5 * std::cos(phase + kTwoPi * channel / 3.0));
  return color;
}

double luminance_of_color(const Eigen::Vector3d& color) {
  return Eigen::Vector3d(0.299, 0.587, 0.114).dot(color);
}

}  // namespace frangia

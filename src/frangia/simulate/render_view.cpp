#include "frangia/simulate/render_view.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>

#include <Eigen/LU>
#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/core/random.h"
#include "frangia/pattern/gray_code.h"
#include "frangia/simulate/light_sample.h"
#include "frangia/simulate/speckle.h"

namespace frangia {
namespace {

constexpr std::uint64_t kSpeckleStream = 11;
constexpr std::uint64_t kFrameStream = 12;

std::uint64_t hash_of(const std::string& text) {
  std::uint64_t value = 0;
  for (const char letter : text)
    value = hash(value, static_cast<unsigned char>(letter));
  return value;
}

void check(const Pattern& pattern, const Rig& rig) {
  const auto fail = [&](const char* why) {
    throw Error(ErrorKind::Input, fmt::format("pattern \"{}\" {}", pattern.name, why));
  };
  if (pattern.kind == PatternKind::Line) {
    if (!rig.line) fail("is a line, but the rig has no [line]");
    return;
  }
  if (pattern.kind == PatternKind::Ramp) return;
  if (pattern.kind == PatternKind::Gray) {
    if (rig.projector.is_angular()) fail("is Gray code, which an angular projector cannot show");
    if (pattern.bits < 1 || !(pattern.stripe_px > 0.0)) fail("needs bits and stripes above 0");
    return;
  }
  if (rig.projector.is_angular()) {
    if (!(pattern.fringes_per_degree > 0.0)) fail("needs fringes_per_degree above 0");
    if (pattern.direction == FringeDirection::Horizontal) {
      fail("is horizontal, but an angular projector's fringes are vertical");
    }
  } else if (!(pattern.period_px > 0.0)) {
    fail("needs a period_px above 0");
  }
}

/// How one frame is taken: what the projector really shows, and the noise's stream.
struct Shot {
  double cos_shift = 1.0;
  double sin_shift = 0.0;
  std::uint64_t stream = 0;
};

std::vector<Shot> shots_of(const Pattern& pattern,
                           const SimulatedView& view,
                           const SimulateOptions& options) {
  std::vector<Shot> shots(static_cast<std::size_t>(pattern.frame_count()));
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const std::uint64_t place = hash(hash(hash(options.seed, kFrameStream), view.index), i);
    shots[i].stream = hash(place, hash_of(pattern.name));
    if (pattern.kind != PatternKind::Fringe) continue;
    const double shift = pattern.shifts_rad[i] * (1.0 + options.step_error) +
                         options.step_jitter_rad * normal_from(hash(shots[i].stream, 1));
    shots[i].cos_shift = std::cos(shift);
    shots[i].sin_shift = std::sin(shift);
  }
  return shots;
}

/// Turns of the fringe at a place on the projector, in radians.
double phase_at(const Pattern& pattern, const LightSample& sample) {
  if (pattern.fringes_per_degree > 0.0) {
    return kTurn * pattern.fringes_per_degree * static_cast<double>(sample.u);
  }
  const bool vertical = pattern.direction == FringeDirection::Vertical;
  return kTurn * static_cast<double>(vertical ? sample.u : sample.v) / pattern.period_px;
}

/// What the projector makes of light that is asked of it: corrected by the rig's look-up table,
/// then bent by the display's gamma about the brightest value.
double shown(double linear, const SimulatedScene& scene) {
  const auto& response = scene.rig.projector.response;
  if (scene.options.display_gamma == 1.0 && !response) return linear;
  const double peak = 1.0 + scene.options.contrast;
  double level = std::max(linear, 0.0) / peak;
  if (response) level = response->level_of(level);
  return peak * std::pow(level, scene.options.display_gamma);
}

/// The light asked for in one frame that is no fringe.
double asked(const Pattern& pattern, int frame, const LightSample& sample, double contrast) {
  if (pattern.kind == PatternKind::Ramp)
    return (1.0 + contrast) * pattern.levels[static_cast<std::size_t>(frame)];
  const bool vertical = pattern.direction == FringeDirection::Vertical;
  return is_lit(pattern, frame, static_cast<double>(vertical ? sample.u : sample.v))
             ? 1.0 + contrast
             : 1.0 - contrast;
}

/// A share of white as the camera counts it.
int counts_of(double light, int white_level, std::uint64_t stream, const SimulateOptions& options) {
  if (options.noise) {
    const double electrons = std::max(light, 0.0) * options.full_well_e;
    const double sigma = std::sqrt(electrons + options.read_e * options.read_e);
    light = (electrons + sigma * normal_from(stream)) / options.full_well_e;
  }
  return static_cast<int>(std::lround(std::clamp(light, 0.0, 1.0) * white_level));
}

/// One view's light, row by row, and the frames it fills.
class ViewRenderer {
 public:
  ViewRenderer(const SimulatedScene& scene, const SimulatedView& view)
      : scene_(scene),
        options_(scene.options),
        pose_(true_pose(scene, view)),
        across_(static_cast<int>(std::ceil(std::sqrt(options_.samples_per_px)))),
        samples_per_px_(static_cast<std::size_t>(across_) * static_cast<std::size_t>(across_)) {
    if (options_.speckle > 0.0) {
      speckle_ =
          speckle_of(scene.rays.width(),
                     scene.rays.height(),
                     hash(hash(options_.seed, kSpeckleStream), view.index),
                     {options_.speckle, options_.speckle_grain_px, options_.speckle_correlation});
    }
  }

  /// All samples of one row, those of a pixel together.
  [[nodiscard]] std::vector<LightSample> row_of_samples(int y) const {
    std::vector<LightSample> samples;
    samples.reserve(static_cast<std::size_t>(scene_.rays.width()) * samples_per_px_);
    const Lens& lens = scene_.rig.camera.lens;
    for (int x = 0; x < scene_.rays.width(); ++x) {
      const Eigen::Vector2d center = scene_.rays(x, y).cast<double>();
      // Within a pixel the lens is linear: its slope spares an undistortion for each sample.
      Eigen::Matrix2d ray_from_px = Eigen::Matrix2d::Zero();
      if (across_ > 1) {
        ray_from_px =
            lens.distort_jacobian(center).inverse() * lens.focal_px.cwiseInverse().asDiagonal();
      }
      for (int row = 0; row < across_; ++row) {
        for (int column = 0; column < across_; ++column) {
          const Eigen::Vector2d offset((column + 0.5) / across_ - 0.5, (row + 0.5) / across_ - 0.5);
          samples.push_back(sample_light(scene_, pose_, center + ray_from_px * offset));
        }
      }
    }
    return samples;
  }

  /// Fills row y of all frames of one pattern.
  template <typename T>
  void fill_row(int y,
                const std::vector<LightSample>& samples,
                const std::vector<Shot>& shots,
                FrameStack& stack) const {
    std::vector<double> light(shots.size());
    for (int x = 0; x < scene_.rays.width(); ++x) {
      const std::size_t first = static_cast<std::size_t>(x) * samples_per_px_;
      gather(
          stack.pattern, {samples.data() + first, samples_per_px_}, shots, speckle_at(x, y), light);
      const auto pixel = (static_cast<std::uint64_t>(y) << 32U) | static_cast<std::uint64_t>(x);
      for (std::size_t i = 0; i < shots.size(); ++i) {
        std::get<Image<T>>(stack.frames[i])(x, y) = static_cast<T>(counts_of(
            light[i] * stack.gain(), stack.white_level, hash(shots[i].stream, pixel), options_));
      }
    }
  }

 private:
  [[nodiscard]] Speckle speckle_at(int x, int y) const {
    return speckle_.empty() ? Speckle{} : speckle_(x, y);
  }

  /// The mean light of a pixel's samples in each frame, as a share of white.
  void gather(const Pattern& pattern,
              std::span<const LightSample> samples,
              const std::vector<Shot>& shots,
              const Speckle& speckle,
              std::vector<double>& light) const {
    std::fill(light.begin(), light.end(), 0.0);
    for (const LightSample& sample : samples) {
      if (sample.albedo == 0.0F) continue;
      const double other = options_.ambient * static_cast<double>(sample.albedo);
      const double lit = scene_.exposure * static_cast<double>(sample.lit() * speckle.gain);
      if (pattern.kind == PatternKind::Line) {
        const double peak = 1.0 + options_.contrast;
        light[0] +=
            other + lit * peak * std::max(static_cast<double>(sample.line), options_.line_spill);
        continue;
      }
      if (pattern.kind != PatternKind::Fringe) {
        for (std::size_t i = 0; i < light.size(); ++i)
          light[i] +=
              other +
              lit * shown(asked(pattern, static_cast<int>(i), sample, options_.contrast), scene_);
        continue;
      }
      const double phase = phase_at(pattern, sample);
      const std::complex<double> fringe = std::complex<double>(speckle.fringe) *
                                          std::complex<double>(std::cos(phase), std::sin(phase));
      for (std::size_t i = 0; i < shots.size(); ++i) {
        const double cosine =
            fringe.real() * shots[i].cos_shift - fringe.imag() * shots[i].sin_shift;
        light[i] += other + lit * shown(1.0 + options_.contrast * cosine, scene_);
      }
    }
    for (double& value : light)
      value /= static_cast<double>(samples.size());
  }

  const SimulatedScene& scene_;
  const SimulateOptions& options_;
  Eigen::Isometry3d pose_;
  int across_;
  std::size_t samples_per_px_;
  Image<Speckle> speckle_;
};

FrameStack empty_stack(const Pattern& pattern, int exposure, const SimulatedScene& scene) {
  FrameStack stack{pattern, {}, scene.known_rig.camera.white_level, exposure};
  const int width = scene.rays.width();
  const int height = scene.rays.height();
  for (int i = 0; i < pattern.frame_count(); ++i) {
    if (scene.options.bits == 8) {
      stack.frames.emplace_back(Image<std::uint8_t>(width, height));
    } else {
      stack.frames.emplace_back(Image<std::uint16_t>(width, height));
    }
  }
  return stack;
}

}  // namespace

std::vector<FrameStack> render_view(const SimulatedScene& scene,
                                    std::span<const Pattern> patterns,
                                    const SimulatedView& view,
                                    const Run& run) {
  std::vector<FrameStack> stacks;
  std::vector<std::vector<Shot>> shots;
  for (const Pattern& pattern : patterns) {
    check(pattern, scene.rig);
    for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure) {
      stacks.push_back(empty_stack(pattern, exposure, scene));
      shots.push_back(shots_of(pattern, view, scene.options));
      for (Shot& shot : shots.back())
        if (exposure > 0) shot.stream = hash(shot.stream, static_cast<std::uint64_t>(exposure));
    }
  }
  const ViewRenderer renderer(scene, view);
  constexpr int kBand = 64;  // rows between two looks at whether to stop
  for (int done = 0; done < scene.rays.height(); done += kBand) {
    const int size = std::min(kBand, scene.rays.height() - done);
    parallel_rows(size, [&](int row) {
      const int y = done + row;
      const std::vector<LightSample> samples = renderer.row_of_samples(y);
      for (std::size_t i = 0; i < stacks.size(); ++i) {
        if (scene.options.bits == 8) {
          renderer.fill_row<std::uint8_t>(y, samples, shots[i], stacks[i]);
        } else {
          renderer.fill_row<std::uint16_t>(y, samples, shots[i], stacks[i]);
        }
      }
    });
    run.report(static_cast<double>(done + size) / scene.rays.height());
  }
  return stacks;
}

}  // namespace frangia

#include "frangia/simulate/internal/render_view.h"

#include <cmath>
#include <complex>
#include <functional>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/rig_presets.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

constexpr SimulatedView kFront{0, 0.1};

SimulateOptions clean(int bits = 16) {
  SimulateOptions options;
  options.noise = false;
  options.bits = bits;
  return options;
}

/// What the frames of evenly shifted fringes hold: offset, and modulation and phase as a complex
/// number, in shares of white.
struct Decoded {
  double mean;
  std::complex<double> fringe;
};

Decoded decode(const FrameStack& stack, int x, int y) {
  Decoded out{0.0, 0.0};
  const auto count = static_cast<double>(stack.frames.size());
  for (std::size_t i = 0; i < stack.frames.size(); ++i) {
    const double light = static_cast<double>(counts_at(stack.frames[i], x, y)) / stack.white_level;
    out.mean += light / count;
    out.fringe += 2.0 / count * light * std::polar(1.0, -stack.pattern.shifts_rad[i]);
  }
  return out;
}

/// Where the pixel's ray meets the plate's front, x = 3 of the object frame.
std::optional<Eigen::Vector3d> point_on_plate(const Rig& rig, double angle_rad, int x, int y) {
  const Eigen::Isometry3d pose = rig.rig_from_object(angle_rad);
  const Eigen::Vector3d ray = rig.reference().model.ray(Eigen::Vector2d(x, y)).homogeneous();
  const Eigen::Vector3d normal = pose.linear() * Eigen::Vector3d::UnitX();
  const double depth = normal.dot(pose * Eigen::Vector3d(3.0, 0.0, 0.0)) / normal.dot(ray);
  const Eigen::Vector3d p = pose.inverse() * Eigen::Vector3d(depth * ray);
  if (std::abs(p.y()) > 39.5 || p.z() < 0.5 || p.z() > 59.5) return std::nullopt;
  return depth * ray;
}

double phase_of(const Rig& rig, const Pattern& pattern, const Eigen::Vector3d& point) {
  const Eigen::Vector3d p = rig.projector.from_rig(point);
  if (rig.projector.is_angular()) {
    return kTwoPi * pattern.fringes_per_degree * deg_from_rad(std::atan2(p.x(), p.z()));
  }
  const Eigen::Vector2d pixel = std::get<PinholeModel>(rig.projector.model).project(p);
  return kTwoPi * (pattern.direction == FringeDirection::Vertical ? pixel.x() : pixel.y()) /
         pattern.period_px;
}

TEST(RenderView, HoldsThePhaseOfTheScanFormat) {
  for (const std::string& name : rig_preset_names()) {
    const Rig rig = rig_preset(name);
    auto patterns = default_patterns(rig);
    if (name == "digital") {
      patterns.push_back(patterns.back());
      patterns.back().name = "rows";
      patterns.back().direction = FringeDirection::Horizontal;
    }
    const auto scene = make_simulated_scene(make_plate(), rig, std::span(&kFront, 1), clean());
    const auto stacks = render_view(scene, patterns, kFront);
    int checked = 0;
    for (const FrameStack& stack : stacks) {
      if (stack.pattern.kind == PatternKind::Line) continue;
      for (int y = 0; y < rig.reference().model.height_px; y += 5) {
        for (int x = 0; x < rig.reference().model.width_px; x += 5) {
          const auto point = point_on_plate(rig, kFront.angle_rad, x, y);
          if (!point) continue;
          const Decoded pixel = decode(stack, x, y);
          const double expected = phase_of(rig, stack.pattern, *point);
          ASSERT_NEAR(wrap_rad(std::arg(pixel.fringe) - expected), 0.0, 1e-4)
              << name << " " << stack.pattern.name << " at " << x << ", " << y;
          ASSERT_NEAR(std::abs(pixel.fringe) / pixel.mean, 0.9, 1e-3);
          ++checked;
        }
      }
    }
    EXPECT_GT(checked, 500) << name;
  }
}

TEST(RenderView, IsBrightestAtFourFifthsOfWhite) {
  const Rig rig = rig_preset("carducci");
  const auto patterns = default_patterns(rig);
  const auto scene = make_simulated_scene(make_plate(), rig, std::span(&kFront, 1), clean());
  const auto stacks = render_view(scene, patterns, kFront);
  int brightest = 0;
  for (const Frame& frame : stacks[0].frames) {
    for (const auto value : std::get<Image<std::uint16_t>>(frame).pixels())
      brightest = std::max(brightest, static_cast<int>(value));
  }
  EXPECT_NEAR(brightest / 65535.0, 0.8, 0.01);
  EXPECT_EQ(stacks[0].white_level, 65535);
}

TEST(RenderView, PutsTheLineWhereTheLaserSheetCutsThePart) {
  const Rig rig = rig_preset("angular");
  const auto patterns = default_patterns(rig);
  const auto scene = make_simulated_scene(make_plate(), rig, std::span(&kFront, 1), clean());
  const FrameStack line = render_view(scene, patterns, kFront)[1];
  for (int y = 270; y < 360; y += 10) {
    double sum = 0.0;
    double sum_x = 0.0;
    for (int x = 0; x < 512; ++x) {
      const double light = std::max(0, counts_at(line.frames[0], x, y) - 6000);
      sum += light;
      sum_x += light * x;
    }
    if (sum == 0.0) continue;
    const auto point = point_on_plate(rig, kFront.angle_rad, static_cast<int>(sum_x / sum), y);
    ASSERT_TRUE(point);
    EXPECT_NEAR(rig.laser_sheet->normal.dot(*point), rig.laser_sheet->offset_mm, 0.5)
        << "one pixel is 0.5 mm";
  }
}

TEST(RenderView, LeavesShadowsDark) {
  // A wall in front of the plate hides the projector's light from a part that the camera sees.
  Mesh part = testing::box({-3, -40, 0}, {3, 40, 60});
  const Mesh wall = testing::box({30, 10, 0}, {34, 14, 60});
  for (const auto& [a, b, c] : wall.triangles)
    part.triangles.push_back({a + 8, b + 8, c + 8});
  part.vertices_mm.insert(part.vertices_mm.end(), wall.vertices_mm.begin(), wall.vertices_mm.end());
  const Rig rig = rig_preset("carducci");
  const SimulatedView front{0, 0.0};
  const auto patterns = default_patterns(rig);
  const auto scene = make_simulated_scene(part, rig, std::span(&front, 1), clean());
  const auto stacks = render_view(scene, patterns, front);
  int dark = 0;
  int lit = 0;
  for (int x = 0; x < 512; ++x) {
    const auto point = point_on_plate(rig, 0.0, x, 255);
    if (!point) continue;
    const Eigen::Isometry3d object_from_rig = rig.rig_from_object(0.0).inverse();
    const Eigen::Vector3d p = object_from_rig * *point;
    const Eigen::Vector3d light = object_from_rig * rig.projector.position_mm;
    const auto y_at = [&](const Eigen::Vector3d& eye, double at_x) {
      return p.y() + (eye.y() - p.y()) * (at_x - p.x()) / (eye.x() - p.x());
    };
    const Eigen::Vector3d camera = object_from_rig.translation();
    const auto clear = [&](const Eigen::Vector3d& eye, double margin) {
      const auto [low, high] = std::minmax({y_at(eye, 30.0), y_at(eye, 34.0)});
      return high < 10.0 - margin || low > 14.0 + margin;
    };
    if (!clear(camera, 0.5)) continue;  // the pixel sees the wall, not the plate
    const double mean = decode(stacks[0], x, 255).mean;
    if (clear(light, 0.5)) {
      EXPECT_GT(mean, 0.1) << x;
      ++lit;
    } else if (!clear(light, 0.0)) {
      EXPECT_EQ(mean, 0.0) << x;
      ++dark;
    }
  }
  EXPECT_GT(lit, 50);
  EXPECT_GT(dark, 5);
}

TEST(RenderView, NoiseIsThatOfTheCamera) {
  SimulateOptions options;
  options.bits = 12;
  options.full_well_e = 5000.0;
  options.read_e = 10.0;
  const Rig rig = rig_preset("carducci");
  const auto patterns = default_patterns(rig);
  const auto noisy = make_simulated_scene(make_plate(), rig, std::span(&kFront, 1), options);
  options.noise = false;
  const auto silent = make_simulated_scene(make_plate(), rig, std::span(&kFront, 1), options);
  const auto a = render_view(noisy, patterns, kFront)[0];
  const auto b = render_view(silent, patterns, kFront)[0];
  EXPECT_EQ(a.white_level, 4095);
  double chi2 = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (int y = 0; y < 512; ++y) {
      for (int x = 0; x < 512; ++x) {
        const int truth = counts_at(b.frames[i], x, y);
        if (truth < 200) continue;
        const double error = counts_at(a.frames[i], x, y) - truth;
        chi2 += error * error / noisy.known_rig.reference().noise->variance(truth);
        ++count;
      }
    }
  }
  EXPECT_NEAR(chi2 / count, 1.0, 0.02);
}

TEST(RenderView, GivesTheSameBytesForAnyNumberOfThreadsAndAnyChoiceOfPatterns) {
  SimulateOptions options;
  options.samples_per_px = 4;
  options.speckle = 0.2;
  options.speckle_correlation = 0.9;
  options.texture = 0.5;
  options.gloss = 0.3;
  const Rig rig = rig_preset("carducci");
  const auto patterns = default_patterns(rig);
  const auto render = [&](std::span<const Pattern> chosen) {
    const auto scene = make_simulated_scene(make_bracket(), rig, std::span(&kFront, 1), options);
    return render_view(scene, chosen, kFront);
  };
  const auto many = render(patterns);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto single = render(patterns);
  const auto line_only = render(std::span(patterns).subspan(1));
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t i = 0; i < many[k].frames.size(); ++i) {
      const auto& a = std::get<Image<std::uint8_t>>(many[k].frames[i]);
      const auto& b = std::get<Image<std::uint8_t>>(single[k].frames[i]);
      EXPECT_TRUE(std::equal(a.pixels().begin(), a.pixels().end(), b.pixels().begin()));
    }
  }
  const auto& a = std::get<Image<std::uint8_t>>(many[1].frames[0]);
  const auto& b = std::get<Image<std::uint8_t>>(line_only[0].frames[0]);
  EXPECT_TRUE(std::equal(a.pixels().begin(), a.pixels().end(), b.pixels().begin()));
}

TEST(RenderView, MixesThePixelsOfAnEdge) {
  SimulateOptions options = clean();
  const Rig rig = rig_preset("carducci");
  const auto patterns = default_patterns(rig);
  const SimulatedView front{0, 0.0};
  const auto sharp = make_simulated_scene(make_plate(), rig, std::span(&front, 1), options);
  options.samples_per_px = 16;
  const auto mixed = make_simulated_scene(make_plate(), rig, std::span(&front, 1), options);
  const auto values_between = [&](const SimulatedScene& scene) {
    const auto stack = render_view(scene, patterns, front)[0];
    const auto mean = [&](int x) { return decode(stack, x, 300).mean; };
    int count = 0;
    // Along a row: evenly lit on the plate, dark beside it, half-lit only where they mix.
    for (int x = 256; x < 450; ++x) {
      if (mean(x) > 0.01 && mean(x) < 0.9 * mean(x - 1) && mean(x + 1) < 0.01) ++count;
    }
    return count;
  };
  EXPECT_EQ(values_between(sharp), 0);
  EXPECT_EQ(values_between(mixed), 1);
}

TEST(RenderView, TheStepErrorStretchesEveryShift) {
  SimulateOptions options = clean();
  options.step_error = 0.05;
  const Rig rig = rig_preset("carducci");
  const auto patterns = default_patterns(rig);
  const auto stretched = make_simulated_scene(make_plate(), rig, std::span(&kFront, 1), options);
  const auto exact = make_simulated_scene(make_plate(), rig, std::span(&kFront, 1), clean());
  FrameStack told = render_view(stretched, patterns, kFront)[0];
  const FrameStack truth = render_view(exact, patterns, kFront)[0];
  // I_i / I0 = 1 + 0.9 cos(phi + 1.05 sigma_i), phi and I0 from the exact frames.
  for (int y = 200; y < 240; y += 5) {
    for (int x = 200; x < 300; x += 5) {
      const Decoded pixel = decode(truth, x, y);
      if (pixel.mean < 0.1) continue;
      for (std::size_t i = 0; i < 4; ++i) {
        const double phase = std::arg(pixel.fringe) + 1.05 * told.pattern.shifts_rad[i];
        EXPECT_NEAR(counts_at(told.frames[i], x, y) / 65535.0,
                    pixel.mean * (1.0 + 0.9 * std::cos(phase)),
                    2e-4);
      }
    }
  }
}

TEST(RenderView, RefusesPatternsThatTheRigCannotShow) {
  Rig rig = rig_preset("carducci");
  const auto patterns = default_patterns(rig);
  rig.laser_sheet.reset();
  const auto scene = make_simulated_scene(make_plate(), rig, std::span(&kFront, 1));
  EXPECT_THROW(static_cast<void>(render_view(scene, patterns, kFront)), Error);
  const auto pinhole = default_patterns(rig_preset("digital"));
  EXPECT_THROW(static_cast<void>(render_view(scene, pinhole, kFront)), Error);
}

}  // namespace
}  // namespace frangia

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "frangia/core/angles.h"
#include "frangia/service/internal/array_packer.h"
#include "frangia/service/live_preview.h"

namespace frangia {
namespace {

constexpr int kMostColumns = 960;
constexpr std::size_t kMostPreviewPoints = 40'000;
constexpr std::size_t kBins = 64;
constexpr float kByteSpan = 254.0F;  // 1 to 255; 0 stands for a missing value

using Bytes = Image<std::uint8_t>;

/// A picture of every `step`-th pixel.
template <typename Value>
Bytes reduced(int width, int height, const Value& value) {
  const int step = (width + kMostColumns - 1) / kMostColumns;
  Bytes picture((width + step - 1) / step, (height + step - 1) / step);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x)
      picture(x, y) = value(x * step, y * step);
  }
  return picture;
}

/// 1 to 255 within the limits; 0 for NaN.
std::uint8_t byte_of(float value, float low, float high) {
  if (std::isnan(value)) return 0;
  const float share = std::clamp((value - low) / std::max(high - low, 1e-6F), 0.0F, 1.0F);
  return static_cast<std::uint8_t>(1.5F + share * (kByteSpan - 0.01F));
}

/// The curve of sRGB, IEC 61966-2-1: screens show light that grows with the counts by it.
double srgb_of(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

/// The byte of each pixel value up to white; 255 is white alone.
std::vector<std::uint8_t> display_curve(int white_level) {
  constexpr double kBelowWhite = 254.0;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(white_level) + 1, 255);
  for (std::size_t counts = 0; counts + 1 < bytes.size(); ++counts) {
    const double linear = static_cast<double>(counts) / white_level;
    bytes[counts] = static_cast<std::uint8_t>(std::lround(kBelowWhite * srgb_of(linear)));
  }
  return bytes;
}

Bytes camera_picture(const LiveSnapshot& snapshot) {
  const std::vector<std::uint8_t> curve = display_curve(std::max(1, snapshot.white_level));
  return std::visit(
      [&](const auto& image) {
        return reduced(image.width(), image.height(), [&](int x, int y) {
          return curve[std::min<std::size_t>(image(x, y), curve.size() - 1)];
        });
      },
      *snapshot.frame);
}

struct LightShares {
  std::vector<std::uint32_t> histogram = std::vector<std::uint32_t>(kBins);
  double saturated = 0.0;  ///< of all pixels
  double dark = 0.0;       ///< of those of the part; of all where it is not known
};

/// The part: pixels that lie between measured ones, both in their row and in their column. Empty
/// where nothing is measured, or where the frame has another size.
Image<std::uint8_t> part_in(const LiveSnapshot& snapshot) {
  if (!snapshot.decode || snapshot.decode->points == 0) return {};
  const Image<float>& depth = snapshot.decode->range.depth_mm;
  const int width = depth.width();
  const int height = depth.height();
  struct Span {
    int first = std::numeric_limits<int>::max();
    int last = -1;
    void take(int at) {
      first = std::min(first, at);
      last = std::max(last, at);
    }
    [[nodiscard]] bool holds(int at) const { return first <= at && at <= last; }
  };
  std::vector<Span> of_row(static_cast<std::size_t>(height));
  std::vector<Span> of_column(static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (std::isnan(depth(x, y))) continue;
      of_row[static_cast<std::size_t>(y)].take(x);
      of_column[static_cast<std::size_t>(x)].take(y);
    }
  }
  Image<std::uint8_t> part(width, height, 0);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool inside = of_row[static_cast<std::size_t>(y)].holds(x) &&
                          of_column[static_cast<std::size_t>(x)].holds(y);
      part(x, y) = inside ? 1 : 0;
    }
  }
  return part;
}

LightShares light_of(const LiveSnapshot& snapshot) {
  LightShares light;
  const Image<std::uint8_t> part = part_in(snapshot);
  std::visit(
      [&](const auto& image) {
        const bool part_known = part.width() == image.width() && part.height() == image.height();
        const auto white = static_cast<std::size_t>(snapshot.white_level);
        std::size_t saturated = 0;
        std::size_t dark = 0;
        std::size_t lit = 0;
        const auto pixels = image.pixels();
        for (std::size_t i = 0; i < pixels.size(); ++i) {
          const std::size_t value = pixels[i];
          ++light.histogram[std::min(kBins - 1, value * kBins / (white + 1))];
          saturated += value >= white ? 1 : 0;
          if (part_known && part.pixels()[i] == 0) continue;
          ++lit;
          dark += value * 100 < white ? 1 : 0;  // below a hundredth of white
        }
        const auto all = static_cast<double>(std::max<std::size_t>(1, image.pixels().size()));
        light.saturated = static_cast<double>(saturated) / all;
        light.dark = static_cast<double>(dark) / static_cast<double>(std::max<std::size_t>(1, lit));
      },
      *snapshot.frame);
  return light;
}

/// Limits that leave out a fiftieth of the values at both ends.
std::array<float, 2> limits_of(const Image<float>& image) {
  constexpr std::size_t kSamples = 20'000;
  std::vector<float> values;
  const auto pixels = image.pixels();
  for (std::size_t i = 0; i < pixels.size(); i += pixels.size() / kSamples + 1)
    if (!std::isnan(pixels[i])) values.push_back(pixels[i]);
  if (values.empty()) return {0.0F, 1.0F};
  std::sort(values.begin(), values.end());
  const std::size_t margin = values.size() / 50;
  return {values[margin], values[values.size() - 1 - margin]};
}

struct Layer {
  Bytes picture;
  std::array<float, 2> limits = {0.0F, 1.0F};
};

Layer picture_of(const LiveSnapshot& snapshot, LiveLayer layer) {
  if (layer == LiveLayer::Camera || !snapshot.decode) return {camera_picture(snapshot)};
  const LiveDecode& decode = *snapshot.decode;
  const DecodedDirection& leading = decode.view.directions.front();
  const Image<PixelStatus>& status = leading.phase.status;
  if (layer == LiveLayer::Status) {
    return {reduced(status.width(), status.height(), [&](int x, int y) {
      return static_cast<std::uint8_t>(status(x, y));
    })};
  }
  if (layer == LiveLayer::Depth) {
    const Image<float>& depth = decode.range.depth_mm;
    const auto limits = limits_of(depth);
    return {reduced(depth.width(),
                    depth.height(),
                    [&](int x, int y) { return byte_of(depth(x, y), limits[0], limits[1]); }),
            limits};
  }
  if (leading.wrapped.empty()) return {};
  const WrappedPhase& finest = leading.wrapped.back();
  const auto half_turn = static_cast<float>(kPi);
  const std::array<float, 2> limits =
      layer == LiveLayer::Phase ? std::array{-half_turn, half_turn}
                                : std::array{0.0F, 0.5F * static_cast<float>(snapshot.white_level)};
  const Image<float>& values =
      layer == LiveLayer::Phase ? finest.phase_rad : finest.modulation_counts;
  return {reduced(values.width(),
                  values.height(),
                  [&](int x, int y) { return byte_of(values(x, y), limits[0], limits[1]); }),
          limits};
}

void add_points(const LiveDecode& decode, const Rig& rig, ArrayPacker& packer) {
  std::vector<float> positions;
  const std::size_t step = decode.points / (kMostPreviewPoints + 1) + 1;
  std::size_t number = 0;
  const Image<float>& depth = decode.range.depth_mm;
  const Eigen::Isometry3d object_from_rig = rig.rig_from_object(decode.angle_rad).inverse();
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 0; x < depth.width(); ++x) {
      if (std::isnan(depth(x, y)) || number++ % step != 0) continue;
      const Eigen::Vector2d ray = rig.reference().model.ray(Eigen::Vector2d(x, y));
      const Eigen::Vector3f point =
          (object_from_rig * (Eigen::Vector3d(ray.x(), ray.y(), 1.0) * depth(x, y))).cast<float>();
      positions.insert(positions.end(), {point.x(), point.y(), point.z()});
    }
  }
  packer.add("positions", "float32", positions.data(), positions.size());
}

}  // namespace

std::string encode_live(const LiveSnapshot& snapshot, LiveLayer layer, const Rig& rig) {
  static constexpr std::array kNames = {
      "none", "camera", "phase", "modulation", "status", "depth", "points"};
  ArrayPacker packer;
  const LightShares light = light_of(snapshot);
  const LiveDecode* decode = snapshot.decode.get();
  const bool as_camera = layer != LiveLayer::Camera && decode == nullptr;
  nlohmann::ordered_json values{
      {"revision", snapshot.revision},
      {"layer", kNames.at(static_cast<std::size_t>(as_camera ? LiveLayer::Camera : layer))}};
  Layer picture;
  if (layer == LiveLayer::Points && decode != nullptr) {
    add_points(*decode, rig, packer);
  } else {
    picture = picture_of(snapshot, layer);
    packer.add(
        "picture", "uint8", picture.picture.pixels().data(), picture.picture.pixels().size());
  }
  packer.add("histogram", "uint32", light.histogram.data(), light.histogram.size());
  std::vector<float> corners;
  const int step = (width_of(*snapshot.frame) + kMostColumns - 1) / kMostColumns;
  for (const Eigen::Vector2d& corner : snapshot.corners_px) {
    for (const double value : corner)
      corners.push_back(static_cast<float>(value / step));
  }
  packer.add("corners", "float32", corners.data(), corners.size());
  values["width"] = picture.picture.width();
  values["height"] = picture.picture.height();
  values["low"] = picture.limits[0];
  values["high"] = picture.limits[1];
  values["frames_per_s"] = snapshot.frames_per_s;
  values["decodes_per_s"] = snapshot.decodes_per_s;
  values["decode_ms"] = decode != nullptr ? decode->decode_ms : 0.0;
  const std::vector<FrameAssessment> assessments =
      decode != nullptr ? assessments_of(decode->view) : std::vector<FrameAssessment>();
  values["contrast"] = assessments.empty() ? 0.0 : assessments.back().contrast;
  values["saturated"] = light.saturated;
  values["dark"] = light.dark;
  values["points"] = decode != nullptr ? decode->points : 0;
  values["finding"] = decode != nullptr ? decode->finding : "";
  packer.set_values(std::move(values));
  return packer.pack();
}

}  // namespace frangia

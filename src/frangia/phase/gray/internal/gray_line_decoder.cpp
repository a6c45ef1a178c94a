#include "frangia/phase/gray/internal/gray_line_decoder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <optional>

namespace frangia {

StripeBorder GrayLineDecoder::border_after(std::size_t i) const {
  const auto change = code_of_stripe(code_, static_cast<std::uint32_t>(stripes_[i])) ^
                      code_of_stripe(code_, static_cast<std::uint32_t>(stripes_[i + 1]));
  // Of a binary code several bits change; the first of them has the widest stripes.
  const std::size_t bit = bits_ - static_cast<std::size_t>(std::bit_width(change));
  const auto at = [&](std::size_t pixel) -> const Margin& { return margins_[pixel * bits_ + bit]; };
  const double step = std::abs(at(i).counts - at(i + 1).counts);
  // The light of the stripes themselves, a little farther from the border.
  constexpr std::size_t kBeside = 2;
  double before = 0.0;
  double after = 0.0;
  for (std::size_t k = 0; k <= kBeside; ++k) {
    if (i >= k && stripes_[i - k] == stripes_[i])
      before = std::max(before, std::abs(at(i - k).counts));
    if (i + 1 + k < stripes_.size() && stripes_[i + 1 + k] == stripes_[i + 1])
      after = std::max(after, std::abs(at(i + 1 + k).counts));
  }
  StripeBorder out;
  out.at_pixel = i;
  out.column = static_cast<double>(std::max(stripes_[i], stripes_[i + 1])) * code_.stripe_px - 0.5 -
               code_.offset_px;
  out.sharpness = std::min(step / (before + after), 1.0);
  if (place_by_light(i, bit, out)) return out;
  const double share = std::abs(at(i).counts) / step;
  out.at = static_cast<double>(i) + share;
  out.noise_px = std::hypot((1.0 - share) * at(i).sigma, share * at(i + 1).sigma) / step;
  // Linear interpolation between the two pixels is wrong by up to 0.086 px.
  out.width_px =
      place_sigma_px(out.sharpness, std::hypot(place_px_, 0.13 * out.sharpness * out.sharpness));
  return out;
}

bool GrayLineDecoder::place_by_light(std::size_t i, std::size_t bit, StripeBorder& out) const {
  constexpr std::ptrdiff_t kBeside = 1;  // pixels beyond the two at the border
  constexpr double kFull = 0.85;         // of the contrast, where the blur ends
  const double sign = margins_[i * bits_ + bit].counts > 0.0 ? 1.0 : -1.0;
  double place = static_cast<double>(i) - kBeside - 0.5;
  double variance = 0.0;
  for (std::ptrdiff_t d = -kBeside; d <= 1 + kBeside; ++d) {
    const bool is_before = d <= 0;
    const std::ptrdiff_t k = static_cast<std::ptrdiff_t>(i) + d;
    const auto stripe = stripes_[i + (is_before ? 0 : 1)];
    const bool is_beside = k >= 0 && k < std::ssize(stripes_) &&
                           stripes_[static_cast<std::size_t>(k)] >= 0 &&
                           std::abs(stripes_[static_cast<std::size_t>(k)] - stripe) <= 1;
    if (!is_beside) {  // another surface, or none
      place += is_before ? 1.0 : 0.0;
      continue;
    }
    const auto pixel = static_cast<std::size_t>(k) * bits_;
    double contrast = 0.0;
    for (std::size_t one = 0; one < bits_; ++one)
      contrast = std::max(contrast, std::abs(margins_[pixel + one].counts));
    const Margin& found = margins_[pixel + bit];
    const double share = 0.5 * (1.0 + sign * found.counts / contrast);
    if ((d == -kBeside || d == 1 + kBeside) && std::abs(found.counts) < kFull * contrast)
      return false;
    place += share;
    variance += std::pow(0.5 * found.sigma / contrast, 2);
  }
  out.at = std::clamp(place, static_cast<double>(i), static_cast<double>(i + 1));
  out.noise_px = std::sqrt(variance);
  out.width_px = place_sigma_px(out.sharpness, place_px_);
  return true;
}

GrayLineDecoder::Bend GrayLineDecoder::bend_at(const StripeBorder& left,
                                               const StripeBorder& right,
                                               double t) const {
  const double rate = rate_between(left, right);
  const double length = right.at - left.at;
  std::optional<double> from_left;
  std::optional<double> from_right;
  double second = 0.0;
  const StripeBorder* before = border(left.at_pixel, -1);
  if (before != nullptr && before->column != left.column) {
    const double change = rate - rate_between(*before, left);
    second += 2.0 * change / (right.at - before->at);
    from_left = -change * t * length;
  }
  const StripeBorder* after = border(right.at_pixel + 1, 1);
  if (after != nullptr && after->column != right.column) {
    const double change = rate_between(right, *after) - rate;
    second += 2.0 * change / (after->at - left.at);
    from_right = -change * (1.0 - t) * length;
  }
  if (from_left && from_right) second *= 0.5;
  Bend out{-0.5 * second * t * (1.0 - t) * length * length, 0.0};
  if (from_left && from_right)
    out.crease = std::abs(*from_left) < std::abs(*from_right) ? *from_left : *from_right;
  else if (from_left.has_value() != from_right.has_value())
    out.crease = from_left ? (1.0 - t) * *from_left : t * *from_right;
  return out;
}

std::optional<Located> GrayLineDecoder::extrapolate(std::size_t i,
                                                    const StripeBorder& near,
                                                    bool is_left) const {
  constexpr double kRateError = 0.2;  // of two neighbouring stripes, relative
  const auto beyond = near.at_pixel + (is_left ? 0U : 1U);
  const StripeBorder* far = border(beyond, is_left ? -1 : 1);
  if (far == nullptr || far->column == near.column) return std::nullopt;
  const double rate = (near.column - far->column) / (near.at - far->at);
  const double distance = rate * (static_cast<double>(i) - near.at);
  const double column = near.column + distance;
  const double first = static_cast<double>(stripes_[i]) * code_.stripe_px - 0.5 - code_.offset_px;
  if (column < first || column > first + code_.stripe_px) return std::nullopt;
  return Located{column,
                 std::abs(rate) * near.noise_px,
                 std::hypot(rate * near.width_px, kRateError * distance),
                 0.0};
}

Located GrayLineDecoder::locate(std::size_t i) const {
  const StripeBorder* left = border(i, -1);
  const StripeBorder* right = border(i, 1);
  if ((left == nullptr) != (right == nullptr)) {
    if (const auto found = extrapolate(i, left != nullptr ? *left : *right, left != nullptr))
      return *found;
  }
  if (left == nullptr || right == nullptr || left->column == right->column) {
    const double stripe = static_cast<double>(stripes_[i]) + 0.5;
    const double centre = stripe * code_.stripe_px - 0.5 - code_.offset_px;
    return {centre, 0.0, code_.stripe_px / std::sqrt(12.0), 0.0};
  }
  const double length = right->at - left->at;
  const double t = (static_cast<double>(i) - left->at) / length;
  const double rate = (right->column - left->column) / length;
  const auto mix = [&](double a, double b) {
    return std::abs(rate) * std::hypot((1.0 - t) * a, t * b);
  };
  const Bend bend = bend_at(*left, *right, t);
  const double most = 0.25 * code_.stripe_px;  // a larger one is an error of the borders
  const double correction = std::clamp(bend.smooth, -most, most);
  const double otherwise = std::clamp(bend.crease, -2.0 * most, 2.0 * most);
  return {left->column + t * (right->column - left->column) + correction,
          mix(left->noise_px, right->noise_px),
          mix(left->width_px, right->width_px),
          0.5 * std::hypot(correction, otherwise - correction)};
}

}  // namespace frangia

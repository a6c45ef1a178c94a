#include "frangia/phase/gray/check_gray_neighbours.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/phase/gray/internal/gray_trials.h"

namespace frangia {
namespace {

constexpr int kCheckedLines = 96;        ///< sampled across the stripes
constexpr int kNeighbourGap_px = 3;      ///< between the two sides of a border
constexpr double kLeastContrast = 10.0;  ///< counts: less may be noise
constexpr double kLeastLevel = 0.3;      ///< distance from the mean light, over half the contrast
constexpr std::size_t kFewestBorders = 300;  ///< fewer decide nothing
constexpr double kMinOfFrame = 12.0;         ///< borders of a frame; fewer say nothing about it
/// Share of the borders of each frame that lie between neighbours. Depth edges are the others.
constexpr double kFittingShare = 0.8;
constexpr double kLeastGain = 0.3;        ///< by which another declaration raises the least share
constexpr double kEqualShares = 0.03;     ///< shares that differ by less are equal
constexpr double kLeastShareOfAll = 0.5;  ///< of all borders: below it the numbers say nothing

/// Two pixels side by side that different stripes light: a bit for each frame that is bright.
struct CodeBorder {
  std::uint64_t first = 0;
  std::uint64_t second = 0;
};

/// Frames that are saturated nearly everywhere and outshine the stripes.
std::vector<bool> white_frames(const FrameStack& gray) {
  constexpr double kNearlyAll = 0.9;
  constexpr int kEvery_px = 7;
  std::vector<bool> out;
  for (const Frame& frame : gray.frames) {
    double saturated = 0.0;
    double pixels = 0.0;
    for (int y = 0; y < height_of(frame); y += kEvery_px) {
      for (int x = 0; x < width_of(frame); x += kEvery_px) {
        pixels += 1.0;
        saturated += counts_at(frame, x, y) >= gray.white_level ? 1.0 : 0.0;
      }
    }
    out.push_back(saturated > kNearlyAll * pixels);
  }
  return out;
}

/// The least and the largest counts of a pixel.
struct CountRange {
  int low = std::numeric_limits<int>::max();
  int high = 0;

  [[nodiscard]] double contrast() const { return high - low; }
};

CountRange range_of(const FrameStack& gray, const std::vector<bool>& white, int x, int y) {
  CountRange out;
  for (std::size_t k = 0; k < gray.frames.size(); ++k) {
    if (white[k]) continue;
    const int counts = counts_at(gray.frames[k], x, y);
    out.low = std::min(out.low, counts);
    out.high = std::max(out.high, counts);
  }
  return out;
}

/// Contrast from which on a pixel shows bright and dark stripes: without bright ones, a black frame
/// is all its contrast.
double least_contrast(const FrameStack& gray, const std::vector<bool>& white) {
  constexpr double kOfBright = 0.25;
  constexpr int kEvery_px = 7;
  std::vector<double> contrasts;
  for (int y = 0; y < height_of(gray.frames.front()); y += kEvery_px)
    for (int x = 0; x < width_of(gray.frames.front()); x += kEvery_px)
      contrasts.push_back(range_of(gray, white, x, y).contrast());
  const auto high = contrasts.begin() + std::ssize(contrasts) * 9 / 10;
  std::nth_element(contrasts.begin(), high, contrasts.end());
  return std::max(kLeastContrast, kOfBright * *high);
}

/// The frames that are bright at a pixel; false where one is neither bright nor dark.
bool read_pixel(const FrameStack& gray,
                const CountRange& range,
                double least,
                int x,
                int y,
                std::uint64_t& bright) {
  const double contrast = range.contrast();
  if (contrast < least) return false;
  const double middle = range.low + 0.5 * contrast;
  bright = 0;
  for (std::size_t k = 0; k < gray.frames.size(); ++k) {
    const double above = counts_at(gray.frames[k], x, y) - middle;
    if (std::abs(above) < kLeastLevel * 0.5 * contrast) return false;
    if (above > 0.0) bright |= std::uint64_t{1} << k;
  }
  return true;
}

std::vector<CodeBorder> borders_of(const FrameStack& gray) {
  const bool columns = gray.pattern.direction == FringeDirection::Horizontal;
  const int width = width_of(gray.frames.front());
  const int height = height_of(gray.frames.front());
  const int across = columns ? width : height;
  const int along = columns ? height : width;
  const std::vector<bool> white = white_frames(gray);
  const double least = least_contrast(gray, white);
  std::vector<CodeBorder> out;
  for (int line = 0; line < across; line += std::max(1, across / kCheckedLines)) {
    std::uint64_t last = 0;
    int last_place = -kNeighbourGap_px - 1;
    for (int place = 0; place < along; ++place) {
      std::uint64_t bright = 0;
      const int x = columns ? line : place;
      const int y = columns ? place : line;
      if (!read_pixel(gray, range_of(gray, white, x, y), least, x, y, bright)) continue;
      if (place - last_place <= kNeighbourGap_px && bright != last) out.push_back({last, bright});
      last = bright;
      last_place = place;
    }
  }
  return out;
}

/// Whether the stripes on both sides of a border are neighbours, or may be if a frame without
/// stripes is missing. Without its last `unused_bits`, a code is one of wider stripes.
bool are_neighbours(const GrayTrial& trial, const CodeBorder& border, int unused_bits) {
  const auto differ_by_one = [&](std::uint64_t first, std::uint64_t second) {
    const auto step = static_cast<std::int64_t>(shown_stripe(trial, first) >> unused_bits) -
                      static_cast<std::int64_t>(shown_stripe(trial, second) >> unused_bits);
    return std::abs(step) <= 1;
  };
  if (!trial.missing) return differ_by_one(border.first, border.second);
  const std::uint64_t other = std::uint64_t{1} << *trial.missing;
  return differ_by_one(border.first, border.second) ||
         differ_by_one(border.first ^ other, border.second) ||
         differ_by_one(border.first, border.second ^ other) ||
         differ_by_one(border.first ^ other, border.second ^ other);
}

/// Shares of the borders that lie between neighbouring stripes.
struct NeighbourShares {
  double all = 0.0;
  double least = 1.0;  ///< of the borders of one frame
};

NeighbourShares shares_of(const GrayTrial& trial,
                          const std::vector<CodeBorder>& borders,
                          int unused_bits = 0) {
  const std::size_t frames = trial.frame_of.size();
  std::vector<double> good(frames);
  std::vector<double> count(frames);
  NeighbourShares out;
  for (const CodeBorder& border : borders) {
    const bool neighbours = are_neighbours(trial, border, unused_bits);
    out.all += neighbours ? 1.0 : 0.0;
    for (std::size_t frame = 0; frame < frames; ++frame) {
      if (((border.first ^ border.second) >> frame & 1U) == 0) continue;
      count[frame] += 1.0;
      good[frame] += neighbours ? 1.0 : 0.0;
    }
  }
  out.all /= static_cast<double>(borders.size());
  for (std::size_t frame = 0; frame < frames; ++frame)
    if (count[frame] >= kMinOfFrame) out.least = std::min(out.least, good[frame] / count[frame]);
  return out;
}

/// Whether the code is as declared, but pixels are as wide as its narrowest stripes: from one to
/// the next the number may change by two.
bool has_too_fine_stripes(const Pattern& code, const std::vector<CodeBorder>& borders) {
  constexpr int kMostUnused = 3;
  for (int unused = 1; unused <= std::min(kMostUnused, code.bits - 1); ++unused)
    if (shares_of(declared_trial(code), borders, unused).least >= kFittingShare) return true;
  return false;
}

/// Frames that never change at a border: without stripes.
std::vector<GrayTrial> blank_trials(const Pattern& code, const std::vector<CodeBorder>& borders) {
  std::vector<GrayTrial> out;
  constexpr double kNone = 0.005;
  for (std::size_t frame = 0; frame < static_cast<std::size_t>(code.frame_count()); ++frame) {
    const auto changes = std::count_if(borders.begin(), borders.end(), [&](const CodeBorder& one) {
      return ((one.first ^ one.second) >> frame & 1U) != 0;
    });
    if (static_cast<double>(changes) > kNone * static_cast<double>(borders.size())) continue;
    GrayTrial trial = declared_trial(code);
    trial.missing = frame;
    trial.fault.kind = SequenceFaultKind::Missing;
    trial.fault.what = fmt::format("a missing frame: frame {} shows no stripes", frame);
    trial.fault.keys = fmt::format("capture {}-{}.png again", code.name, frame);
    out.push_back(std::move(trial));
  }
  return out;
}

}  // namespace

SequenceCheck check_gray_neighbours(const FrameStack& gray) {
  const Pattern& code = gray.pattern;
  require(static_cast<int>(gray.frames.size()) == code.frame_count(),
          "check_gray_neighbours: the number of frames differs from the pattern");
  SequenceCheck out;
  out.patterns = {code.name};
  constexpr std::size_t kMostFrames = 64;  // bits of CodeBorder
  if (gray.frames.size() > kMostFrames) return out;
  const std::vector<CodeBorder> borders = borders_of(gray);
  if (borders.size() < kFewestBorders) return out;
  out.decided = true;
  const NeighbourShares declared = shares_of(declared_trial(code), borders);
  out.agreement = declared.least;
  if (declared.least >= kFittingShare) return out;
  std::vector<GrayTrial> trials = blank_trials(code, borders);
  for (GrayTrial& trial : code_trials(code))
    trials.push_back(std::move(trial));
  std::vector<double> shares;
  double best = std::max(kFittingShare, declared.least + kLeastGain);
  for (const GrayTrial& trial : trials) {
    shares.push_back(shares_of(trial, borders).least);
    best = std::max(best, shares.back());
  }
  for (std::size_t i = 0; i < trials.size(); ++i)
    if (shares[i] >= best - kEqualShares) out.fits.push_back(std::move(trials[i].fault));
  out.consistent =
      out.fits.empty() && (declared.all >= kLeastShareOfAll || has_too_fine_stripes(code, borders));
  if (out.fits.empty() && !out.consistent) {
    out.finding = fmt::format(
        "pattern \"{}\": at {:.0f} % of the borders of its stripes the number changes by more than "
        "one, and no other order of the frames explains it; check bits, code and order in "
        "scan.toml",
        code.name,
        100.0 * (1.0 - declared.all));
  }
  return out;
}

}  // namespace frangia

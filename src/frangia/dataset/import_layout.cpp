#include "frangia/dataset/import_layout.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

constexpr const char* kOpenCv = "opencv-gray-code";
constexpr const char* kScan3d = "scan3d-capture";
constexpr const char* kUnderworld = "3dunderworld";
constexpr const char* kSlStudioGray = "slstudio-gray-code";
constexpr const char* kSlStudioThree = "slstudio-phase-shift-3";
constexpr const char* kSlStudioTwice = "slstudio-phase-shift-2x3";

/// The bits that number `side` columns: the least b with 2^b >= side.
int bits_for(int side) {
  int bits = 0;
  while ((1 << bits) < side)
    ++bits;
  return std::max(bits, 1);
}

/// Appends a pattern and its images.
void append(ImportLayout& layout, const Pattern& pattern) {
  const std::size_t at = layout.patterns.size();
  layout.patterns.push_back(pattern);
  for (std::size_t frame = 0; frame < static_cast<std::size_t>(pattern.frame_count()); ++frame)
    layout.images.emplace_back(std::pair{at, frame});
}

void append_white_and_black(ImportLayout& layout) {
  Pattern white;
  white.name = "white";
  white.kind = PatternKind::White;
  append(layout, white);
  layout.images.emplace_back(std::nullopt);  // black, which is added last
}

Pattern gray_of_columns(int bits, InvertedFrames inverted) {
  Pattern gray;
  gray.name = "gray-columns";
  gray.kind = PatternKind::Gray;
  gray.bits = bits;
  gray.inverted = inverted;
  return gray;
}

Pattern gray_of_rows(int bits, InvertedFrames inverted) {
  Pattern gray = gray_of_columns(bits, inverted);
  gray.name = "gray-rows";
  gray.direction = FringeDirection::Horizontal;
  return gray;
}

/// Three steps of cos(2 pi i / period - k 120 degrees), over columns or rows.
Pattern three_steps(const std::string& name, double period_px, FringeDirection direction) {
  Pattern fringes;
  fringes.name = name;
  fringes.direction = direction;
  fringes.period_px = period_px;
  for (int k = 0; k < 3; ++k)
    fringes.shifts_rad.push_back(k == 0 ? 0.0 : -kTwoPi * k / 3.0);
  return fringes;
}

/// Columns, then rows, each bit followed by its inverse.
void append_gray_pairs(ImportLayout& layout, const ProjectorSize& projector_px) {
  append(layout, gray_of_columns(bits_for(projector_px[0]), InvertedFrames::Alternating));
  append(layout, gray_of_rows(bits_for(projector_px[1]), InvertedFrames::Alternating));
}

/// The `bits` widest stripes of the code of `side` columns, which is centred in its range.
Pattern centred_in_range(Pattern gray, int side) {
  const int range = std::max(bits_for(side), gray.bits);
  gray.stripe_px = std::ldexp(1.0, range - gray.bits);
  gray.offset_px = ((1 << range) - side) / 2;  // whole pixels, as in its source
  return gray;
}

/// White and black, then as many bits of columns as of rows. The user of scan3d-capture chooses how
/// many.
ImportLayout scan3d_layout(std::size_t images, const ProjectorSize& projector_px) {
  constexpr std::size_t kMaxBits = 16;
  ImportLayout layout;
  append_white_and_black(layout);
  const auto bits = static_cast<int>(std::clamp<std::size_t>(images / 4, 1, kMaxBits));
  const auto alternating = InvertedFrames::Alternating;
  append(layout, centred_in_range(gray_of_columns(bits, alternating), projector_px[0]));
  append(layout, centred_in_range(gray_of_rows(bits, alternating), projector_px[1]));
  return layout;
}

/// White and black, then the ten widest bits of columns, then the six widest of rows.
ImportLayout slstudio_gray_layout(std::size_t images, const ProjectorSize& projector_px) {
  constexpr int kColumnBits = 10;
  constexpr int kRowBits = 6;
  ImportLayout layout;
  append_white_and_black(layout);
  const auto widest = [](Pattern gray, int side) {
    gray.stripe_px = std::ldexp(1.0, bits_for(side) - gray.bits);
    return gray;
  };
  if (images != 2 + kRowBits)
    append(layout, widest(gray_of_columns(kColumnBits, InvertedFrames::None), projector_px[0]));
  if (images != 2 + kColumnBits)
    append(layout, widest(gray_of_rows(kRowBits, InvertedFrames::None), projector_px[1]));
  return layout;
}

/// Sixteen fringes over the field, then one, over columns and then perhaps rows.
ImportLayout slstudio_twice_layout(std::size_t images, const ProjectorSize& projector_px) {
  constexpr double kFringes = 16.0;
  ImportLayout layout;
  const auto vertical = FringeDirection::Vertical;
  const auto horizontal = FringeDirection::Horizontal;
  append(layout, three_steps("columns-fine", projector_px[0] / kFringes, vertical));
  append(layout, three_steps("columns-cue", projector_px[0], vertical));
  if (images == layout.images.size()) return layout;
  append(layout, three_steps("rows-fine", projector_px[1] / kFringes, horizontal));
  append(layout, three_steps("rows-cue", projector_px[1], horizontal));
  return layout;
}

ImportLayout layout_for(std::string_view name,
                        std::size_t images,
                        const ProjectorSize& projector_px) {
  if (name == kScan3d) return scan3d_layout(images, projector_px);
  if (name == kSlStudioGray) return slstudio_gray_layout(images, projector_px);
  if (name == kSlStudioTwice) return slstudio_twice_layout(images, projector_px);
  ImportLayout layout;
  if (name == kSlStudioThree) {
    append(layout, three_steps("columns", projector_px[0], FringeDirection::Vertical));
  } else if (name == kUnderworld) {
    append_white_and_black(layout);
    append_gray_pairs(layout, projector_px);
  } else {
    append_gray_pairs(layout, projector_px);
    if (images > layout.images.size()) append_white_and_black(layout);
  }
  return layout;
}

}  // namespace

const std::vector<KnownLayout>& known_layouts() {
  static const std::vector<KnownLayout> layouts = {
      {kOpenCv,
       "pattern_cam1_im{frame}.png",
       "OpenCV's GrayCodePattern: columns, then rows, each bit followed by its inverse, then white "
       "and black"},
      {kScan3d,
       "cam_{frame:02}.png",
       "scan3d-capture: white, black, columns, then rows, each bit followed by its inverse"},
      {kUnderworld,
       "{frame:04}.jpg",
       "3DUNDERWORLD-SLS: white, black, columns, then rows, each bit followed by its inverse"},
      {kSlStudioGray, "frameSeq_{frame}.bmp", "SLStudio: white, black, columns, then rows"},
      {kSlStudioThree,
       "frameSeq_{frame}.bmp",
       "SLStudio: one fringe over the columns, three steps"},
      {kSlStudioTwice,
       "frameSeq_{frame}.bmp",
       "SLStudio: 16 fringes and one fringe over the columns, then perhaps over the rows, three "
       "steps each"}};
  return layouts;
}

const KnownLayout* find_layout(std::string_view name) {
  const auto& layouts = known_layouts();
  const auto found = std::find_if(
      layouts.begin(), layouts.end(), [&](const KnownLayout& known) { return known.name == name; });
  return found == layouts.end() ? nullptr : &*found;
}

ImportLayout make_layout(const KnownLayout& layout,
                         std::size_t images,
                         const ProjectorSize& projector_px) {
  ImportLayout made = layout_for(layout.name, images, projector_px);
  for (auto& image : made.images) {
    if (image) continue;
    image = {made.patterns.size(), std::size_t{0}};
    made.patterns.push_back({.name = "black", .kind = PatternKind::Ambient});
  }
  if (made.images.size() != images) {
    throw Error(
        ErrorKind::Input,
        fmt::format("the layout {} has {} images for a projector of {} x {} pixels, but the "
                    "folder has {}; correct `projector` or choose another `layout`",
                    layout.name,
                    made.images.size(),
                    projector_px[0],
                    projector_px[1],
                    images));
  }
  return made;
}

}  // namespace frangia

#include "frangia/dataset/read_frames.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "frangia/core/checksums.h"
#include "frangia/core/open_below.h"
#include "frangia/core/parallel.h"
#include "frangia/core/read_file.h"
#include "frangia/frames/image_file.h"
#include "frangia/frames/png.h"

namespace frangia {
namespace {

constexpr std::string_view kFloatEnding = ".tiff";

/// The frame number in "NAME-12.png" or "NAME-12@1.png", or -1. One that no `int` holds is the
/// largest one.
int frame_number(const std::string& file,
                 const std::string& pattern_name,
                 std::string_view ending) {
  std::string_view rest = file;
  if (!rest.starts_with(pattern_name + "-") || !rest.ends_with(ending)) return -1;
  if (rest.size() <= pattern_name.size() + 1 + ending.size()) return -1;
  rest.remove_prefix(pattern_name.size() + 1);
  rest.remove_suffix(ending.size());
  rest = rest.substr(0, rest.find('@'));
  if (rest.empty() || rest.find_first_not_of("0123456789") != std::string_view::npos) return -1;
  int number = 0;
  const auto read = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  return read.ec == std::errc() ? number : std::numeric_limits<int>::max();
}

/// A surplus frame means that scan.toml and the files disagree on the shifts.
void refuse_surplus_frames(const std::filesystem::path& folder,
                           const std::vector<Pattern>& patterns,
                           std::string_view ending) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    for (const Pattern& pattern : patterns) {
      if (frame_number(file, pattern.name, ending) < pattern.frame_count()) continue;
      throw Error(ErrorKind::Input,
                  fmt::format("{}: is a surplus frame: pattern \"{}\" has {} in scan.toml; remove "
                              "the file or correct scan.toml",
                              entry.path().string(),
                              pattern.name,
                              pattern.frame_count()));
    }
  }
}

int brightest(const Frame& frame) {
  return std::visit(
      [](const auto& image) {
        return static_cast<int>(*std::max_element(image.pixels().begin(), image.pixels().end()));
      },
      frame);
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), what));
}

/// Refuses a frame whose size is not that of the rig's camera.
void check_size(const Camera& camera, const std::filesystem::path& path, int width, int height) {
  const CameraModel& model = camera.model;
  if (width == model.width_px && height == model.height_px) return;
  refuse(path,
         fmt::format("is {} x {} pixels, but {} in rig.toml is {} x {}",
                     width,
                     height,
                     camera.name.empty() ? "camera.size_px"
                                         : fmt::format("size_px of the camera \"{}\"", camera.name),
                     model.width_px,
                     model.height_px));
}

/// Reads a floating-point frame as counts. A value that is not finite becomes saturated, so that
/// its pixel is missing.
Frame read_float_frame(const Scan& scan, const std::filesystem::path& path) {
  const ImageFile file(path);
  check_size(scan.rig.reference(), path, file.info().width_px, file.info().height_px);
  const RasterImage image = file.read();
  const auto* const values = std::get_if<Image<float>>(&image.samples);
  if (values == nullptr || image.channels != 1)
    refuse(path, "is not a grey floating-point TIFF, as [frames] in scan.toml states");
  const double white = kFloatWhiteLevel;
  const double counts_per_unit = white / (scan.frames.full_scale - scan.frames.zero);
  Image<std::uint16_t> counts(values->width(), values->height(), Uninitialized{});
  for (std::size_t i = 0; i < counts.pixels().size(); ++i) {
    const double value = static_cast<double>(values->pixels()[i]);
    const double scaled =
        std::isfinite(value) ? (value - scan.frames.zero) * counts_per_unit : white;
    counts.pixels()[i] = static_cast<std::uint16_t>(std::lround(std::clamp(scaled, 0.0, white)));
  }
  return counts;
}

/// Sets a coloured frame of a stack and its luminance, in 8 or 16 bits as the file has.
template <typename T>
void set_color(const Image<T>& samples, int full_scale, FrameStack& stack) {
  constexpr std::array<float, 3> kLuminance = {0.299F, 0.587F, 0.114F};  // ITU-R BT.601
  Image<T> luminance(samples.width() / 3, samples.height(), Uninitialized{});
  stack.color = Image<Eigen::Vector3f>(luminance.width(), luminance.height(), Uninitialized{});
  for (std::size_t i = 0; i < luminance.pixels().size(); ++i) {
    float sum = 0.0F;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto value = static_cast<float>(samples.pixels()[3 * i + c]);
      stack.color.pixels()[i][static_cast<Eigen::Index>(c)] =
          std::min(value / static_cast<float>(full_scale), 1.0F);
      sum += kLuminance.at(c) * value;
    }
    luminance.pixels()[i] = static_cast<T>(std::lround(sum));
  }
  stack.frames.front() = std::move(luminance);
}

/// Whether a file begins as a PNG in colour does.
bool is_color_png(const std::filesystem::path& path) {
  constexpr std::string_view kMagic = "\x89PNG\r\n\x1a\n";
  constexpr std::size_t kColorType = 25;  // offset in the header
  constexpr unsigned kColor = 2;          // bit of the colour type
  std::array<char, kColorType + 1> header{};
  std::ifstream file(path, std::ios::binary);
  file.read(header.data(), header.size());
  return file.good() && std::string_view(header.data(), kMagic.size()) == kMagic &&
         (static_cast<unsigned char>(header.back()) & kColor) != 0;
}

/// Whether a frame may be coloured: it gives the vertices their colors.
bool may_have_color(const Pattern& pattern) {
  return pattern.kind == PatternKind::White || pattern.kind == PatternKind::Ambient;
}

/// Reads a frame of kind white or ambient, grey or in colour. 8 bits of colour have a full scale of
/// 255, 16 bits the white level of the camera if that has more than 8 bits.
void read_color_frame(const Scan& scan, const std::filesystem::path& path, FrameStack& stack) {
  const ImageFile file(path);
  check_size(scan.rig.reference(), path, file.info().width_px, file.info().height_px);
  const RasterImage image = file.read();
  if (image.channels != 3) refuse(path, "is neither grey nor red, green and blue; convert it");
  if (const auto* const narrow = std::get_if<Image<std::uint8_t>>(&image.samples)) {
    set_color(*narrow, 255, stack);
  } else if (const auto* const wide = std::get_if<Image<std::uint16_t>>(&image.samples)) {
    const int white = scan.rig.reference().white_level;
    set_color(*wide, white > 255 ? white : 65535, stack);
  } else {
    refuse(path, "is a floating-point image in colour; convert it to 8 or 16 bits");
  }
}

void check_counts(const Frame& frame,
                  const Frame& first,
                  const Camera& camera,
                  const std::filesystem::path& path) {
  const auto fail = [&](const std::string& what) { refuse(path, what); };
  if (frame.index() != first.index())
    fail("has another bit depth than the view's first frame; capture the view again");
  if (frame.index() == 0) {
    if (camera.white_level > 255) {
      fail(
          fmt::format("has 8 bits, but camera.white_level in rig.toml is {}; set it to 255 or "
                      "below",
                      camera.white_level));
    }
  } else if (const int top = brightest(frame); top > camera.white_level) {
    fail(
        fmt::format("holds the value {}, above camera.white_level = {} in rig.toml; set it to the "
                    "camera's full scale, such as 4095 for 12 bits",
                    top,
                    camera.white_level));
  }
}

/// A file and the frame that it is read into.
struct FrameFile {
  std::filesystem::path relative;  ///< to the scan folder
  Frame* frame;
  FrameStack* stack;
};

/// Reads a frame inside the scan folder, of the size of the rig's camera.
void read_frame(const Scan& scan, const FrameFile& file) {
  const std::filesystem::path path = path_below(scan.folder, file.relative);
  if (scan.frames.is_float) {
    *file.frame = read_float_frame(scan, path);
  } else if (may_have_color(file.stack->pattern) && is_color_png(path)) {
    read_color_frame(scan, path, *file.stack);
  } else {
    *file.frame = read_png(path, [&](int width_px, int height_px) {
      check_size(scan.rig.reference(), path, width_px, height_px);
    });
  }
}

/// Calls `work` for every file on all cores. Every file is tried, and the error of the first one
/// that failed is thrown: the message does not depend on the number of threads.
void for_each_file(const std::vector<FrameFile>& files,
                   const std::function<void(const FrameFile&)>& work) {
  std::vector<std::exception_ptr> errors(files.size());
  parallel_chunks(files.size(), 1, [&](std::size_t i, std::size_t) {
    try {
      work(files[i]);
    } catch (...) {
      errors[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace

std::vector<FrameStack> read_frames(const Scan& scan, std::size_t view, const Run& run) {
  const std::filesystem::path folder = path_below(scan.folder, scan.views.at(view).folder);
  if (!std::filesystem::is_directory(folder)) {
    const std::string& camera = scan.rig.reference().name;
    if (!camera.empty()) {
      throw Error(ErrorKind::Input,
                  fmt::format("{}: there is no such folder, but rig.toml has the camera \"{}\" in "
                              "[[more_cameras]]; restore its frames or remove the camera",
                              folder.string(),
                              camera));
    }
    throw Error(ErrorKind::Input,
                fmt::format("{}: there is no such folder, but scan.toml names it; restore it or "
                            "remove the view from scan.toml",
                            folder.string()));
  }
  refuse_surplus_frames(folder, scan.patterns, scan.frames.is_float ? kFloatEnding : ".png");
  std::vector<FrameStack> stacks;
  for (const Pattern& pattern : scan.patterns) {
    for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure) {
      stacks.push_back({pattern,
                        std::vector<Frame>(static_cast<std::size_t>(pattern.frame_count())),
                        scan.rig.reference().white_level,
                        exposure,
                        scan.frames.compression_counts2});
    }
  }
  std::vector<FrameFile> files;
  for (FrameStack& stack : stacks) {
    for (std::size_t i = 0; i < stack.frames.size(); ++i) {
      std::filesystem::path name =
          frame_file_name(stack.pattern, static_cast<int>(i), stack.exposure);
      if (scan.frames.is_float) name.replace_extension(kFloatEnding);
      files.push_back({scan.views[view].folder / name, &stack.frames[i], &stack});
    }
  }
  for_each_file(files, [&](const FrameFile& file) {
    run.check();
    read_frame(scan, file);
  });
  const auto first = std::find_if(
      files.begin(), files.end(), [](const FrameFile& file) { return file.stack->color.empty(); });
  for_each_file(files, [&](const FrameFile& file) {
    if (!file.stack->color.empty()) return;
    check_counts(*file.frame, *first->frame, scan.rig.reference(), scan.folder / file.relative);
  });
  return stacks;
}

namespace {

bool parse_hex(std::string_view text, std::uint32_t& number) {
  constexpr int kBase = 16;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, kBase);
  return error == std::errc() && end == text.data() + text.size();
}

/// @missing  NaN for what is no number
double number_of(const std::string& text) {
  std::istringstream in(text);
  double number = 0.0;
  return in >> number ? number : kMissing;
}

/// Whether the checksum at the end of a line is right; it is then cut off.
bool take_checksum(std::string_view& line) {
  constexpr std::string_view kMark = " crc=";
  const std::size_t at = line.rfind(kMark);
  std::uint32_t stated = 0;
  if (at == std::string_view::npos || !parse_hex(line.substr(at + kMark.size()), stated))
    return false;
  line = line.substr(0, at);
  return crc32(std::span(line.data(), line.size())) == stated;
}

/// The manifest of a captured scan; empty without one.
std::string manifest_of(const std::filesystem::path& scan) {
  constexpr std::uint64_t kMostBytes = 200'000'000;  // a line has about 80
  const auto inner = std::filesystem::path("capture") / kManifestName;
  if (!std::filesystem::exists(path_below(scan, inner))) return {};
  return read_below(scan, inner, kMostBytes);
}

}  // namespace

double read_began_s(const std::filesystem::path& scan) {
  constexpr std::string_view kBegan = "began ";
  std::istringstream lines(manifest_of(scan));
  for (std::string line; std::getline(lines, line);) {
    std::string_view text = line;
    if (text.starts_with(kBegan) && take_checksum(text))
      return number_of(std::string(text.substr(kBegan.size())));
  }
  return kMissing;
}

std::map<std::string, StoredFrame> read_stored_frames(const std::filesystem::path& scan) {
  std::map<std::string, StoredFrame> frames;
  constexpr std::string_view kAt = "at=";
  std::istringstream lines(manifest_of(scan));
  for (std::string line; std::getline(lines, line);) {
    std::string_view text = line;
    if (!text.starts_with("frame ") || !take_checksum(text)) continue;
    std::istringstream words{std::string(text)};
    std::string kind;
    std::string name;
    std::string checksum;
    StoredFrame frame;
    if (!(words >> kind >> name >> checksum) || !parse_hex(checksum, frame.checksum)) continue;
    for (std::string word; words >> word;)
      if (word.starts_with(kAt)) frame.at_s = number_of(word.substr(kAt.size()));
    frames[name] = frame;  // a set that was captured again has a later line
  }
  return frames;
}

}  // namespace frangia

#include "simulated_frame_faults.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <type_traits>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/frames/png.h"

namespace frangia {
namespace {

std::optional<int> whole_number(const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0) return std::nullopt;
  return value;
}

/// A frame of a scan.
struct FramePlace {
  std::filesystem::path folder;
  const Pattern* pattern = nullptr;
  int frame = 0;

  [[nodiscard]] std::filesystem::path path() const {
    return folder / frame_file_name(*pattern, frame);
  }
};

FramePlace place_of(const std::string& text, const char* option, const Scan& scan) {
  const auto first = text.find(':');
  const auto last = text.rfind(':');
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorKind::Input, fmt::format("`{}` {}: {}", option, text, why));
  };
  if (first == std::string::npos || last == first)
    refuse("give VIEW:PATTERN:FRAME, such as 2:p20:1");
  const auto view = whole_number(text.substr(0, first));
  const auto frame = whole_number(text.substr(last + 1));
  const std::string name = text.substr(first + 1, last - first - 1);
  if (!view || static_cast<std::size_t>(*view) >= scan.views.size())
    refuse(fmt::format("the views are 0 to {}", scan.views.size() - 1));
  const auto pattern = std::find_if(scan.patterns.begin(),
                                    scan.patterns.end(),
                                    [&](const Pattern& one) { return one.name == name; });
  if (pattern == scan.patterns.end()) refuse(fmt::format("there is no pattern \"{}\"", name));
  if (!frame || *frame >= pattern->frame_count())
    refuse(fmt::format("the frames of the pattern are 0 to {}", pattern->frame_count() - 1));
  return {scan.folder / scan.views[static_cast<std::size_t>(*view)].folder, &*pattern, *frame};
}

/// A frame without light: the noise of the camera, without the sign that the camera cuts off.
Frame black(Frame frame) {
  std::visit(
      [](auto& image) {
        std::size_t i = 0;
        for (auto& pixel : image.pixels())
          pixel = (i++ * 2654435761U >> 16U) % 4 == 0 ? 1 : 0;
      },
      frame);
  return frame;
}

Frame with_video_levels(Frame frame, int white_level) {
  constexpr double kBlack = 16.0 / 255.0;
  constexpr double kWhite = 235.0 / 255.0;
  std::visit(
      [&](auto& image) {
        using Sample = std::remove_cvref_t<decltype(image.pixels()[0])>;
        for (Sample& pixel : image.pixels()) {
          const double light = static_cast<double>(pixel) / white_level;
          const double level = std::min(kBlack + (kWhite - kBlack) * light, kWhite);
          pixel = static_cast<Sample>(std::lround(level * white_level));
        }
      },
      frame);
  return frame;
}

}  // namespace

void add_frame_faults(CLI::App& verb, SimulatedFrameFaults& faults) {
  constexpr const char* kGroup = "Frames";
  verb.add_option("--lose-frame",
                  faults.lost,
                  "VIEW:PATTERN:FRAME, such as 2:p20:1: the frame is black; may repeat")
      ->group(kGroup);
  verb.add_option("--repeat-frame",
                  faults.repeated,
                  "VIEW:PATTERN:FRAME: the frame shows the one before it again; may repeat")
      ->group(kGroup);
  verb.add_option("--lamp-on",
                  faults.lamps_on,
                  "VIEW:FRAME, such as 0:5: another lamp is on from this frame of the view on, "
                  "counted over all patterns; may repeat")
      ->group(kGroup);
  verb.add_flag("--video-levels",
                faults.video_levels,
                "black is at 16 and white at 235 of 255 counts, as video has it")
      ->group(kGroup);
}

void check_frame_faults(const SimulatedFrameFaults& faults, const Scan& plan) {
  for (const std::string& text : faults.lost)
    static_cast<void>(place_of(text, "lose_frame", plan));
  for (const std::string& text : faults.repeated) {
    require(place_of(text, "repeat_frame", plan).frame > 0,
            "`repeat_frame`: frame 0 has none before it; give 1 or more");
  }
}

std::vector<LampSwitch> lamps_of(const SimulatedFrameFaults& faults, const Scan& plan) {
  int frames = 0;
  for (const Pattern& pattern : plan.patterns)
    frames += pattern.frame_count() * pattern.exposure_count();
  std::vector<LampSwitch> out;
  for (const std::string& text : faults.lamps_on) {
    const auto at = text.find(':');
    const auto view = whole_number(text.substr(0, at));
    const auto frame = whole_number(at == std::string::npos ? std::string() : text.substr(at + 1));
    if (!view || !frame || static_cast<std::size_t>(*view) >= plan.views.size() ||
        *frame >= frames) {
      throw Error(ErrorKind::Input,
                  fmt::format("`lamp_on` {}: give VIEW:FRAME, such as 0:5; the views are 0 to {}, "
                              "and their frames 0 to {}",
                              text,
                              plan.views.size() - 1,
                              frames - 1));
    }
    out.push_back({static_cast<std::size_t>(*view), static_cast<std::size_t>(*frame)});
  }
  return out;
}

void apply_frame_faults(const SimulatedFrameFaults& faults, const Scan& scan, const Run& run) {
  for (const std::string& text : faults.lost) {
    const FramePlace place = place_of(text, "lose_frame", scan);
    write_png(place.path(), black(read_png(place.path())));
  }
  for (const std::string& text : faults.repeated) {
    const FramePlace place = place_of(text, "repeat_frame", scan);
    FramePlace before = place;
    --before.frame;
    write_png(place.path(), read_png(before.path()));
  }
  if (!faults.video_levels) return;
  for (const ScanView& view : scan.views) {
    for (const Pattern& pattern : scan.patterns) {
      for (int frame = 0; frame < pattern.frame_count(); ++frame) {
        run.check();
        const std::filesystem::path path =
            scan.folder / view.folder / frame_file_name(pattern, frame);
        write_png(path, with_video_levels(read_png(path), scan.rig.reference().white_level));
      }
    }
  }
}

}  // namespace frangia

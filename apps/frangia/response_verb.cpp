#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/read_file.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/phase/waveform/fit_waveform.h"
#include "frangia/phase/waveform/fringe_response.h"
#include "frangia/phase/waveform/share_waveforms.h"
#include "frangia/phase/wrap/estimate_noise.h"
#include "frangia/rig/write_rig.h"

#include "check_can_write.h"
#include "print_text.h"
#include "verbs.h"

namespace frangia {
namespace {

struct ResponseArguments {
  std::filesystem::path scan;
  std::filesystem::path output;
};

/// What the frames of a scan tell about the response.
struct ResponseFrames {
  std::vector<FrameStack> ramps;
  std::vector<FrameStack> fringes;  ///< with enough frames for a curve
  /// Waveforms of each fringe pattern over the views.
  std::map<std::string, std::vector<WaveformFit>> waveforms;
};

/// Views whose fringes give the waveforms; they differ by less than their noise.
constexpr std::size_t kWaveformViews = 4;

ResponseFrames read_response_frames(const Scan& scan, const Run& run) {
  ResponseFrames out;
  for (std::size_t i = 0; i < scan.views.size(); ++i) {
    std::vector<FrameStack> stacks = read_frames(scan, i, run);
    const NoiseModel noise =
        scan.rig.reference().noise ? *scan.rig.reference().noise : estimate_noise(stacks);
    std::vector<FittedAlgorithm> fits;
    for (FrameStack& stack : stacks) {
      const Pattern& pattern = stack.pattern;
      if (pattern.kind == PatternKind::Fringe && stack.exposure == 0 && i < kWaveformViews &&
          pattern.period_px > 0.0) {
        fits.push_back({.algorithm = {.name = pattern.name},
                        .step = {},
                        .gain_error = 0.0,
                        .shifts_rad = pattern.shifts_rad,
                        .waveform = fit_waveform(stack, pattern.shifts_rad, noise)});
      }
      if (pattern.kind == PatternKind::Ramp) {
        out.ramps.push_back(std::move(stack));
      } else if (determines_response(pattern)) {
        out.fringes.push_back(std::move(stack));
      }
    }
    share_waveforms(fits);
    for (const FittedAlgorithm& fit : fits)
      out.waveforms[fit.algorithm.name].push_back(fit.waveform);
  }
  return out;
}

/// The mean waveform of each pattern; patterns without a significant harmonic are left out.
std::vector<FringeWaveform> mean_waveforms(const ResponseFrames& frames) {
  std::vector<FringeWaveform> out;
  for (const auto& [name, fits] : frames.waveforms) {
    FringeWaveform mean = fits.front().waveform;
    for (std::size_t view = 1; view < fits.size(); ++view) {
      for (std::size_t i = 0; i < mean.harmonics.size(); ++i) {
        mean.harmonics[i] += i < fits[view].waveform.harmonics.size()
                                 ? fits[view].waveform.harmonics[i]
                                 : mean.harmonics[i] / static_cast<double>(view);
      }
    }
    double largest = 0.0;
    for (auto& harmonic : mean.harmonics) {
      harmonic /= static_cast<double>(fits.size());
      largest = std::max(largest, std::abs(harmonic));
    }
    if (largest > 0.0) out.push_back(std::move(mean));
  }
  std::sort(out.begin(), out.end(), [](const FringeWaveform& a, const FringeWaveform& b) {
    return a.period_px > b.period_px;
  });
  return out;
}

ResponseCurve measured_curve(const Scan& scan,
                             const ResponseFrames& frames,
                             const std::vector<FringeWaveform>& waveforms) {
  try {
    if (!frames.ramps.empty()) return measure_response(frames.ramps);
    if (!frames.fringes.empty()) return measure_fringe_response(frames.fringes);
    require(!frames.waveforms.empty(),
            "has neither a pattern of kind \"ramp\" nor fringes of a digital projector; the "
            "response is measured from one of them");
    // The coarsest fringes are blurred least.
    return response_of_waveform(waveforms.empty() ? FringeWaveform{} : waveforms.front());
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", scan.folder.string(), error.what()));
  }
}

void response_verb(const ResponseArguments& arguments, Terminal& terminal) {
  check_can_write(arguments.output);
  const Run run = terminal.run();
  const Scan scan = read_scan(arguments.scan, run);
  const ResponseFrames frames = read_response_frames(scan, run);
  const bool uncorrected = !scan.rig.projector.response;
  const std::vector<FringeWaveform> waveforms = mean_waveforms(frames);
  const ResponseCurve left = measured_curve(scan, frames, waveforms);
  Projector projector = scan.rig.projector;
  projector.response = uncorrected ? left : compose(*projector.response, left);
  // Waveforms of patterns that a look-up table corrects are not those without it.
  if (uncorrected) projector.waveforms = waveforms;
  write_text_file(arguments.output,
                  with_response(read_text_file(scan.folder / "rig.toml"), projector));
  terminal.finish();
  if (terminal.json) {
    nlohmann::ordered_json result{{"light", projector.response->light}};
    for (const FringeWaveform& waveform : waveforms) {
      nlohmann::ordered_json harmonics;
      for (int order = 2; order < 2 + static_cast<int>(waveform.harmonics.size()); ++order)
        harmonics.push_back(waveform.amplitude(order));
      result["waveforms"].push_back({{"period_px", waveform.period_px}, {"harmonics", harmonics}});
    }
    print_json(result);
  } else if (!terminal.quiet) {
    print_text("half of full drive gives {:.1f} % of full light\n",
               100.0 * projector.response->light_of(0.5));
    for (const FringeWaveform& waveform : waveforms) {
      print_text("fringes of {:g} px: second harmonic {:.1f} %, third {:.1f} %\n",
                 waveform.period_px,
                 100.0 * waveform.amplitude(2),
                 100.0 * waveform.amplitude(3));
    }
    terminal.print_written(arguments.output.string());
  }
}

}  // namespace

void add_response_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<ResponseArguments>();
  CLI::App* verb = program.add_subcommand(
      "response", "measure the response of a projector from a grey ramp or fringes");
  verb->footer(
      "example:\n  frangia simulate plate --display-gamma 2.2 --ramp 17 -o ramp\n"
      "  frangia response ramp -o rig.toml");
  verb->add_option(
          "SCAN",
          arguments->scan,
          "scan with a pattern of kind \"ramp\", or with fringes of 3 frames or more; 6 or "
          "more determine a response of any shape")
      ->required();
  verb->add_option("-o,--output",
                   arguments->output,
                   "rig.toml to write: that of the scan with the response in place of its own")
      ->required();
  verb->callback([arguments, &terminal] { response_verb(*arguments, terminal); });
}

}  // namespace frangia

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/pixel_buffer.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/decode/check_view.h"
#include "frangia/decode/decode_view.h"
#include "frangia/decode/explain_no_phase.h"
#include "frangia/decode/triangulate_view.h"
#include "frangia/decode/write_stages.h"
#include "frangia/range/remove_mixed_pixels.h"
#include "frangia/rig/rig.h"

#include "check_can_write.h"
#include "decode_result.h"
#include "option_values.h"
#include "reconstruct_options.h"
#include "verbs.h"

namespace frangia {
namespace {

struct DecodeArguments {
  std::filesystem::path scan;
  std::optional<std::size_t> view;  ///< every view without it
  std::string camera;
  std::filesystem::path folder;
  bool show_plan = false;
  bool show_hypotheses = false;
  DecodeOptions options;
};

/// The scan as the named camera captured it; as the reference camera did without a name.
Scan choose_camera(const Scan& scan, const std::string& name) {
  if (name.empty()) return scan_of_camera(scan, 0);
  std::vector<std::string> names;
  for (std::size_t i = 1; i < scan.rig.cameras.size(); ++i) {
    names.push_back(scan.rig.cameras[i].camera.name);
    if (names.back() == name) return scan_of_camera(scan, i);
  }
  throw Error(ErrorKind::Input,
              fmt::format("{} has no `camera` \"{}\" in its rig.toml; {}",
                          scan.folder.string(),
                          name,
                          names.empty() ? "it has the reference camera alone"
                                        : fmt::format("it has {}", fmt::join(names, ", "))));
}

/// What all views share.
struct DecodeTask {
  const Scan& scan;
  const DecodeArguments& arguments;
  Image<Eigen::Vector2f> rays;  ///< empty without geometry
  DecodeOptions options;
  DecodePlan plan;
};

/// Decodes and, with geometry, triangulates one view.
ViewResult decode_one(const DecodeTask& task, std::size_t view, const Run& run) {
  const Scan& scan = task.scan;
  run.stage("phase");
  ViewResult out{.view = view};
  const auto frames = read_frames(scan, view, run);
  out.decoded =
      decode_view(frames, task.plan, scan.rig, task.rays, options_of_view(task.options, view), run);
  if (!scan.patterns.empty() && !task.options.phase_files)
    out.empty = explain_no_phase(frames, out.decoded.directions.front().phase.status);
  if (task.rays.empty()) {
    out.reason = task.options.accept_inconsistent ? "" : misfit_of(out.decoded);
    return out;
  }
  run.stage("range");
  const ViewFit fit =
      check_view(out.decoded, scan.rig, task.rays, task.options.accept_inconsistent);
  out.reason = fit.reason;
  if (fit.fits()) {
    out.range =
        triangulate_view(out.decoded, fit, scan.rig, task.rays, task.options.directions).range;
    // Maps and figures show the direction whose pixels have the points.
    std::swap(out.decoded.directions.front(), out.decoded.directions[fit.leading()]);
    remove_mixed_pixels(out.range,
                        task.rays,
                        out.decoded.directions.front().phase.status,
                        {.blur_px = blur_px_of(out.decoded)});
  }
  if (fit.accepted) {
    run.warn(out.reason + "; triangulated because `accept_inconsistent` is set");
    out.reason.clear();
  }
  return out;
}

/// Decodes every view into a folder of its number; at any time one view is in memory.
void decode_all(const DecodeTask& task, Terminal& terminal, const Run& run) {
  terminal.hold();
  DecodedScan summary(task.scan, task.plan, task.arguments.folder, terminal);
  for (std::size_t view = 0; view < task.scan.views.size(); ++view) {
    run.report(static_cast<double>(view) / static_cast<double>(task.scan.views.size()));
    Run of_view = run;  // its stages would begin the progress line again
    of_view.on_stage = nullptr;
    of_view.progress = nullptr;
    of_view.on_warning = [&](const std::string& sentence) {
      run.warn(fmt::format("{}: {}", task.scan.views[view].folder.string(), sentence));
    };
    ViewResult result = decode_one(task, view, of_view);
    const auto folder = task.arguments.folder / fmt::format("{:03}", view);
    result.files = write_maps(result.decoded, result.range, folder, of_view);
    summary.add(result);
    release_cached_pixels();
  }
  summary.finish();
}

void decode_verb(const DecodeArguments& arguments, Terminal& terminal) {
  const Run run = terminal.run();
  const Scan scan =
      choose_camera(read_scan(arguments.scan, run, RigContent::PhaseOnly), arguments.camera);
  DecodeTask task{scan,
                  arguments,
                  {},
                  arguments.options,
                  plan_decoding(scan.patterns, scan.rig, arguments.options)};
  if (arguments.show_plan) {
    print_plan(task.plan, terminal);
    return;
  }
  const std::size_t view = arguments.view.value_or(0);
  if (view >= scan.views.size()) {
    throw Error(ErrorKind::Input,
                fmt::format("{} has no `view` {}; its views are 0 to {}",
                            arguments.scan.string(),
                            view,
                            scan.views.size() - 1));
  }
  if (arguments.options.phase_files) check_phase_files(*arguments.options.phase_files, scan);
  make_folder(arguments.folder);
  check_can_write(arguments.folder / "index.html");
  if (has_geometry(scan.rig)) {
    task.rays = rays_of(scan.rig.reference().model);
    if (!is_absolute(task.plan)) {
      run.warn(
          "the scan holds neither an absolute pattern nor the laser sheet: phases and depths are "
          "relative to the fringe through the projection axis, which sigma does not count");
    }
  } else {
    run.note("rig.toml holds no geometry: no depth is computed");
  }
  run.stage("survey");
  task.options.survey = survey_scan(scan, run);
  if (!arguments.view && scan.views.size() > 1) {
    run.stage("phase");
    decode_all(task, terminal, run);
    return;
  }
  ViewResult result = decode_one(task, view, run);
  run.stage("files");
  if (!arguments.view) write_maps(result.decoded, result.range, arguments.folder / "000", run);
  result.files = write_stages(result.decoded, result.range, arguments.folder, run);
  print_decoded_view(scan, task.plan, result, arguments.folder, terminal);
}

}  // namespace

void add_decode_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<DecodeArguments>();
  CLI::App* verb = program.add_subcommand(
      "decode", "write the phase maps of all views, or each decoding stage of one view");
  verb->footer(
      "examples:\n"
      "  frangia decode ball-bar -o maps               maps/000/PATTERN-phase.tiff, ... of all "
      "views\n"
      "  frangia decode ball-bar --view 3 -o stages    each stage of one view, with pictures\n"
      "  frangia decode ball-bar --show-plan           where its fringe orders come from\n"
      "  frangia decode --show-hypotheses              the causes that explain frames");
  auto* input = verb->add_option(
      "SCAN", arguments->scan, "the scan folder, with scan.toml; without rig.toml, phases only");
  verb->add_option("--view",
                   arguments->view,
                   "number of one view, counted from 0, whose stages are written; all views by "
                   "default, each into a folder of its number, as --phase reads them")
      ->check(zero_or_more());
  verb->add_option("--camera",
                   arguments->camera,
                   "name of one of `more_cameras`; the reference camera by default");
  auto* output = verb->add_option("-o,--output", arguments->folder, "folder to write to");
  verb->add_flag("--show-plan",
                 arguments->show_plan,
                 "print how the frames are decoded and where fringe orders come from, and decode "
                 "nothing")
      ->excludes(output);
  verb->add_flag("--show-hypotheses",
                 arguments->show_hypotheses,
                 "print the causes that explain frames, and which of them frames alone do not tell "
                 "apart; it needs no scan")
      ->excludes(input)
      ->excludes(output);
  add_decode_options(*verb, arguments->options);
  arguments->options.spatial.keep_growth_order = true;
  verb->callback([arguments, &terminal] {
    if (arguments->show_hypotheses) {
      print_hypotheses(terminal);
      return;
    }
    if (arguments->scan.empty()) throw CLI::RequiredError("SCAN");
    if (arguments->folder.empty() && !arguments->show_plan) throw CLI::RequiredError("--output");
    decode_verb(*arguments, terminal);
  });
}

}  // namespace frangia

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "frangia/core/make_folder.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/dataset/scan_of_camera.h"
#include "frangia/pipeline/check_view.h"
#include "frangia/pipeline/decode_view.h"
#include "frangia/pipeline/stage_pictures.h"
#include "frangia/pipeline/triangulate_view.h"
#include "frangia/pipeline/write_stages.h"
#include "frangia/range/remove_mixed_pixels.h"
#include "frangia/rig/has_geometry.h"

#include "check_can_write.h"
#include "counted.h"
#include "option_names.h"
#include "option_values.h"
#include "print_text.h"
#include "reconstruct_options.h"
#include "verbs.h"

namespace frangia {
namespace {

struct DecodeArguments {
  std::filesystem::path scan;
  std::size_t view = 0;
  std::string camera;
  std::filesystem::path folder;
  DecodeOptions options;
};

nlohmann::ordered_json json_of(const SequenceCheck& check) {
  nlohmann::ordered_json json{{"patterns", check.patterns},
                              {"decided", check.decided},
                              {"consistent", check.consistent},
                              {"misfit_rad", check.misfit_rad},
                              {"chance_rad", check.chance_rad}};
  for (const SequenceFault& fault : check.fits) {
    json["fits"].push_back({{"kind", name_of(fault.kind)},
                            {"patterns", fault.patterns},
                            {"what", fault.what},
                            {"same_as", fault.same_as},
                            {"keys", fault.keys}});
  }
  return json;
}

void print_result(const DecodedView& decoded,
                  const std::vector<StageFile>& files,
                  const std::string& reason,
                  const DecodeArguments& arguments,
                  Terminal& terminal) {
  const auto status = decoded.phase.status.pixels();
  nlohmann::ordered_json json;
  terminal.finish();
  for (const StatusLegend& entry : status_legend()) {
    const auto count = std::count(status.begin(), status.end(), entry.status);
    json["pixels"][entry.meaning] = count;
    if (count == 0 || terminal.json || terminal.quiet) continue;
    print_text("{:>10} {:<6} {} ({} in mask.png)\n",
               count,
               count == 1 ? "pixel" : "pixels",
               entry.meaning,
               entry.color_name);
  }
  for (const FrameAssessment& assessment : decoded.assessments) {
    const std::string text = with_flags(describe(assessment));
    json["assessments"].push_back(text);
    if (!terminal.json && !terminal.quiet) print_text("{}\n", text);
  }
  for (const SequenceCheck& check : decoded.checks)
    json["checks"].push_back(json_of(check));
  json["trustworthy"] = reason.empty();
  if (!reason.empty()) json["reason"] = reason;
  for (const StageFile& file : files) {
    json["files"].push_back(file.name);
    json["captions"][file.name] = file.caption;
    const bool picture = std::filesystem::path(file.name).extension() == ".png";
    if (picture && !terminal.json && !terminal.quiet)
      print_text("{:<24} {}\n", file.name, file.caption);
  }
  if (terminal.json) print_json(json);
  if (!terminal.json && !terminal.quiet) {
    print_text("wrote {} to {}; index.html shows all pictures\n",
               counted(files.size(), "file"),
               arguments.folder.string());
  }
}

/// The scan as the named camera captured it; as the reference camera did without a name.
Scan choose_camera(const Scan& scan, const std::string& name) {
  if (name.empty()) return scan_of_camera(scan, 0);
  std::vector<std::string> names;
  for (const PosedCamera& posed : scan.rig.more_cameras) {
    names.push_back(posed.camera.name);
    if (names.back() == name) return scan_of_camera(scan, names.size());
  }
  throw Error(ErrorKind::Input,
              fmt::format("{} has no `camera` \"{}\" in its rig.toml; {}",
                          scan.folder.string(),
                          name,
                          names.empty() ? "it has the reference camera alone"
                                        : fmt::format("it has {}", fmt::join(names, ", "))));
}

void decode_verb(const DecodeArguments& arguments, Terminal& terminal) {
  const Run run = terminal.run();
  const Scan scan =
      choose_camera(read_scan(arguments.scan, run, RigContent::PhaseOnly), arguments.camera);
  if (arguments.view >= scan.views.size()) {
    throw Error(ErrorKind::Input,
                fmt::format("{} has no `view` {}; its views are 0 to {}",
                            arguments.scan.string(),
                            arguments.view,
                            scan.views.size() - 1));
  }
  if (arguments.options.phase_files) check_phase_files(*arguments.options.phase_files, scan);
  make_folder(arguments.folder);
  check_can_write(arguments.folder / "index.html");
  const bool geometry = has_geometry(scan.rig);
  const auto rays = geometry ? rays_of(scan.rig.camera.model) : Image<Eigen::Vector2f>();
  DecodeOptions options = arguments.options;
  run.stage("survey");
  options.survey = survey_scan(scan, run);
  run.stage("phase");
  const auto frames = read_frames(scan, arguments.view, run);
  DecodedView decoded =
      decode_view(frames, scan.rig, rays, options_of_view(options, arguments.view), run);
  std::string reason;
  RangeGrid range;
  if (geometry) {
    run.stage("range");
    const ViewFit fit = check_view(decoded, scan.rig, rays, options.accept_inconsistent);
    reason = fit.reason;
    if (fit.fits()) {
      range = triangulate_view(decoded, fit, scan.rig, rays, options.directions).range;
      remove_mixed_pixels(range, rays, decoded.phase.status);
    }
    if (fit.accepted) {
      run.warn(reason + "; triangulated because `accept_inconsistent` is set");
      reason.clear();
    }
  } else {
    run.note("rig.toml holds no geometry: no depth is computed");
    reason = options.accept_inconsistent ? "" : describe(decoded.checks);
  }
  run.stage("files");
  const auto files = write_stages(decoded, range, arguments.folder, run);
  terminal.assess(reason);
  print_result(decoded, files, reason, arguments, terminal);
}

}  // namespace

void add_decode_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<DecodeArguments>();
  CLI::App* verb =
      program.add_subcommand("decode", "write the images of each decoding stage of one view");
  verb->footer("example:\n  frangia decode ball-bar --view 3 -o stages");
  verb->add_option(
          "SCAN", arguments->scan, "the scan folder, with scan.toml; without rig.toml, phases only")
      ->required();
  verb->add_option("--view", arguments->view, "number of the view, counted from 0")
      ->check(zero_or_more())
      ->capture_default_str();
  verb->add_option("--camera",
                   arguments->camera,
                   "name of one of `more_cameras`; the reference camera by default");
  verb->add_option("-o,--output", arguments->folder, "folder to write to")->required();
  add_decode_options(*verb, arguments->options);
  arguments->options.spatial.keep_growth_order = true;
  verb->callback([arguments, &terminal] { decode_verb(*arguments, terminal); });
}

}  // namespace frangia

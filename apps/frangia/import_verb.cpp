#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/dataset/import_frames.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/phase/wrap/estimate_noise.h"

#include "ask.h"
#include "counted.h"
#include "import_table.h"
#include "import_values.h"
#include "option_values.h"
#include "print_text.h"
#include "shell_quoted.h"
#include "verbs.h"

namespace frangia {
namespace {

struct ImportArguments {
  std::filesystem::path source;
  std::filesystem::path scan;
  ImportOptions options;
  std::vector<std::string> fringes;
  std::vector<std::string> periods;
  std::vector<double> shifts_deg;
  double origin_deg = 0.0;
  std::vector<double> angles_deg;
  std::string projector;
  std::string raw;
  std::string color;
  double white_level = 0.0;
  bool yes = false;
};

ImportOptions options_of(const ImportArguments& arguments) {
  ImportOptions options = arguments.options;
  options.fringes = values_of(arguments.fringes, "fringes");
  options.period_px = values_of(arguments.periods, "period");
  for (const double shift : arguments.shifts_deg)
    options.shifts_rad.push_back(rad_from_deg(shift));
  options.origin_rad = rad_from_deg(arguments.origin_deg);
  for (const double angle : arguments.angles_deg)
    options.angles_rad.push_back(rad_from_deg(angle));
  if (!arguments.projector.empty()) options.projector_px = projector_size_of(arguments.projector);
  if (!arguments.raw.empty()) options.files.raw = parse_raw_format(arguments.raw);
  if (!arguments.color.empty()) options.color = parse_color_choice(arguments.color);
  options.float_white = arguments.white_level;
  if (arguments.white_level > 0.0) {
    options.white_level =
        static_cast<int>(std::clamp(std::round(arguments.white_level), 1.0, 65535.0));
  }
  return options;
}

/// Shows a guessed template and asks whether it is right.
void confirm(const ImportPlan& plan, const ImportArguments& arguments, const Run& run) {
  if (!plan.guessed || arguments.yes) return;
  const std::string quoted = shell_quoted(plan.names);
  if (!can_ask()) {
    throw Error(ErrorKind::Input,
                fmt::format("the template {} is guessed; set `names` to it, or set `yes` to accept "
                            "the guess",
                            quoted));
  }
  if (!ask(fmt::format("The template {} is guessed. Import these frames?", quoted), run))
    throw Error(ErrorKind::Input, "nothing is imported; set `names` to the template of the files");
}

/// Warns of the noise that JPEG adds, and states that of the frames of the first view for
/// comparison.
void warn_of_compression(const ImportPlan& plan, const ImportResult& result, const Run& run) {
  if (plan.jpeg_quality == 0) return;
  std::string for_comparison;
  const bool has_fringes =
      std::any_of(result.scan.patterns.begin(), result.scan.patterns.end(), [](const Pattern& p) {
        return p.kind == PatternKind::Fringe;
      });
  if (has_fringes) {
    const std::vector<FrameStack> stacks = read_frames(result.scan, 0, run);
    const double middle = 0.5 * result.scan.rig.reference().white_level;
    for_comparison = fmt::format(" (the frames show {:.2g} counts)",
                                 std::sqrt(estimate_noise(stacks).variance(middle)));
  }
  run.warn(
      fmt::format("the frames are JPEGs of quality {}: the compression adds noise of {:.2g} counts "
                  "to each pixel{}, and sigma counts it; capture PNG, TIFF or BMP for the full "
                  "accuracy",
                  plan.jpeg_quality,
                  std::sqrt(result.compression_counts2),
                  for_comparison));
}

void print_result(const ImportPlan& plan,
                  const ImportResult& result,
                  const std::string& folder,
                  Terminal& terminal) {
  terminal.finish();
  const Camera& camera = result.scan.rig.reference();
  if (terminal.json) {
    nlohmann::ordered_json json{{"scan", folder},
                                {"names", plan.names},
                                {"frames", plan.frames.size()},
                                {"views", plan.views},
                                {"left_out", plan.left_out.size()},
                                {"size_px", {camera.model.width_px, camera.model.height_px}},
                                {"white_level", camera.white_level},
                                {"codec", plan.image.codec}};
    json["patterns"] = nlohmann::ordered_json::array();
    for (const Pattern& pattern : plan.patterns)
      json["patterns"].push_back({{"name", pattern.name}, {"frames", pattern.frame_count()}});
    if (plan.jpeg_quality > 0) {
      json["jpeg_quality"] = plan.jpeg_quality;
      json["compression_counts2"] = result.compression_counts2;
    }
    print_json(json);
    return;
  }
  if (terminal.quiet) return;
  if (!plan.left_out.empty()) {
    print_text("left out {}, as a scan holds no frame of a dark projector\n",
               counted(plan.left_out.size(), "image"));
  }
  print_text(
      "wrote {} of {} x {} pixels in {} to {}, white level {}; next: frangia decode {} -o "
      "stages\n",
      counted(plan.frames.size(), "frame"),
      camera.model.width_px,
      camera.model.height_px,
      counted(plan.views, "view"),
      folder,
      camera.white_level,
      shell_quoted(folder));
}

void import_folder(const ImportArguments& arguments, Terminal& terminal) {
  const Run run = terminal.run();
  run.stage("files");
  const ImportPlan plan = plan_import(arguments.source, options_of(arguments), run);
  terminal.finish();
  if (!terminal.json && !terminal.quiet) {
    print_text(
        "{} fit {}\n", counted(plan.frames.size() + plan.left_out.size(), "image"), plan.names);
    write_output(import_table(plan));
    flush_output();
  }
  confirm(plan, arguments, run);
  const ImportResult result = import_frames(plan, arguments.scan, run);
  warn_of_compression(plan, result, run);
  print_result(plan, result, arguments.scan.string(), terminal);
}

void add_pattern_options(CLI::App& verb, ImportArguments& arguments) {
  verb.add_option("--patterns",
                  arguments.options.patterns,
                  "a TOML file with the [[pattern]] tables of scan.toml");
  verb.add_option("--fringes",
                  arguments.fringes,
                  "number of fringes over the projector's width, one for each pattern in the order "
                  "of their names, such as 64,58,53, or NAME=NUMBER")
      ->delimiter(',');
  verb.add_option("--period",
                  arguments.periods,
                  "period of the fringes in projector pixels, listed as for --fringes")
      ->delimiter(',');
  verb.add_option("--shifts",
                  arguments.shifts_deg,
                  "phase shift of each frame, degrees; by default equal steps over 360")
      ->delimiter(',');
  verb.add_flag("--reverse-shifts",
                arguments.options.reverse_shifts,
                "the shifts have the opposite sign: I = A + B cos(phase - shift)");
  verb.add_option("--origin",
                  arguments.origin_deg,
                  "phase at the centre of the projector's first column, degrees; -90 for sine "
                  "fringes");
  verb.add_option(
          "--orientation",
          arguments.options.orientation,
          "of frames with an EXIF orientation: stored, as in the file, or shown, turned; by "
          "default as fits the rig")
      ->transform(named<FrameOrientation>());
  verb.add_option("--skip",
                  arguments.options.skip,
                  "numbers of frames, as the names state them, that are left out, such as 0,13")
      ->delimiter(',');
  verb.add_flag("--horizontal",
                arguments.options.horizontal,
                "the phase varies with the projector's row instead of its column");
}

}  // namespace

void add_import_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<ImportArguments>();
  CLI::App* verb = program.add_subcommand("import", "make a scan from images of other programs");
  verb->footer(
      "example:\n  frangia import captures -o scan --names \"{pattern}_{frame:02}.bmp\" --fringes "
      "53,58,64 --projector 1280x800\n"
      "  frangia import captures -o scan --layout scan3d-capture --rig rig.toml\n"
      "  frangia import captures -o scan --names \"{camera}/{frame}.png\" --patterns "
      "patterns.toml\n"
      "  frangia import stack.tif -o scan --patterns patterns.toml\n"
      "docs/your-own-frames.md leads from a folder of images to a point cloud");
  verb->add_option("FOLDER", arguments->source, "folder with the images, or one file with several")
      ->required();
  verb->add_option("-o,--output", arguments->scan, "new folder for the scan")->required();
  verb->add_option("--names",
                   arguments->options.names,
                   "template of the file names with {pattern}, {frame}, {view} and {camera}; "
                   "{frame:02} is a number of two digits, {*} any text such as a time; guessed by "
                   "default");
  verb->add_option("--reference",
                   arguments->options.reference,
                   "the reference camera among those of {camera}; by default the one that the rig "
                   "does not name, or the first");
  verb->add_flag("--yes", arguments->yes, "accept a guessed template without a question");
  std::vector<std::string> layouts;
  std::string meanings = "sequence of another program:";
  for (const KnownLayout& layout : known_layouts()) {
    layouts.emplace_back(layout.name);
    meanings += fmt::format("\n{} ({})", layout.name, layout.meaning);
  }
  verb->add_option("--layout", arguments->options.layout, meanings)->check(one_of(layouts));
  add_pattern_options(*verb, *arguments);
  verb->add_option("--projector", arguments->projector, "size of the projector, such as 1280x800");
  verb->add_option(
      "--rig", arguments->options.rig, "rig.toml to copy; by default one of the sizes alone");
  verb->add_option("--angles", arguments->angles_deg, "turntable angle of each view, degrees")
      ->delimiter(',');
  verb->add_option("--color",
                   arguments->color,
                   "grey from colour frames: red, green, blue, luminance, or demosaic:RGGB (BGGR, "
                   "GRBG, GBRG) for raw mosaics");
  verb->add_option(
      "--raw", arguments->raw, "the files hold bare samples: WIDTHxHEIGHTxBITS, then le or be");
  verb->add_option("--white-level",
                   arguments->white_level,
                   "value at which the camera saturates, such as 4095; by default from the frames")
      ->check(above_zero());
  verb->add_option("--allow-memory",
                   arguments->options.files.allow_memory_bytes,
                   "memory that a small file may take when it expands, such as 4GB; 2GB by default")
      ->transform(size_above_zero());
  verb->callback([arguments, &terminal] { import_folder(*arguments, terminal); });
}

}  // namespace frangia

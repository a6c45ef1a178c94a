#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/pattern/fringe_sequence.h"
#include "frangia/rig/read_rig.h"
#include "frangia/simulate/rig_presets.h"

#include "counted.h"
#include "option_values.h"
#include "plan_scan_verb.h"
#include "print_text.h"
#include "usage.h"
#include "verbs.h"

namespace frangia {
namespace {

struct PlanArguments {
  std::string rig = "digital";
  double fringes = 64.0;
  double sigma_rad = 0.1;
  double max_wrong_order = 1e-6;
  std::optional<int> maps;
  std::optional<double> lowest;
  bool indirect = false;
};

/// The finest fringes that projector and camera still show well: ten pixels of the projector.
double fine_fringes(const Rig& rig) {
  constexpr double kPeriod_px = 10.0;
  constexpr double kOfAngular = 64.0;
  const auto* pinhole = std::get_if<PinholeModel>(&rig.projector.model);
  return pinhole == nullptr ? kOfAngular : std::floor(pinhole->width_px / kPeriod_px);
}

/// A hierarchy from one fringe, or beats of a given number of maps.
SequencePlan plan_of(const PlanArguments& arguments) {
  if (arguments.indirect) {
    constexpr int kMaps = 4;
    require_usage(!arguments.lowest,
                  "with `indirect`, the band is the narrowest one; leave out `lowest`");
    return plan_narrow_band(arguments.fringes,
                            arguments.maps.value_or(kMaps),
                            arguments.sigma_rad,
                            arguments.max_wrong_order);
  }
  if (!arguments.maps) {
    require_usage(!arguments.lowest,
                  "`lowest` is for sequences of beats; set the number of `maps`");
    return plan_sequence(arguments.fringes, arguments.sigma_rad, arguments.max_wrong_order);
  }
  return plan_beats(arguments.fringes,
                    *arguments.maps,
                    arguments.lowest.value_or(0.5 * arguments.fringes),
                    arguments.sigma_rad,
                    arguments.max_wrong_order);
}

void plan(PlanArguments arguments, bool fringes_given, Terminal& terminal) {
  const Rig rig = std::filesystem::path(arguments.rig).has_extension()
                      ? read_rig(arguments.rig, terminal.run())
                      : rig_preset(arguments.rig);
  if (arguments.indirect && !fringes_given) arguments.fringes = fine_fringes(rig);
  const SequencePlan found = plan_of(arguments);
  const auto* pinhole = std::get_if<PinholeModel>(&rig.projector.model);
  std::vector<double> values;
  for (const double fringes : found.fringes) {
    if (pinhole != nullptr) {
      values.push_back(pinhole->width_px / fringes);
      require(values.back() >= 2.0,
              "a fringe of the finest pattern is narrower than 2 projector pixels; set fewer "
              "`fringes`");
    } else {
      const auto& field = std::get<AngularModel>(rig.projector.model);
      values.push_back(fringes * field.pitch_scale /
                       deg_from_rad(field.field_max_rad - field.field_min_rad));
    }
  }
  const std::string key = pinhole != nullptr ? "period_px" : "fringes_per_degree";
  if (terminal.json) {
    const nlohmann::ordered_json json{
        {"fringes", found.fringes}, {key, values}, {"wrong_order", found.wrong_order}};
    print_json(json);
    return;
  }
  write_output(fmt::format(
      "{}, {} = {:.6g}\nfringes over the field: {:.4g}\nprobability of a wrong order: {:.1e} per "
      "pixel\n",
      counted(values.size(), "pattern"),
      key,
      fmt::join(values, ", "),
      fmt::join(found.fringes, ", "),
      found.wrong_order));
}

/// The options of `plan patterns`, which `plan` has, too; without another subcommand it does the
/// same.
void add_pattern_options(CLI::App* verb, Terminal& terminal) {
  verb->footer(
      "examples:\n"
      "  frangia plan patterns --rig digital --fringes 64 --sigma 0.1\n"
      "  frangia plan patterns --rig digital --fringes 64 --sigma 0.05 --maps 3     only fine "
      "fringes, such as 64, 58 and 53\n"
      "  frangia plan patterns --rig digital --indirect                             fine fringes "
      "of nearly one pitch, for parts that light themselves");
  auto arguments = std::make_shared<PlanArguments>();
  verb->add_option("--rig", arguments->rig, "name of a rig, or a rig.toml")->capture_default_str();
  auto* fringes = verb->add_option("--fringes",
                                   arguments->fringes,
                                   "fringes of the finest pattern over the field; with --indirect "
                                   "by default of 10 px");
  fringes->check(above_zero())->capture_default_str();
  verb->add_option("--sigma", arguments->sigma_rad, "phase noise of one map, rad")
      ->check(above_zero())
      ->capture_default_str();
  verb->add_option("--max-wrong-order",
                   arguments->max_wrong_order,
                   "allowed probability of a wrong fringe order per pixel")
      ->check(from_to(1e-15, 0.5))
      ->capture_default_str();
  verb->add_option("--maps",
                   arguments->maps,
                   "plan beats: this many maps of fine fringes whose combination determines the "
                   "order, none of them with a single fringe")
      ->check(from_to(2, 16));
  verb->add_option("--lowest",
                   arguments->lowest,
                   "fewest fringes of a map over the field, with --maps (default: half of "
                   "--fringes)")
      ->check(above_zero());
  verb->add_flag("--indirect",
                 arguments->indirect,
                 "plan maps of fine fringes of nearly the same pitch (micro phase shifting), over "
                 "which indirect light averages out; 4 maps unless --maps is set");
  verb->callback([verb, arguments, fringes, &terminal] {
    if (verb->get_subcommands().empty()) plan(*arguments, fringes->count() > 0, terminal);
  });
}

}  // namespace

void add_plan_verb(CLI::App& program, Terminal& terminal) {
  CLI::App* verb = program.add_subcommand(
      "plan", "plan the scan of a part, or the shortest pattern sequence for a given phase noise");
  add_pattern_options(verb, terminal);
  verb->require_subcommand(0, 1);
  add_pattern_options(verb->add_subcommand(
                          "patterns", "find the shortest pattern sequence for a given phase noise"),
                      terminal);
  add_plan_scan_verb(*verb, terminal);
}

}  // namespace frangia

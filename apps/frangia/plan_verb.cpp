#include <filesystem>
#include <memory>
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
#include "print_text.h"
#include "verbs.h"

namespace frangia {
namespace {

struct PlanArguments {
  std::string rig = "digital";
  double fringes = 64.0;
  double sigma_rad = 0.1;
  double max_wrong_order = 1e-6;
};

void plan(const PlanArguments& arguments, Terminal& terminal) {
  const Rig rig = std::filesystem::path(arguments.rig).has_extension()
                      ? read_rig(arguments.rig, terminal.run())
                      : rig_preset(arguments.rig);
  const SequencePlan found =
      plan_sequence(arguments.fringes, arguments.sigma_rad, arguments.max_wrong_order);
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
      values.push_back(fringes / deg_from_rad(field.field_max_rad - field.field_min_rad));
    }
  }
  const std::string key = pinhole != nullptr ? "period_px" : "fringes_per_degree";
  if (terminal.json) {
    const nlohmann::ordered_json json{
        {"fringes", found.fringes}, {key, values}, {"wrong_order", found.wrong_order}};
    print_json(json);
    return;
  }
  fmt::print(
      "{}, {} = {:.6g}\nfringes over the field: {:.4g}\nprobability of a wrong order: {:.1e} per "
      "pixel\n",
      counted(values.size(), "pattern"),
      key,
      fmt::join(values, ", "),
      fmt::join(found.fringes, ", "),
      found.wrong_order);
}

}  // namespace

void add_plan_verb(CLI::App& program, Terminal& terminal) {
  CLI::App* verb =
      program.add_subcommand("plan", "find the shortest pattern sequence for a given phase noise");
  verb->footer("example:\n  frangia plan --rig digital --fringes 64 --sigma 0.1");
  auto arguments = std::make_shared<PlanArguments>();
  verb->add_option("--rig", arguments->rig, "name of a rig, or a rig.toml")->capture_default_str();
  verb->add_option("--fringes", arguments->fringes, "fringes of the finest pattern over the field")
      ->check(above_zero())
      ->capture_default_str();
  verb->add_option("--sigma", arguments->sigma_rad, "phase noise of one map, rad")
      ->check(above_zero())
      ->capture_default_str();
  verb->add_option("--max-wrong-order",
                   arguments->max_wrong_order,
                   "allowed probability of a wrong fringe order per pixel")
      ->check(from_to(1e-15, 0.5))
      ->capture_default_str();
  verb->callback([arguments, &terminal] { plan(*arguments, terminal); });
}

}  // namespace frangia

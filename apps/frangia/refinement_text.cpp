#include "refinement_text.h"

#include <fmt/format.h>

#include "print_text.h"
#include "text_table.h"

namespace frangia {

nlohmann::ordered_json json_of(const RigRefinement& refinement) {
  nlohmann::ordered_json json{{"kept_rig", refinement.kept_rig},
                              {"rms_before_mm", refinement.rms_before_mm},
                              {"rms_after_mm", refinement.rms_after_mm},
                              {"directions", refinement.directions},
                              {"held_directions", refinement.held},
                              {"axis_moved_mm", refinement.axis_moved_mm},
                              {"scale", refinement.scale}};
  json["not_determined"] = nlohmann::ordered_json::array();
  for (const RefinedParameter& parameter : refinement.parameters) {
    json["parameters"][parameter.name] = {{"change", parameter.change},
                                          {"prior_sigma", parameter.prior_sigma},
                                          {"sigma", parameter.sigma}};
    if (!parameter.determined) json["not_determined"].push_back(parameter.name);
  }
  return json;
}

void print_changes(const RigRefinement& refinement) {
  if (refinement.kept_rig && refinement.scale == 1.0) return;
  TextColumn name{"parameter", {}, false};
  TextColumn change{"change", {}};
  TextColumn sigma{"sigma", {}};
  TextColumn prior{"before", {}};
  TextColumn state{"", {}, false};
  for (const RefinedParameter& parameter : refinement.parameters) {
    name.values.push_back(parameter.name);
    change.values.push_back(fmt::format("{:.3g}", parameter.change));
    sigma.values.push_back(fmt::format("{:.2g}", parameter.sigma));
    prior.values.push_back(fmt::format("{:.2g}", parameter.prior_sigma));
    state.values.emplace_back(parameter.determined ? "" : "not determined");
  }
  write_output(text_table({name, change, sigma, prior, state}));
}

}  // namespace frangia

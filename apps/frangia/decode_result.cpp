#include "decode_result.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/statistics.h"
#include "frangia/decode/explain/hypothesis_table.h"
#include "frangia/decode/stage_pictures.h"

#include "counted.h"
#include "json_number.h"
#include "option_names.h"
#include "print_text.h"
#include "quality_json.h"

namespace frangia {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const DecodePlan& plan) {
  Json json = Json::array();
  for (const DirectionPlan& direction : plan.directions) {
    Json maps = Json::array();
    for (const Pattern& map : direction.maps)
      maps.push_back(map.name);
    json.push_back({{"direction", name_of(direction.direction)},
                    {"maps", maps},
                    {"orders", name_of(direction.orders)},
                    {"text", describe(direction)}});
  }
  return json;
}

Json json_of(const SequenceCheck& check) {
  Json json{{"patterns", check.patterns},
            {"decided", check.decided},
            {"consistent", check.consistent},
            {"misfit_rad", number_or_null(check.misfit_rad)},
            {"chance_rad", number_or_null(check.chance_rad)},
            {"fits", Json::array()}};
  for (const SequenceFault& fault : check.fits) {
    json["fits"].push_back({{"kind", name_of(fault.kind)},
                            {"patterns", fault.patterns},
                            {"what", fault.what},
                            {"same_as", fault.same_as},
                            {"keys", fault.keys}});
  }
  return json;
}

/// The causes of the best class, each once.
std::vector<std::string> causes_of(const FrameExplanation& found) {
  std::vector<std::string> out{name_of(found.best.cause)};
  for (const FrameHypothesis& one : found.alike) {
    const std::string cause = name_of(one.cause);
    if (std::find(out.begin(), out.end(), cause) == out.end()) out.push_back(cause);
  }
  return out;
}

Json json_of(const FrameVerdict& verdict) {
  const FrameExplanation& found = verdict.explanation;
  const double log_odds = found.explanation.log_odds;
  return {{"pattern", found.pattern},
          {"decided", found.decided},
          {"cause", name_of(found.best.cause)},
          {"causes", causes_of(found)},
          {"frames", found.best.frames},
          {"best", found.explanation.best},
          {"second", found.explanation.second},
          {"log10_odds", number_or_null(log_odds / std::log(10.0))},
          {"unexplained", number_or_null(found.explanation.unexplained)},
          {"unexplained_rad", number_or_null(found.unexplained_rad)},
          {"remedy", found.explanation.remedy},
          {"left_out", verdict.left_out},
          {"text", verdict.finding}};
}

Json json_of(const FrameAssessment& assessment) {
  return {{"name", assessment.pattern},
          {"algorithm", assessment.algorithm},
          {"frames", assessment.frames},
          {"step_deg", assessment.nominal_deg > 0.0 ? Json(assessment.step_deg) : Json()},
          {"contrast", number_or_null(assessment.contrast)},
          {"measured_share", number_or_null(assessment.measured_fraction)},
          {"saturated_share", number_or_null(assessment.saturated_fraction)},
          {"residual_ratio",
           assessment.frames > 3 ? number_or_null(assessment.residual_ratio) : Json()},
          {"harmonic", assessment.harmonic},
          {"harmonic_error_rad", number_or_null(assessment.harmonic_error_rad)},
          {"flicker_error_rad", number_or_null(assessment.flicker_error_rad)},
          {"exceeds_noise", assessment.exceeds_noise},
          {"text", with_flags(describe(assessment))}};
}

std::size_t measured_count(std::span<const float> values) {
  return static_cast<std::size_t>(std::count_if(
      values.begin(), values.end(), [](float value) { return std::isfinite(value); }));
}

/// The median of the values that are there; NaN of none.
double known_median(std::span<const float> values) {
  std::vector<float> known;
  std::copy_if(values.begin(), values.end(), std::back_inserter(known), [](float value) {
    return std::isfinite(value);
  });
  return known.empty() ? kMissing : static_cast<double>(median_in_place(std::span(known)));
}

struct ViewFigures {
  std::size_t measured = 0;  ///< pixels with a final phase
  double sigma_rad = kMissing;
  std::size_t points = 0;
  double sigma_mm = kMissing;
  ViewQuality quality;
};

ViewFigures figures_of(const ViewResult& result) {
  const AbsolutePhase& phase = result.decoded.directions.front().phase;
  return {measured_count(phase.phase_rad.pixels()),
          known_median(phase.sigma_rad.pixels()),
          measured_count(result.range.depth_mm.pixels()),
          known_median(result.range.sigma_mm.pixels()),
          view_quality(assessments_of(result.decoded))};
}

Json json_of_view(const Scan& scan, const ViewResult& result, const ViewFigures& figures) {
  const ScanView& view = scan.views[result.view];
  Json json{{"view", result.view},
            {"folder", view.folder.string()},
            {"angle_deg", deg_from_rad(view.angle_rad)}};
  json.update(json_of_quality(figures.quality, !result.reason.empty()));
  json["measured"] = figures.measured;
  json["phase_sigma_rad"] = number_or_null(figures.sigma_rad);
  const bool has_points = !result.range.depth_mm.empty();
  json["points"] = has_points ? Json(figures.points) : Json();
  json["sigma_mm"] = number_or_null(figures.sigma_mm);
  const auto status = result.decoded.directions.front().phase.status.pixels();
  for (const StatusLegend& entry : status_legend())
    json["pixels"][entry.meaning] = std::count(status.begin(), status.end(), entry.status);
  json["patterns"] = Json::array();
  for (const FrameAssessment& assessment : assessments_of(result.decoded))
    json["patterns"].push_back(json_of(assessment));
  json["checks"] = Json::array();
  json["explanations"] = Json::array();
  for (const DecodedDirection& direction : result.decoded.directions) {
    if (direction.check) json["checks"].push_back(json_of(*direction.check));
    for (const FrameVerdict& verdict : direction.frames)
      json["explanations"].push_back(json_of(verdict));
  }
  const std::string& reason = result.reason.empty() ? result.empty : result.reason;
  json["trustworthy"] = reason.empty();
  if (!reason.empty()) json["reason"] = with_flags(reason);
  json["files"] = Json::array();
  for (const StageFile& file : result.files) {
    json["files"].push_back(file.name);
    json["captions"][file.name] = file.caption;
  }
  return json;
}

void print_stages(const ViewResult& result, const std::filesystem::path& folder) {
  const auto status = result.decoded.directions.front().phase.status.pixels();
  for (const StatusLegend& entry : status_legend()) {
    const auto count = std::count(status.begin(), status.end(), entry.status);
    if (count == 0) continue;
    print_text("{:>10} {:<6} {} ({} in mask.png)\n",
               count,
               count == 1 ? "pixel" : "pixels",
               entry.meaning,
               entry.color_name);
  }
  for (const FrameAssessment& assessment : assessments_of(result.decoded))
    print_text("{}\n", with_flags(describe(assessment)));
  for (const StageFile& file : result.files) {
    if (std::filesystem::path(file.name).extension() == ".png")
      print_text("{:<24} {}\n", file.name, file.caption);
  }
  print_text("wrote {} to {}; index.html shows all pictures\n",
             counted(result.files.size(), "file"),
             folder.string());
}

}  // namespace

void print_hypotheses(Terminal& terminal) {
  const std::vector<CauseRow> rows = hypothesis_table();
  const std::vector<AlikeCauses> classes = alike_causes();
  if (terminal.json) {
    Json json{{"steps", tabulated_steps()}, {"causes", Json::array()}, {"alike", Json::array()}};
    for (const CauseRow& row : rows) {
      json["causes"].push_back({{"cause", row.cause},
                                {"model", row.model},
                                {"consequence", with_flags(row.consequence)},
                                {"hypotheses", row.counts}});
    }
    for (const AlikeCauses& one : classes)
      json["alike"].push_back(
          {{"steps", one.steps}, {"causes", one.causes}, {"classes", one.classes}});
    print_json(json);
    return;
  }
  print_text("| cause | model | hypotheses with {} steps | what follows |\n|---|---|---|---|\n",
             fmt::format("{}", fmt::join(tabulated_steps(), ", ")));
  for (const CauseRow& row : rows) {
    print_text("| `{}` | {} | {} | {} |\n",
               row.cause,
               row.model,
               fmt::format("{}", fmt::join(row.counts, ", ")),
               with_flags(row.consequence));
  }
  print_text("\n| steps | causes whose frames are the same | classes |\n|---|---|---|\n");
  for (const AlikeCauses& one : classes)
    print_text("| {} | {} | {} |\n",
               one.steps,
               fmt::format("{}", fmt::join(one.causes, " = ")),
               one.classes);
}

void print_plan(const DecodePlan& plan, Terminal& terminal) {
  if (terminal.json) {
    print_json(Json{{"plan", json_of(plan)}, {"absolute", is_absolute(plan)}});
  } else {
    for (const DirectionPlan& direction : plan.directions)
      print_text("{}\n", describe(direction));
  }
}

void print_decoded_view(const Scan& scan,
                        const DecodePlan& plan,
                        const ViewResult& result,
                        const std::filesystem::path& folder,
                        Terminal& terminal) {
  terminal.assess(result.reason.empty() ? result.empty : result.reason);
  terminal.finish();
  if (terminal.json) {
    Json json{{"plan", json_of(plan)}};
    json.update(json_of_view(scan, result, figures_of(result)));
    json["warnings"] = terminal.warnings();
    print_json(json);
  } else if (!terminal.quiet) {
    print_stages(result, folder);
  }
}

DecodedScan::DecodedScan(const Scan& scan,
                         const DecodePlan& plan,
                         const std::filesystem::path& folder,
                         Terminal& terminal)
    : scan_(scan),
      plan_(plan),
      folder_(folder),
      terminal_(terminal),
      views_(std::make_unique<Json>(Json::array())) {}

DecodedScan::~DecodedScan() = default;

void DecodedScan::add(const ViewResult& result) {
  const ViewFigures figures = figures_of(result);
  const std::string name = scan_.views[result.view].folder.string();
  if (!result.reason.empty()) {
    untrusted_.push_back(name + ": " + result.reason);
    terminal_.run().warn(untrusted_.back());
  }
  if (!result.empty.empty()) {
    empty_.push_back(name + ": " + result.empty);
    terminal_.run().warn(empty_.back());
  }
  if (terminal_.json) {
    views_->push_back(json_of_view(scan_, result, figures));
    return;
  }
  for (const FrameAssessment& assessment : assessments_of_used(result.decoded)) {
    if (needs_attention(assessment))
      terminal_.run().warn(fmt::format("{}: {}", name, describe(assessment)));
  }
  if (terminal_.quiet) return;
  terminal_.finish();
  const auto share = [](double value) {
    return std::isfinite(value) ? fmt::format("{:.1f} %", 100.0 * value) : std::string("-");
  };
  const auto all =
      static_cast<double>(result.decoded.directions.front().phase.phase_rad.pixels().size());
  std::string text = fmt::format("{:03}  {:7.2f} deg  {:>6} measured, {:>5} saturated, contrast {}",
                                 result.view,
                                 deg_from_rad(scan_.views[result.view].angle_rad),
                                 share(static_cast<double>(figures.measured) / all),
                                 share(figures.quality.saturated_share),
                                 std::isfinite(figures.quality.contrast)
                                     ? fmt::format("{:.2f}", figures.quality.contrast)
                                     : "-");
  if (std::isfinite(figures.sigma_rad))
    text += fmt::format(", sigma {:.4f} rad", figures.sigma_rad);
  if (std::isfinite(figures.sigma_mm))
    text += fmt::format(", {} points, sigma {:.4f} mm", figures.points, figures.sigma_mm);
  print_text("{}\n", text);
}

void DecodedScan::finish() {
  terminal_.finish();
  if (untrusted_.empty() && empty_.size() == scan_.views.size())
    untrusted_.push_back(empty_.front());
  std::string reason;
  if (!untrusted_.empty()) {
    reason = untrusted_.size() == 1 ? untrusted_.front()
                                    : fmt::format("{} of {} views do not fit; the first: {}",
                                                  untrusted_.size(),
                                                  scan_.views.size(),
                                                  untrusted_.front());
  }
  terminal_.assess(reason);
  if (terminal_.json) {
    Json json{{"plan", json_of(plan_)},
              {"views", std::move(*views_)},
              {"trustworthy", untrusted_.empty()}};
    if (!untrusted_.empty()) json["reason"] = with_flags(untrusted_.front());
    json["warnings"] = terminal_.warnings();
    print_json(json);
  } else if (!terminal_.quiet) {
    print_text("wrote the maps of {} to {}; `frangia reconstruct --phase` reads them\n",
               counted(scan_.views.size(), "view"),
               folder_.string());
  }
}

}  // namespace frangia

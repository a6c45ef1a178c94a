#include "frangia/acceptance/acceptance_plan.h"

#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/read_file.h"
#include "frangia/rig/toml_reader.h"

namespace frangia {
namespace {

double not_negative(TomlReader& reader, std::string_view key, double fallback) {
  const double value = reader.number_or(key, fallback);
  if (value < 0.0) reader.fail(key, "must be 0 or more");
  return value;
}

ReferenceArtifact artifact_of(TomlReader reader) {
  ReferenceArtifact artifact;
  artifact.diameters_mm = reader.numbers("diameters_mm");
  if (artifact.diameters_mm.empty() || artifact.diameters_mm.size() > 2)
    reader.fail("diameters_mm", "must be the diameters of one ball or of two");
  double radii = 0.0;
  for (const double diameter : artifact.diameters_mm) {
    if (!(diameter > 0.0)) reader.fail("diameters_mm", "must be above 0");
    radii += 0.5 * diameter;
  }
  if (artifact.diameters_mm.size() == 2) {
    artifact.spacing_mm = reader.positive("spacing_mm");
    if (artifact.spacing_mm < radii)
      reader.fail("spacing_mm", "is less than the sum of the radii: the balls would overlap");
  } else if (reader.has("spacing_mm")) {
    reader.fail("spacing_mm", "needs the diameters of two balls");
  }
  artifact.u95_mm = reader.positive("u95_mm");
  artifact.form_mm = not_negative(reader, "form_mm", 0.0);
  artifact.expansion_ppm_per_k = not_negative(reader, "expansion_ppm_per_k", 0.0);
  if (reader.has("certificate")) artifact.certificate = reader.text("certificate");
  reader.refuse_unused_keys();
  return artifact;
}

AcceptanceLimits limits_from(TomlReader reader, bool bar) {
  AcceptanceLimits limits;
  const auto read = [&](std::string_view key, std::optional<double>& limit) {
    if (reader.has(key)) limit = reader.positive(key);
  };
  read("probing_form_mm", limits.probing_form_mm);
  read("probing_size_mm", limits.probing_size_mm);
  for (const char* key : {"sphere_spacing_mm", "length_mm"}) {
    if (!bar && reader.has(key)) reader.fail(key, "needs the diameters of two balls");
  }
  read("sphere_spacing_mm", limits.sphere_spacing_mm);
  read("length_mm", limits.length_mm);
  reader.refuse_unused_keys();
  return limits;
}

std::vector<Arrangement> arrangements_of(TomlReader& top, const std::filesystem::path& folder) {
  std::vector<Arrangement> arrangements;
  for (TomlReader& reader : top.tables("arrangements")) {
    Arrangement arrangement;
    arrangement.name = reader.text("name");
    arrangement.scan = reader.text("scan");
    if (arrangement.scan.is_relative()) arrangement.scan = folder / arrangement.scan;
    for (const Arrangement& other : arrangements) {
      if (other.scan == arrangement.scan)
        reader.fail("scan", "is that of another arrangement, too; each needs a scan of its own");
    }
    reader.refuse_unused_keys();
    arrangements.push_back(arrangement);
  }
  return arrangements;
}

void read_conditions(TomlReader reader, AcceptancePlan& plan) {
  plan.temperature_c = reader.number_or("temperature_c", plan.temperature_c);
  plan.temperature_u_k = not_negative(reader, "temperature_u_k", 0.0);
  for (const std::string& key : reader.keys()) {
    if (key != "temperature_c" && key != "temperature_u_k")
      plan.conditions.emplace_back(key, reader.text(key));
  }
}

}  // namespace

std::vector<Arrangement> usual_arrangements(const ReferenceArtifact& artifact) {
  const auto at =
      [](const char* name, const Eigen::Vector3d& direction, const Eigen::Vector3d& offset) {
        return Arrangement{name, {}, direction.normalized(), offset};
      };
  if (artifact.diameters_mm.size() < 2) {
    return {at("in the middle of the turntable", {1, 0, 0}, {0, 0, 0}),
            at("near the edge of the volume, low", {1, 0, 0}, {1.0, 0, -0.5}),
            at("near the edge of the volume, high", {1, 0, 0}, {0, 1.0, 0.5})};
  }
  return {at("level, across the turntable, in the middle", {0, 1, 0}, {0, 0, 0}),
          at("level, turned by 60 degrees, low", {0.866, 0.5, 0}, {0, 0, -0.15}),
          at("level, turned by 120 degrees, high", {0.866, -0.5, 0}, {0, 0, 0.15}),
          at("upright", {0, 0, 1}, {0, 0, 0}),
          at("rising at 45 degrees", {0, 1, 1}, {0, 0, 0}),
          at("rising at 45 degrees, turned by 90 degrees", {1, 0, 1}, {0, 0, 0}),
          at("rising at 35 degrees along a diagonal of the volume", {1, 1, 1}, {0, 0, 0})};
}

AcceptancePlan read_acceptance_plan(const std::filesystem::path& path) {
  AcceptancePlan plan = parse_acceptance_plan(read_text_file(path), path);
  if (plan.arrangements.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: arrangements must name the scans: [[arrangements]] with name and "
                            "scan",
                            path.string()));
  }
  return plan;
}

AcceptancePlan parse_acceptance_plan(const std::string& text, const std::filesystem::path& path) {
  const toml::table table = parse_toml_text_as(text, path, "frangia-acceptance");
  TomlReader top(path, "", table);
  top.ignore("format");
  top.ignore("version");
  AcceptancePlan plan;
  plan.source = top.named<AcceptanceSource>("source");
  plan.artifact = artifact_of(top.table("artifact"));
  const bool bar = plan.artifact.diameters_mm.size() == 2;
  if (top.has("limits")) plan.limits = limits_from(top.table("limits"), bar);
  if (top.has("conditions")) read_conditions(top.table("conditions"), plan);
  if (top.has("volume_mm")) {
    const std::vector<double> sides = top.numbers("volume_mm", 3);
    plan.volume_mm = Eigen::Vector3d(sides[0], sides[1], sides[2]);
    if (!(plan.volume_mm->minCoeff() > 0.0)) top.fail("volume_mm", "must be above 0");
  }
  if (plan.source == AcceptanceSource::Scans) {
    plan.arrangements = arrangements_of(top, path.parent_path());
  } else {
    if (top.has("arrangements"))
      top.fail("arrangements", "is for source = \"scans\"; leave it out, the usual ones are made");
    plan.rig = top.text("rig");
    const std::filesystem::path beside = path.parent_path() / plan.rig;
    if (plan.rig.is_relative() && std::filesystem::exists(beside)) plan.rig = beside;
    if (top.has("views")) plan.views = top.integer("views", 2, 3600);
    plan.arrangements = usual_arrangements(plan.artifact);
  }
  top.refuse_unused_keys();
  return plan;
}

}  // namespace frangia

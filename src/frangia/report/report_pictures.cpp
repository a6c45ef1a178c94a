#include "frangia/report/report_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/read_file.h"
#include "frangia/core/statistics.h"
#include "frangia/frames/image_file.h"
#include "frangia/geometry/mesh.h"
#include "frangia/inspect/render_mesh.h"
#include "frangia/inspection/verdict_reasons.h"
#include "frangia/report/internal/feature_places.h"
#include "frangia/report/labelled_picture.h"

namespace frangia {
namespace {

constexpr std::array<double, 4> kAzimuths{35.0, 125.0, 215.0, 305.0};  // degrees

/// A place on the part that pictures label.
struct LabelledPlace {
  PictureLabel label;
  PicturedPlace place;
};

std::string value_text(double value, double u95) {
  if (!std::isfinite(u95)) return fmt::format("{:+.4f}", value);
  return fmt::format("{:+.4f} ± {:.4f}", value, u95);
}

/// The places that the pictures label, the most important first: what is out or undecided, the
/// extremes, then the characteristics, the worst first.
std::vector<LabelledPlace> labelled_places(const Inspection& part) {
  std::vector<LabelledPlace> places;
  if (part.surface) {
    const SurfaceVerdict& verdict = part.surface->verdict;
    for (const SurfacePlace& place : verdict.places) {
      LabelledPlace labelled{{}, {place.at_mm, place.normal}};
      const bool out = place.decision == PatchDecision::Out;
      labelled.label.conformity = out ? Conformity::Out : Conformity::Undecided;
      labelled.label.detail = out ? "out" : "undecided";
      if (place.decision == PatchDecision::NotWellMeasured) labelled.label.detail = "U95 too large";
      if (place.decision == PatchDecision::NotMeasured) labelled.label.detail = "not measured";
      // The mean of a place whose U95 is too large tells nothing; how large it is does.
      const bool lacks = place.decision == PatchDecision::NotWellMeasured ||
                         place.decision == PatchDecision::NotMeasured;
      labelled.label.text = place.missing ? "missing"
                            : lacks       ? fmt::format("{:.0f} mm²", place.area_mm2)
                                          : value_text(place.deviation_mm, place.u95_mm);
      constexpr double kLeastArea = 5e-3;  // of the part: smaller ones are in the table alone
      if (!lacks || place.area_mm2 > kLeastArea * verdict.area_mm2) places.push_back(labelled);
    }
    for (const auto& [extreme, detail] :
         {std::pair(verdict.highest, "largest"), std::pair(verdict.lowest, "smallest")}) {
      if (!std::isfinite(extreme.deviation_mm)) continue;
      const auto same =
          std::find_if(places.begin(), places.end(), [&](const LabelledPlace& labelled) {
            return labelled.place.point_mm == extreme.at_mm;
          });
      if (same != places.end()) {
        same->label.detail = std::string(detail) + ", " + same->label.detail;
        continue;
      }
      places.push_back(
          {{value_text(extreme.deviation_mm, extreme.u95_mm),
            detail,
            conformity_of(extreme.deviation_mm,
                          std::isfinite(extreme.u95_mm) ? extreme.u95_mm / kNormal95 : 0.0,
                          verdict.rule.limits),
            {}},
           {extreme.at_mm, extreme.normal}});
    }
  }
  std::vector<Eigen::Vector3f> normals;
  if (!part.named_features.empty()) normals = vertex_normals(part.mesh);
  // Of a feature with many characteristics the worst ones, or the labels of others have no room.
  constexpr std::size_t kMostOfFeature = 3;
  std::map<std::string, std::size_t> rows_of;
  for (const MeasuredCharacteristic& row : part.characteristics)
    rows_of[row.feature] += std::isfinite(row.value) ? 1U : 0U;
  std::map<std::string, std::size_t> labelled;
  for (const MeasuredCharacteristic& row : worst_first(part.characteristics)) {
    const auto found = std::find_if(part.named_features.begin(),
                                    part.named_features.end(),
                                    [&](const auto& one) { return one.name == row.feature; });
    if (found == part.named_features.end() || !std::isfinite(row.value)) continue;
    const char* const unit = row.unit == "degrees" ? "°" : " mm";
    PictureLabel label{fmt::format("{:.4f}{}", row.value, unit),
                       row.name,
                       row.limits ? std::optional(row.conformity) : std::nullopt,
                       {}};
    const std::size_t count = ++labelled[row.feature];
    if (count > kMostOfFeature) continue;
    if (count == kMostOfFeature && rows_of[row.feature] > kMostOfFeature)
      label.detail += fmt::format(", {} more", rows_of[row.feature] - kMostOfFeature);
    for (const PicturedPlace& place :
         report::feature_places(part.mesh, normals, found->shape, found->vertices))
      places.push_back({label, place});
  }
  return places;
}

/// The place of the thinnest wall.
std::vector<LabelledPlace> thinnest_place(const Inspection& part) {
  const ThicknessSummary& walls = part.walls->summary;
  if (!walls.min_at_mm.allFinite()) return {};
  const auto at = std::find(part.mesh.vertices_mm.begin(),
                            part.mesh.vertices_mm.end(),
                            Eigen::Vector3f(walls.min_at_mm.cast<float>()));
  if (at == part.mesh.vertices_mm.end()) return {};
  const auto normals = vertex_normals(part.mesh);
  const Eigen::Vector3f& normal =
      normals[static_cast<std::size_t>(at - part.mesh.vertices_mm.begin())];
  std::string text = fmt::format("{:.4f}", walls.min_mm);
  if (std::isfinite(walls.min_u_mm)) text += fmt::format(" ± {:.4f}", kNormal95 * walls.min_u_mm);
  return {{{text, "thinnest", std::nullopt, {}},
           {walls.min_at_mm, normal.cast<double>().normalized()}}};
}

/// A direction to the viewer.
struct PicturedFrom {
  double azimuth_deg = 0.0;
  double elevation_deg = 0.0;
};

/// Up to two further directions, from below or from above, that show the most places which no
/// picture so far labels.
std::vector<PicturedFrom> views_of_unseen(const RayScene& scene,
                                          RenderOptions options,
                                          const std::vector<LabelledPlace>& places,
                                          const std::vector<ReportPicture>& pictures) {
  std::set<std::string> labelled;
  for (const ReportPicture& picture : pictures) {
    for (const PictureLabel& label : picture.labels)
      labelled.insert(label.detail + label.text);
  }
  std::vector<PicturedPlace> points;
  std::vector<std::string> names;
  for (const LabelledPlace& place : places) {
    const std::string name = place.label.detail + place.label.text;
    if (labelled.count(name) > 0) continue;
    points.push_back(place.place);
    names.push_back(name);
  }
  constexpr std::array<double, 3> kElevations{-35.0, 70.0, -80.0};
  constexpr std::size_t kMost = 2;  // each takes 1.5 s of processor time
  std::vector<PicturedFrom> chosen;
  while (chosen.size() < kMost && !points.empty()) {
    PicturedFrom best;
    std::set<std::string> shown;
    for (const double elevation : kElevations) {
      for (const double azimuth : kAzimuths) {
        options.azimuth_rad = rad_from_deg(azimuth);
        options.elevation_rad = rad_from_deg(elevation);
        const auto positions = picture_positions(scene, options, points);
        std::set<std::string> seen;
        for (std::size_t i = 0; i < points.size(); ++i) {
          if (positions[i]) seen.insert(names[i]);
        }
        if (seen.size() <= shown.size()) continue;
        best = {azimuth, elevation};
        shown = std::move(seen);
      }
    }
    if (shown.empty()) break;  // deep in a hole
    chosen.push_back(best);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (shown.count(names[i]) > 0) continue;
      points[kept] = points[i];
      names[kept++] = names[i];
    }
    points.resize(kept);
    names.resize(kept);
  }
  return chosen;
}

/// Adds the labels of the places that a picture sees, each text once.
void add_labels(ReportPicture& picture,
                const RayScene& scene,
                const RenderOptions& options,
                const std::vector<LabelledPlace>& places) {
  std::vector<PicturedPlace> points;
  for (const LabelledPlace& place : places)
    points.push_back(place.place);
  const auto positions = picture_positions(scene, options, points);
  std::set<std::string> shown;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const PictureLabel& label = places[i].label;
    if (!positions[i] || (!label.detail.ends_with("out") && !label.detail.ends_with("undecided") &&
                          !shown.insert(label.detail + label.text).second))
      continue;
    picture.labels.push_back(label);
    picture.labels.back().at_px = *positions[i];
  }
}

}  // namespace

std::vector<ReportPicture> report_pictures(const Inspection& part,
                                           double scale_mm,
                                           const Run& run) {
  RenderOptions options;
  if (part.surface) options = deviation_picture(part.mesh, *part.surface, scale_mm);
  // More pixels and rays would not be seen, but waited for.
  options.width_px = kReportPictureWidth_px;
  options.height_px = kReportPictureHeight_px;
  options.samples_across = 2;
  options.legend = false;
  const RayScene scene(part.mesh, run);
  const std::vector<LabelledPlace> places = labelled_places(part);
  std::vector<ReportPicture> pictures;
  std::string what;     // the pictures show
  std::string meaning;  // of their colors and labels
  const auto show = [&](const std::string& quantity) {
    what = quantity + ", ";
    meaning =
        "; dark gray: no value; magenta: inside of the surface; labels: " + quantity + " ± U95, mm";
  };
  if (part.surface) show("deviation");
  const auto add = [&](double azimuth, double elevation) {
    options.azimuth_rad = rad_from_deg(azimuth);
    options.elevation_rad = rad_from_deg(elevation);
    ReportPicture picture;
    picture.caption = fmt::format(
        "{}seen from azimuth {:.0f}°, elevation {:.0f}°{}", what, azimuth, elevation, meaning);
    picture.picture = render_mesh(part.mesh, options, run);
    picture.azimuth_deg = azimuth;
    picture.elevation_deg = elevation;
    if (!options.values.empty()) {
      picture.scale = PictureScale{options.value_label,
                                   static_cast<double>(options.value_min),
                                   static_cast<double>(options.value_max),
                                   options.color_map,
                                   std::nullopt};
      if (options.value_limits.size() == 2)
        picture.scale->limits = ToleranceLimits{options.value_limits[0], options.value_limits[1]};
    }
    pictures.push_back(std::move(picture));
  };
  for (const double azimuth : kAzimuths) {
    add(azimuth, 20.0);
    add_labels(pictures.back(), scene, options, places);
    if (!part.surface && pictures.size() == 2) break;
  }
  for (const PicturedFrom& from : views_of_unseen(scene, options, places, pictures)) {
    add(from.azimuth_deg, from.elevation_deg);
    add_labels(pictures.back(), scene, options, places);
  }
  // The picture with the worst place stands first.
  if (!places.empty()) {
    const auto first = std::find_if(pictures.begin(), pictures.end(), [&](const auto& picture) {
      return !picture.labels.empty() && picture.labels.front().text == places.front().label.text;
    });
    if (first != pictures.end()) std::rotate(pictures.begin(), first, first + 1);
  }
  if (!part.walls) return pictures;
  const int width = options.width_px;
  const int height = options.height_px;
  options = thickness_picture(part.mesh, *part.walls, scale_mm);
  options.width_px = width;
  options.height_px = height;
  options.samples_across = 2;
  options.legend = false;
  show("thickness");
  const std::vector<LabelledPlace> thinnest = thinnest_place(part);
  const std::size_t first = pictures.size();
  const auto add_thickness = [&](double azimuth, double elevation) {
    add(azimuth, elevation);
    add_labels(pictures.back(), scene, options, thinnest);
    std::string& caption = pictures.back().caption;
    if (pictures.back().labels.empty()) caption.erase(caption.rfind("; labels: "));
  };
  for (const double azimuth : {35.0, 215.0})
    add_thickness(azimuth, 20.0);
  const std::vector<ReportPicture> of_walls(pictures.begin() + static_cast<std::ptrdiff_t>(first),
                                            pictures.end());
  for (const PicturedFrom& from : views_of_unseen(scene, options, thinnest, of_walls))
    add_thickness(from.azimuth_deg, from.elevation_deg);
  return pictures;
}

ReportLogo read_logo(const std::filesystem::path& path) {
  constexpr std::size_t kMost = 2U << 20U;
  const auto content = read_regular_file(path, kMost);
  const std::string_view begin(content.data(), content.size());
  ReportLogo logo;
  if (begin.starts_with("\x89PNG\r\n\x1A\n")) logo.media_type = "image/png";
  if (begin.starts_with("\xFF\xD8\xFF")) logo.media_type = "image/jpeg";
  if (logo.media_type.empty()) {
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: the logo of a report must be a PNG or JPEG picture", path.string()));
  }
  // A picture that is cut short would leave a hole in a report that is signed.
  static_cast<void>(ImageFile(path).read());
  logo.bytes.assign(content.begin(), content.end());
  return logo;
}

}  // namespace frangia

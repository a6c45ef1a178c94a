// Pictures of a report in which the features have their numbers.
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/inspect/render_mesh.h"
#include "frangia/report/internal/feature_places.h"
#include "frangia/report/report_pictures.h"

namespace frangia {
namespace {

using Position = std::optional<Eigen::Vector2d>;

/// Where a picture shows each of the features that have no label yet.
std::vector<Position> positions_of(const RayScene& scene,
                                   const RenderOptions& options,
                                   const std::vector<std::vector<PicturedPlace>>& places,
                                   const std::vector<bool>& labelled) {
  std::vector<PicturedPlace> all;
  std::vector<std::size_t> feature_of;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (labelled[i]) continue;
    all.insert(all.end(), places[i].begin(), places[i].end());
    feature_of.resize(all.size(), i);
  }
  const auto found = picture_positions(scene, options, all);
  std::vector<Position> positions(places.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    Position& position = positions[feature_of[k]];
    if (!position) position = found[k];
  }
  return positions;
}

void look_from(RenderOptions& options, const ReportPicture& from) {
  options.azimuth_rad = rad_from_deg(from.azimuth_deg);
  options.elevation_rad = rad_from_deg(from.elevation_deg);
}

/// Directions of pictures that are not drawn.
std::vector<ReportPicture> other_views() {
  std::vector<ReportPicture> views;
  for (const double elevation : {20.0, -35.0, 70.0}) {
    for (const double azimuth : {35.0, 125.0, 215.0, 305.0}) {
      views.emplace_back();
      views.back().azimuth_deg = azimuth;
      views.back().elevation_deg = elevation;
    }
  }
  return views;
}

}  // namespace

std::vector<ReportPicture> feature_pictures(const Mesh& mesh,
                                            const std::vector<Feature>& features,
                                            const std::vector<std::string>& names,
                                            const std::vector<ReportPicture>& drawn,
                                            const Run& run) {
  constexpr std::size_t kMostPictures = 3;
  constexpr std::size_t kMostLabels = 32;  // of a picture
  if (features.empty()) return {};
  RenderOptions options;
  options.width_px = kReportPictureWidth_px;
  options.height_px = kReportPictureHeight_px;
  options.samples_across = 2;
  options.legend = false;
  const RayScene scene(mesh, run);
  const auto normals = vertex_normals(mesh);
  std::vector<std::vector<PicturedPlace>> places;
  for (const Feature& feature : features)
    places.push_back(report::feature_places(mesh, normals, feature.fit.shape, feature.vertices));
  std::vector<bool> labelled(features.size(), false);
  std::vector<ReportPicture> pictures;
  const auto add = [&](const std::vector<ReportPicture>& views) {
    const ReportPicture* best = nullptr;
    std::vector<Position> shown;
    std::ptrdiff_t most = 0;
    for (const ReportPicture& from : views) {
      run.check();
      look_from(options, from);
      auto positions = positions_of(scene, options, places, labelled);
      const auto count = std::count_if(
          positions.begin(), positions.end(), [](const auto& one) { return one.has_value(); });
      if (count <= most) continue;
      most = count;
      best = &from;
      shown = std::move(positions);
    }
    if (best == nullptr) return false;
    ReportPicture picture = *best;
    picture.labels.clear();
    picture.caption = fmt::format(
        "seen from azimuth {:.0f}°, elevation {:.0f}°", picture.azimuth_deg, picture.elevation_deg);
    if (picture.picture.empty()) {
      look_from(options, picture);
      picture.picture = render_mesh(mesh, options, run);
    }
    for (std::size_t i = 0; i < features.size() && picture.labels.size() < kMostLabels; ++i) {
      if (!shown[i]) continue;
      labelled[i] = true;
      picture.labels.push_back(
          {fmt::format("{}: {}", i + 1, names[i]), "", std::nullopt, *shown[i]});
    }
    pictures.push_back(std::move(picture));
    return true;
  };
  while (pictures.size() < kMostPictures && add(drawn)) {
  }
  // One takes a second of processor time.
  if (pictures.size() < kMostPictures) add(other_views());
  return pictures;
}

}  // namespace frangia

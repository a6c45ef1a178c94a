#include "frangia/views/find_places.h"

#include <algorithm>
#include <limits>

#include "frangia/views/find_motions.h"
#include "frangia/views/match_features.h"

namespace frangia {
namespace {

constexpr double kAny = std::numeric_limits<double>::infinity();

/// Adds a place unless it is worth nothing or the same as one that is there.
void add_new(std::vector<GroupPlace>& places, const GroupPlace& place, const PlaceScale& scale) {
  const Eigen::Vector3d centre = place.to_from.inverse() * place.fit.centre_mm;
  const bool known = std::any_of(places.begin(), places.end(), [&](const GroupPlace& other) {
    return alike(place.to_from, other.to_from, centre, place.fit.arm_mm, scale.apart_mm());
  });
  if (!known && place.score(kAny) > 0.0) places.push_back(place);
}

}  // namespace

double GroupPlace::score(double usual_mm) const {
  constexpr double kAgainst = 3.0;  // a point seen through weighs as many that agree
  const double points =
      static_cast<double>(fit.agree) - kAgainst * static_cast<double>(fit.against);
  return fit.residual_mm > usual_mm ? points * usual_mm / fit.residual_mm : points;
}

void sort_places(std::vector<GroupPlace>& places, double usual_mm) {
  std::stable_sort(places.begin(), places.end(), [&](const GroupPlace& a, const GroupPlace& b) {
    return a.score(usual_mm) > b.score(usual_mm);
  });
}

std::vector<GroupPlace> refine_places(const ViewGroup& to,
                                      const ViewGroup& from,
                                      std::span<const Eigen::Isometry3d> starts,
                                      const GroupViews& views,
                                      const PlaceScale& scale) {
  std::vector<GroupPlace> places;
  for (const Eigen::Isometry3d& start : starts) {
    GroupPlace place;
    place.to_from = refine_fit(to, from, start, views, {scale.start_mm(), scale.gate_mm()});
    place.fit = compare_groups(to, from, place.to_from, views, scale.gate_mm());
    add_new(places, place, scale);
  }
  sort_places(places, kAny);
  return places;
}

std::vector<Eigen::Isometry3d> places_beside(const GroupPlace& place, const PlaceScale& scale) {
  std::vector<Eigen::Isometry3d> beside;
  for (Eigen::Index way = 0; way < 2; ++way) {
    for (const double spacings : {-6.0, -3.0, -1.5, 1.5, 3.0, 6.0}) {
      const Eigen::Matrix<double, 6, 1> step =
          spacings * scale.spacing_mm * place.fit.loosest.col(way);
      beside.push_back(place.fit.motion(step) * place.to_from);
    }
  }
  return beside;
}

std::vector<GroupPlace> find_places(const KnownGroup& to,
                                    const KnownGroup& from,
                                    const GroupViews& views,
                                    const PlaceScale& scale) {
  constexpr std::size_t kRefined = 8;
  const auto matches = match_features(from.features, to.features);
  std::vector<GroupPlace> rough;
  for (const Motion& motion : find_motions(
           from.group.points, to.group.points, matches, {.tolerance_mm = 1.5 * scale.spacing_mm})) {
    GroupPlace place{motion.to_from, {}};
    place.fit = compare_groups(to.group, from.group, place.to_from, views, scale.start_mm());
    add_new(rough, place, scale);
  }
  sort_places(rough, kAny);
  std::vector<Eigen::Isometry3d> starts;
  for (std::size_t i = 0; i < std::min(rough.size(), kRefined); ++i)
    starts.push_back(rough[i].to_from);
  return refine_places(to.group, from.group, starts, views, scale);
}

}  // namespace frangia

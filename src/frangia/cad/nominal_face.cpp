#include "frangia/cad/nominal_face.h"

#include <algorithm>
#include <map>

namespace frangia {

std::optional<NominalFace> nominal_face(const CadModel& model,
                                        const RayScene& scene,
                                        const MeasuredFeature& feature) {
  constexpr std::size_t kAsked = 400;
  constexpr double kLeastShare = 0.25;  // a round face is often stated as two halves
  const std::size_t stride = feature.points_mm.size() / kAsked + 1;
  std::map<std::uint32_t, std::size_t> points_of_face;
  std::size_t asked = 0;
  for (std::size_t i = 0; i < feature.points_mm.size(); i += stride) {
    ++asked;
    const auto near = scene.nearest(feature.points_mm[i]);
    if (!near) continue;
    const std::uint32_t face = model.face_of(near->triangle);
    const std::optional<Shape>& shape = model.faces()[face].shape;
    if (shape && shape->kind == feature.feature.fit.shape.kind) ++points_of_face[face];
  }
  const auto most = std::max_element(
      points_of_face.begin(), points_of_face.end(), [](const auto& a, const auto& b) {
        return a.second < b.second;
      });
  if (most == points_of_face.end() ||
      static_cast<double>(most->second) < kLeastShare * static_cast<double>(asked))
    return std::nullopt;
  return NominalFace{most->first + 1, *model.faces()[most->first].shape};
}

}  // namespace frangia

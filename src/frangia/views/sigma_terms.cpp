#include "frangia/views/sigma_terms.h"

#include <cmath>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/uncertainty/combined_sigma.h"

namespace frangia {

void add_part(Image<float>& sum, const Image<float>& part) {
  if (part.empty()) return;
  if (sum.empty()) {
    sum = part;
    return;
  }
  require(same_size(sum, part), "a part of the uncertainty and the view differ in size");
  parallel_rows(sum.height(), [&](int y) {
    for (int x = 0; x < sum.width(); ++x) {
      const float more = part(x, y);
      if (std::isnan(more)) continue;
      float& all = sum(x, y);
      all = combined_sigma(std::isnan(all) ? 0.0F : all, more);
    }
  });
}

Image<float> add_terms(View& view, std::size_t camera, std::span<const SigmaTerm> terms) {
  RangeGrid& range = view.range;
  Image<float> differing;
  bool added = false;
  for (const SigmaTerm& term : terms) {
    const Image<float> part = term.systematic_mm(view, camera);
    if (part.empty()) continue;
    require(same_size(part, range.depth_mm),
            "a part of the uncertainty and the view differ in size");
    add_part(range.systematic_mm, part);
    if (info_of(term.term).correlation == ErrorCorrelation::View) add_part(differing, part);
    added = true;
  }
  if (!added) return differing;
  range.differing_share = 0.0F;
  parallel_rows(range.depth_mm.height(), [&](int y) {
    for (int x = 0; x < range.depth_mm.width(); ++x) {
      float& all = range.systematic_mm(x, y);
      if (std::isnan(range.depth_mm(x, y))) {
        all = kMissing;
      } else if (std::isnan(all)) {
        all = 0.0F;
      }
    }
  });
  return differing;
}

}  // namespace frangia

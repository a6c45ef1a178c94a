#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "frangia/core/image.h"
#include "frangia/uncertainty/uncertainty_budget.h"
#include "frangia/views/view.h"

namespace frangia {

/// A systematic part of the uncertainty that is not stored with the points of a view.
struct SigmaTerm {
  UncertaintyTerm term{};  ///< its entry in the budget, which says what its errors have in common
  /// Standard uncertainty of each point of a view of the camera with this index, along its viewing
  /// ray, mm. NaN: no point, or nothing is known of it; an empty image: the term says nothing of
  /// this view.
  std::function<Image<float>(const View&, std::size_t camera)> systematic_mm;
};

/// Adds terms to the systematic parts of the points of a view, and returns the part of them whose
/// errors differ from view to view (`ErrorCorrelation::View`); an empty image where none does.
/// `differing_share` of the view becomes 0 when a term is added.
///
/// @units    mm
/// @missing  a point of which nothing is known gets 0, a pixel without a point NaN
/// @errors   Error(Input) when the image of a term has not the size of the view
/// @source   GUM (JCGM 100:2008), 5.1.2
Image<float> add_terms(View& view, std::size_t camera, std::span<const SigmaTerm> terms);

/// Adds the variance of another part to that of each pixel. A missing part counts as 0; a pixel
/// that both miss stays missing. An empty `sum` becomes `part`, an empty `part` adds nothing.
///
/// @errors   Error(Input) when the sizes differ
void add_part(Image<float>& sum, const Image<float>& part);

}  // namespace frangia

#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "frangia/align/align_datum.h"
#include "frangia/report/inspection_plan.h"

#include "inspect_alignment.h"
#include "inspect_arguments.h"
#include "inspect_reference.h"

namespace frangia {

/// An alignment to datums, and how far each is from its nominal place then.
struct DatumFit {
  Alignment alignment;
  std::vector<DatumResidual> residuals;
};

/// Aligns a mesh to the datums of a plan. A best fit brings it near, where the datums are looked
/// for on the mesh; their nominal places are the faces of a CAD reference that the plan names, or
/// the same features of the reference.
///
/// @errors   Error(Input) that names a datum which is not found; as align_best_fit and
///           align_to_datums
[[nodiscard]] DatumFit align_by_datums(const InspectArguments& arguments,
                                       InspectionPlan plan,
                                       const Mesh& mesh,
                                       const Reference& reference,
                                       const Run& run);

/// Adds `alignment_details.datums`.
void add_datums(nlohmann::ordered_json& json, const std::vector<DatumResidual>& residuals);

/// A line for each datum.
[[nodiscard]] std::string datum_text(const std::vector<DatumResidual>& residuals);

}  // namespace frangia

#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "frangia/core/run.h"
#include "frangia/registration/internal/optimize_bundle.h"
#include "frangia/registration/register_views.h"
#include "frangia/registration/registration_report.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// A registration in progress.
struct Registration {
  Bundle bundle;
  SurfelLists surfels;
  double reach_mm;
  ViewStore& views;
  std::span<const Station> stations;
  const RegisterOptions& options;
  const Run& run;

  [[nodiscard]] std::string name_of(std::size_t view) const {
    return stations[view].name.empty() ? std::to_string(view) : stations[view].name;
  }
  void optimize_again();  ///< from the given state on
  void leave_out(std::size_t view);
};

/// Leaves out views that fit no other one.
void leave_out_outliers(RegistrationReport& report, Registration& work);

/// Leaves out views of a moved part one by one, as long as the others then agree better.
void leave_out_moved(RegistrationReport& report, Registration& work);

}  // namespace frangia

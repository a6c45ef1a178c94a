#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>

#include "frangia/rig/rig.h"
#include "frangia/service/calibrate_axis.h"
#include "frangia/service/calibration_wizard.h"
#include "frangia/service/internal/state_json.h"

namespace frangia {

/// The geometry of a rig as a client draws it: mm, in the rig frame; poses are row-major 4 x 4.
[[nodiscard]] nlohmann::ordered_json json_of_rig(const Rig& rig);
[[nodiscard]] nlohmann::ordered_json json_of_devices(const std::vector<ProjectDevice>& devices);
[[nodiscard]] nlohmann::ordered_json json_of_search(const DeviceSearch& search);
[[nodiscard]] nlohmann::ordered_json json_of_axis(const FoundAxis& axis);
[[nodiscard]] nlohmann::ordered_json json_of_wizard(const WizardState& state);
/// The members that kept rigs have in common.
[[nodiscard]] nlohmann::ordered_json json_of_figures(const RigFigures& figures);
[[nodiscard]] nlohmann::ordered_json json_of_kept(const std::vector<KeptRig>& kept);
[[nodiscard]] nlohmann::ordered_json json_of_check(const ScanCheck& check);
[[nodiscard]] nlohmann::ordered_json json_of_display(const DisplayMeasurement& display);

/// An object that arrived from a page as the text of a TOML file of a format, so that the one
/// reader of such files checks it. Keys whose value is null are left out.
[[nodiscard]] std::string toml_text(const nlohmann::json& object, std::string_view format);

}  // namespace frangia

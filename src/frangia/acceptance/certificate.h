#pragma once

#include <string>
#include <vector>

#include "frangia/acceptance/acceptance_result.h"

namespace frangia {

/// The warning of a test whose scans no real camera captured.
inline constexpr const char* kSimulatedCamera =
    "the camera of the rig is simulated; the certificate says nothing about a real scanner";

/// What a certificate states beside the results.
struct CertificateFacts {
  std::string created;                ///< date and time
  std::string version;                ///< of the software
  std::string rig;                    ///< file or name
  std::string calibrated;             ///< date of the rig's calibration; may be empty
  std::vector<std::string> warnings;  ///< of the measurement
};

/// Returns the certificate of a test as one page of HTML without references to other files: every
/// error with its limit and its decision, every arrangement, the artifact, the conditions, the
/// method, and a checksum of each arrangement's frames.
[[nodiscard]] std::string certificate_html(const AcceptancePlan& plan,
                                           const std::vector<ArrangementResult>& arrangements,
                                           const AcceptanceResult& result,
                                           const CertificateFacts& facts);

}  // namespace frangia

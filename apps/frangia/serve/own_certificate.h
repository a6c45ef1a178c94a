#pragma once

#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

namespace frangia {

/// A certificate that this machine has made itself. No browser can verify it: people compare its
/// fingerprint.
struct OwnCertificate {
  std::string pem;          ///< the certificate, then its private key
  std::string fingerprint;  ///< SHA-256 as browsers show it: "0A:1B:..."
};

/// Reads the certificate of this machine. Where there is none, or it is over within a month, or
/// others may read its key, it makes another one and keeps it, mode 0600.
///
/// `file`: where it is kept; empty: nowhere
/// `addresses`: IP addresses that a new certificate names, beside the name of the machine
/// `now`: seconds since 1970
/// @errors   Error(File) when it cannot be kept; Error(Device) when no key can be made
[[nodiscard]] OwnCertificate own_certificate(const std::filesystem::path& file,
                                             const std::vector<std::string>& addresses,
                                             std::time_t now = std::time(nullptr));

}  // namespace frangia

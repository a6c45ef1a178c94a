#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "app_routes.h"

namespace frangia {

/// A second address of the app, in the networks of this machine, while the operator wants it: for a
/// tablet beside the scanner. Without encryption or with a certificate of the machine's own, with a
/// password that is made for it. All functions may be called from any thread but those of the
/// tablets.
class LanDoor {
 public:
  /// `certificate`: file that keeps the certificate of this machine, see own_certificate
  explicit LanDoor(std::filesystem::path certificate) : certificate_(std::move(certificate)) {}
  LanDoor(const LanDoor&) = delete;
  LanDoor& operator=(const LanDoor&) = delete;
  LanDoor(LanDoor&&) = delete;
  LanDoor& operator=(LanDoor&&) = delete;
  ~LanDoor();

  /// Offers the door to the pages of this machine. The references must outlive its last `close`.
  [[nodiscard]] LanAccess access(Service& service,
                                 SessionKeys& keys,
                                 std::function<void()> on_operator,
                                 std::function<void(const std::string&)> on_exception);
  /// Ends the connections of all tablets.
  void close();
  void announce_change() const;
  void announce_picture() const;

 private:
  struct Open;
  [[nodiscard]] std::string state() const;

  std::filesystem::path certificate_;
  mutable std::mutex mutex_;
  std::shared_ptr<Open> open_;  ///< null: closed
};

/// The IPv4 addresses of this machine in its networks, without its own 127.0.0.1.
[[nodiscard]] std::vector<std::string> network_addresses();

}  // namespace frangia

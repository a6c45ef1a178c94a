#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "support/emulated_port.h"

namespace frangia::testing {

/// A device with faults of its line: set one, also while the device works.
class MisbehavingDevice : public EmulatedDevice {
 public:
  using Clock = std::chrono::steady_clock;

  explicit MisbehavingDevice(std::unique_ptr<EmulatedDevice> inner) : inner_(std::move(inner)) {}

  bool silent = false;                         ///< works, but its answers are lost
  bool deaf = false;                           ///< nothing that is sent arrives; it does not answer
  bool endless_line = false;                   ///< sends bytes without a line end, without pause
  bool flood = false;                          ///< sends lines without pause
  std::chrono::milliseconds chatter_every{0};  ///< sends `chatter` so often; 0: never
  std::string chatter = "[MSG:report]\r\n";

  /// The device behind the faults.
  template <typename Device>
  [[nodiscard]] Device& inner() {
    return dynamic_cast<Device&>(*inner_);
  }

  std::string greet() override { return heard(inner_->greet()); }
  std::string receive(std::string_view bytes) override {
    return deaf ? std::string() : heard(inner_->receive(bytes));
  }
  std::string tick() override {
    std::string said = heard(inner_->tick());
    if (endless_line) said += std::string(512, 'x');
    if (flood) {
      for (int i = 0; i < 64; ++i)
        said += chatter;
    }
    if (chatter_every.count() > 0 && Clock::now() >= next_chatter_) {
      next_chatter_ = Clock::now() + chatter_every;
      said += chatter;
    }
    return said;
  }

 private:
  [[nodiscard]] std::string heard(std::string answer) const {
    return silent || deaf ? std::string() : std::move(answer);
  }

  std::unique_ptr<EmulatedDevice> inner_;
  Clock::time_point next_chatter_ = {};
};

}  // namespace frangia::testing

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "frangia/devices/internal/message_instrument.h"
#include "frangia/devices/switch_device.h"

namespace frangia {

/// A lamp or laser switched by an instrument: an output of a power supply, a relay.
class InstrumentSwitch final : public SwitchDevice {
 public:
  /// Switches off first.
  ///
  /// @errors   Error(Device) when the instrument does not answer or rejects a command in `off`
  InstrumentSwitch(MessageInstrument line,
                   std::vector<std::string> on,
                   std::vector<std::string> off,
                   const Deadline& deadline);
  InstrumentSwitch(const InstrumentSwitch&) = delete;
  InstrumentSwitch& operator=(const InstrumentSwitch&) = delete;
  InstrumentSwitch(InstrumentSwitch&&) = delete;
  InstrumentSwitch& operator=(InstrumentSwitch&&) = delete;
  ~InstrumentSwitch() override;

  [[nodiscard]] std::string name() const override { return "light at " + instrument_.name(); }
  [[nodiscard]] std::string test(const Deadline& deadline) override;
  void make_safe() noexcept override;
  [[nodiscard]] std::optional<SafeOff> safe_off() const override {
    return instrument_.safe_off(off_);
  }
  void set(bool on, const Deadline& deadline) override;
  [[nodiscard]] bool is_on() const override { return is_on_; }

 private:
  MessageInstrument instrument_;
  std::vector<std::string> on_;
  std::vector<std::string> off_;
  bool is_on_ = false;
};

}  // namespace frangia

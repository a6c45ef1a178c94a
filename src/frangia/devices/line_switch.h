#pragma once

#include <memory>
#include <string>
#include <vector>

#include "frangia/devices/line_instrument.h"
#include "frangia/devices/switch_device.h"

namespace frangia {

/// A lamp or laser behind an instrument on a line: a supply's output, a relay.
class LineSwitch final : public SwitchDevice {
 public:
  /// Switches off first.
  LineSwitch(LineInstrument line,
             std::vector<std::string> on,
             std::vector<std::string> off,
             const Deadline& deadline);
  LineSwitch(const LineSwitch&) = delete;
  LineSwitch& operator=(const LineSwitch&) = delete;
  LineSwitch(LineSwitch&&) = delete;
  LineSwitch& operator=(LineSwitch&&) = delete;
  ~LineSwitch() override;

  [[nodiscard]] std::string name() const override { return "light at " + line_.name(); }
  [[nodiscard]] std::string test(const Deadline& deadline) override;
  void make_safe() noexcept override;
  void set(bool on, const Deadline& deadline) override;
  [[nodiscard]] bool is_on() const override { return is_on_; }

 private:
  LineInstrument line_;
  std::vector<std::string> on_;
  std::vector<std::string> off_;
  bool is_on_ = false;
};

}  // namespace frangia

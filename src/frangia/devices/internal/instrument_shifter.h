#pragma once

#include <memory>
#include <string>

#include "frangia/devices/internal/actuator_protocol.h"
#include "frangia/devices/phase_shifter.h"

namespace frangia {

/// A piezo driven by an instrument with one value. Never sends a value outside the range of `info`.
/// Sends the commands in `start`, which switch the output on, before the first value.
class InstrumentShifter final : public PhaseShifter {
 public:
  /// @errors   Error(Device) when the instrument has an error query and does not answer it
  InstrumentShifter(std::unique_ptr<Transport> transport,
                    ActuatorProtocol protocol,
                    ShifterInfo info,
                    double settle_s,
                    const Deadline& deadline);
  InstrumentShifter(const InstrumentShifter&) = delete;
  InstrumentShifter& operator=(const InstrumentShifter&) = delete;
  InstrumentShifter(InstrumentShifter&&) = delete;
  InstrumentShifter& operator=(InstrumentShifter&&) = delete;
  ~InstrumentShifter() override;

  [[nodiscard]] std::string name() const override {
    return "phase shifter at " + instrument_.name();
  }
  [[nodiscard]] std::string test(const Deadline& deadline) override;
  void make_safe() noexcept override;
  [[nodiscard]] std::optional<SafeOff> safe_off() const override {
    return instrument_.safe_off(protocol_.stop);
  }
  [[nodiscard]] const ShifterInfo& info() const override { return info_; }
  void drive(double command, const Deadline& deadline) override;

 private:
  void start(const Deadline& deadline);
  void wait_until_settled(const Deadline& deadline);

  MessageInstrument instrument_;
  ActuatorProtocol protocol_;
  ShifterInfo info_;
  double settle_s_ = 0.0;  ///< after the instrument reports that it has settled
  bool started_ = false;
};

}  // namespace frangia

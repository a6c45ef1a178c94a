#pragma once

#include <memory>
#include <string>
#include <vector>

#include "frangia/devices/device.h"
#include "frangia/devices/internal/transport.h"
#include "frangia/devices/phase_shifter.h"

namespace frangia {

/// An instrument that takes commands as lines of text, each followed by an error query.
class MessageInstrument {
 public:
  struct Language {
    std::string error_query;        ///< sent after each command; empty: not used
    std::string no_error;           ///< beginning of the answer when there is no error
    std::string terminator = "\n";  ///< of each line
    std::string identify;           ///< "*IDN?"; empty: not supported
  };

  MessageInstrument(std::unique_ptr<Transport> transport, Language language);

  [[nodiscard]] const std::string& name() const { return transport_->name(); }
  /// @errors   Error(Device) when it does not answer or reports an error
  void send(const std::string& command, const Deadline& deadline);
  /// @errors   Error(Device) with the error that the instrument reports instead of an answer, or
  ///          when it does not answer
  [[nodiscard]] std::string ask(const std::string& question, const Deadline& deadline);
  [[nodiscard]] std::string identify(const Deadline& deadline);
  /// Discards errors from before, so that they are not reported after the next command.
  ///
  /// @errors   Error(Device) when it does not answer
  void clear_errors(const Deadline& deadline);
  /// Sends commands without error queries, in any state of the instrument. Returns within 1 s.
  void send_unchecked(const std::vector<std::string>& commands) noexcept;
  /// How another process sends `commands`.
  [[nodiscard]] SafeOff safe_off(const std::vector<std::string>& commands) const;

 private:
  void write(const std::string& line, const Deadline& deadline);
  /// The answer to the error query if it is an error; empty otherwise.
  [[nodiscard]] std::string query_error(const Deadline& deadline);
  [[noreturn]] void fail_with(const std::string& reported, const std::string& after) const;

  std::unique_ptr<Transport> transport_;
  Language language_;
  bool unfinished_ = false;  ///< only a part of the last line was sent
};

/// Commands of an instrument that sets a voltage or a piezo position. All are text from its manual,
/// so an instrument without a driver of its own needs no program. In `set`, {value} stands for the
/// number, with an optional format: "VOLT {value:.3f}".
struct ActuatorProtocol {
  MessageInstrument::Language language;
  std::vector<std::string> start;  ///< sent before the first value, and again after a stop
  std::string set;                 ///< sets the value
  std::string settled_query;  ///< repeated until the answer is `settled_answer`; empty: not used
  std::string settled_answer;
  std::vector<std::string> stop;  ///< sent at the end and after a fault
};

/// A function generator or power supply with SCPI; `set` sets its offset or another quantity.
///
/// @source   IEEE 488.2 (*OPC?), SCPI-99 (SYSTem:ERRor?, OUTPut)
[[nodiscard]] ActuatorProtocol scpi_protocol();

/// A controller of Physik Instrumente in closed loop.
///
/// @source   PI GCS 2.0 Commands Manual: SVO, MOV, ONT?, ERR?
[[nodiscard]] ActuatorProtocol gcs2_protocol(const std::string& axis = "1");

/// The command for a value.
///
/// @errors   Error(Input) when `set` has no {value} or an invalid format
[[nodiscard]] std::string fill_command(const std::string& set, double value);

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

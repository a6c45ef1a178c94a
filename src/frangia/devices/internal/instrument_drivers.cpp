#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "frangia/devices/device.h"
#include "frangia/devices/internal/message_instrument.h"
#include "frangia/devices/internal/open_transport.h"
#include "frangia/devices/internal/own_drivers.h"

namespace frangia {
namespace {

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

InstrumentSwitch::InstrumentSwitch(MessageInstrument line,
                                   std::vector<std::string> on,
                                   std::vector<std::string> off,
                                   const Deadline& deadline)
    : instrument_(std::move(line)), on_(std::move(on)), off_(std::move(off)) {
  instrument_.send_unchecked(off_);
  instrument_.clear_errors(deadline);
  set(false, deadline);
}

InstrumentSwitch::~InstrumentSwitch() {
  make_safe();
}

std::string InstrumentSwitch::test(const Deadline& deadline) {
  return instrument_.identify(deadline);
}

void InstrumentSwitch::make_safe() noexcept {
  instrument_.send_unchecked(off_);
  is_on_ = false;
}

void InstrumentSwitch::set(bool on, const Deadline& deadline) {
  is_on_ = true;  // assume on until off is acknowledged
  for (const std::string& command : on ? on_ : off_)
    instrument_.send(command, deadline);
  is_on_ = on;
}

/// Replaces the defaults of a protocol by the settings in rig.toml.
void read_language(DeviceSettings& settings, MessageInstrument::Language& language) {
  language.error_query = settings.text_or("error_query", language.error_query);
  language.no_error = settings.text_or("no_error", language.no_error);
  language.terminator = settings.text_or("end", language.terminator);
  language.identify = settings.text_or("identify", language.identify);
}

ActuatorProtocol read_protocol(DeviceSettings& settings, ActuatorProtocol protocol) {
  read_language(settings, protocol.language);
  protocol.start = settings.texts_or("start", protocol.start);
  protocol.set =
      protocol.set.empty() ? settings.text("set") : settings.text_or("set", protocol.set);
  protocol.settled_query = settings.text_or("settled_query", protocol.settled_query);
  protocol.settled_answer = settings.text_or("settled_answer", protocol.settled_answer);
  protocol.stop = settings.texts_or("stop", protocol.stop);
  return protocol;
}

ShifterInfo read_info(DeviceSettings& settings, const std::string& unit) {
  ShifterInfo info;
  info.unit = settings.text_or("unit", unit);
  info.min_command = settings.number_or("min_command", 0.0);
  info.max_command = settings.number("max_command");
  if (!(info.min_command < info.max_command)) {
    settings.fail("min_command", "must be below max_command");
  }
  info.curve = read_phase_curve(settings, info.min_command, info.max_command);
  info.fringes_per_degree = settings.number_or("fringes_per_degree", 0.0, 0.0, 1e4);
  return info;
}

using MakeProtocol = std::function<ActuatorProtocol(DeviceSettings&)>;

Driver shifter_driver(std::string name, std::string what, std::string unit, MakeProtocol make) {
  Driver driver;
  driver.name = std::move(name);
  driver.kind = DeviceKind::PhaseShifter;
  driver.description = std::move(what);
  driver.open = [unit = std::move(unit), make = std::move(make)](
                    DeviceSettings& settings,
                    const Rig& /*rig*/,
                    const Deadline& deadline) -> std::unique_ptr<Device> {
    const ActuatorProtocol protocol = read_protocol(settings, make(settings));
    const ShifterInfo info = read_info(settings, unit);
    const double settle_s = settings.number_or("settle_s", 0.0, 0.0, 60.0);
    return std::make_unique<InstrumentShifter>(
        open_configured_transport(settings, deadline), protocol, info, settle_s, deadline);
  };
  return driver;
}

Driver light_driver(const std::string& name, DeviceKind kind) {
  const bool scpi = name == "scpi";
  Driver driver;
  driver.name = name;
  driver.kind = kind;
  driver.description = scpi ? "lamp or laser on an output with SCPI"
                            : "lamp or laser on any instrument, by the commands in its manual";
  driver.open = [scpi](DeviceSettings& settings,
                       const Rig& /*rig*/,
                       const Deadline& deadline) -> std::unique_ptr<Device> {
    const ActuatorProtocol usual = scpi ? scpi_protocol() : ActuatorProtocol{};
    MessageInstrument::Language language = usual.language;
    read_language(settings, language);
    const auto on = settings.texts_or("on", scpi ? usual.start : std::vector<std::string>{});
    const auto off = settings.texts_or("off", usual.stop);
    if (on.empty()) settings.fail("on", "is missing; it lists the commands that switch on");
    if (off.empty()) settings.fail("off", "is missing; it lists the commands that switch off");
    return std::make_unique<InstrumentSwitch>(
        MessageInstrument(open_configured_transport(settings, deadline), language),
        on,
        off,
        deadline);
  };
  return driver;
}

}  // namespace

std::vector<Driver> instrument_drivers() {
  std::vector<Driver> drivers;
  drivers.push_back(shifter_driver("scpi",
                                   "piezo on a function generator or power supply with SCPI",
                                   "V",
                                   [](DeviceSettings& /*settings*/) { return scpi_protocol(); }));
  drivers.push_back(shifter_driver(
      "gcs2", "piezo stage of Physik Instrumente (GCS 2)", "um", [](DeviceSettings& settings) {
        return gcs2_protocol(settings.text_or("axis", "1"));
      }));
  drivers.push_back(
      shifter_driver("commands",
                     "piezo on any instrument, by the commands in its manual",
                     "V",
                     [](DeviceSettings& /*settings*/) { return ActuatorProtocol{}; }));
  for (const char* name : {"scpi", "commands"}) {
    drivers.push_back(light_driver(name, DeviceKind::Light));
    drivers.push_back(light_driver(name, DeviceKind::LaserSheet));
  }
  return drivers;
}

}  // namespace frangia

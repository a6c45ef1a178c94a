#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "frangia/devices/internal/motion_controller.h"
#include "frangia/devices/internal/transport.h"

namespace frangia {
namespace {

const char* meaning_of_alarm(int code) {
  switch (code) {
    case 1:
      return "a limit switch was hit";
    case 2:
      return "the target is beyond the travel of the axis, set in $130 to $133";
    case 3:
      return "it was reset while it moved";
    case 6:
    case 7:
    case 8:
    case 9:
      return "homing failed; check the home switch";
    default:
      return "see the list of alarms of GRBL";
  }
}

const char* meaning_of_error(int code) {
  switch (code) {
    case 5:
      return "homing is not enabled; set $22=1, or home = \"here\"";
    case 8:
      return "that is only possible at standstill";
    case 9:
      return "it is locked after an alarm; home the table again";
    case 15:
      return "the target is beyond its travel";
    case 20:
      return "the command is unknown";
    default:
      return "see the list of errors of GRBL";
  }
}

/// The number at the end of "ALARM:3" or "error:9".
int number_after_colon(const std::string& line) {
  return std::atoi(line.c_str() + line.find(':') + 1);  // NOLINT(cert-err34-c) 0 is not a code
}

/// "ALARM:1, a limit switch was hit" for the line "ALARM:1" of GRBL.
///
/// @source   github.com/gnea/grbl/wiki, Grbl v1.1 Interface
std::string explained_alarm(const std::string& line) {
  return fmt::format("{}, {}", printable(line), meaning_of_alarm(number_after_colon(line)));
}

/// "(error:20): the command is unknown" for the line "error:20" of GRBL.
std::string explained_error(const std::string& line) {
  return fmt::format("({}): {}", printable(line), meaning_of_error(number_after_colon(line)));
}

constexpr const char* kReset = "\x18";
constexpr const char* kHold = "!";
constexpr double kQuiet_s = 0.05;  ///< a board that sends nothing for so long has answered
constexpr double kDrain_s = 0.3;   ///< for the answers after a reset, also when they do not end
constexpr double kWrite_s = 0.2;
constexpr double kRestart_s = 0.1;  ///< from a soft reset until GRBL accepts commands

/// Numbers of the settings of an axis: each is that of X plus the index of the axis.
enum AxisSetting : int { kSteps = 100, kMaxRate = 110, kAcceleration = 120, kTravel = 130 };

/// The index of an axis among the settings; A is the first rotary axis of boards with more than
/// three.
///
/// @source   github.com/gnea/grbl/wiki, Grbl v1.1 Configuration; github.com/grblHAL/core/wiki
int index_of_axis(char axis) {
  constexpr std::string_view kAxes = "XYZA";
  return static_cast<int>(kAxes.find(axis));
}

/// "Grbl 1.1h ['$' for help]"; grblHAL says "GrblHAL 1.1f ['$' or '$HELP' for help]".
bool is_greeting(const std::string& line) {
  return line.starts_with("Grbl ") || line.starts_with("GrblHAL ");
}

class Grbl final : public MotionController {
 public:
  Grbl(std::unique_ptr<Transport> transport, const MotionControllerSettings& settings)
      : transport_(std::move(transport)), settings_(settings) {}

  [[nodiscard]] const std::string& name() const override { return transport_->name(); }

  void connect(const Deadline& deadline) override {
    // Opening the port resets most boards. Wait, since a byte now may reach the boot loader.
    if (!wait_for_greeting(deadline.at_most(settings_.boot_s))) {
      transport_->write(kReset, deadline);
      if (!wait_for_greeting(deadline)) {
        fail_device(name(),
                    last_line_.empty()
                        ? fmt::format("no greeting from GRBL within {:.3g} s; check the port",
                                      deadline.timeout_s)
                        : fmt::format("does not run GRBL: it sent '{}'; check port and baud",
                                      printable(last_line_)));
      }
    }
  }

  [[nodiscard]] std::string identify(const Deadline& deadline) override {
    transport_->write("?", deadline);
    for (;;) {
      const std::string answer = read_line(*transport_, deadline);
      if (!answer.empty() && answer.front() == '<') return "GRBL, " + printable(answer);
    }
  }

  void use(const MotionControllerSettings& settings) override { settings_ = settings; }

  [[nodiscard]] std::string difference(const Deadline& deadline) override {
    if (!(settings_.steps_per_unit > 0.0)) return {};
    values_ = answer_to("$$", deadline);
    if (!steps_differ()) return {};
    return fmt::format("its ${} is {:.6g}; a scan sets it to the {:.6g} steps of the rig",
                       kSteps + axis_index(),
                       setting(kSteps),
                       settings_.steps_per_unit);
  }
  [[nodiscard]] std::string take_change() override { return std::exchange(change_, {}); }

  // GRBL holds its motor according to $1; there is no command for it.
  // The settings of the board are written here and not in `connect`: connecting and identifying
  // only ask.
  void enable_motor(bool on, const Deadline& deadline) override {
    static_cast<void>(identify(deadline));
    if (!on) return;
    values_ = answer_to("$$", deadline);
    if (settings_.steps_per_unit > 0.0) set_steps(deadline);
  }

  void home(const Deadline& deadline) override {
    command("$H", deadline);
    set_zero(deadline);
  }

  void set_zero(const Deadline& deadline) override {
    command("$X", deadline);
    alarm_.clear();
    command(fmt::format("G92 {}0", settings_.axis), deadline);
  }

  void move_to(double units, double units_per_s, const Deadline& deadline) override {
    try {
      command(fmt::format("G21 G90 G1 {}{:.4f} F{:.3f}", settings_.axis, units, 60.0 * units_per_s),
              deadline);
      // GRBL answers "ok" to a move when it is queued, but to a dwell when the queue is empty.
      command("G4 P0.01", deadline);
    } catch (const Error&) {
      stop();
      throw;
    }
  }

  void command(const std::string& line, const Deadline& deadline) override {
    static_cast<void>(answer_to(line, deadline));
  }

  void stop() noexcept override {
    record_stop();
    if (stopped_) return;
    try {
      const Deadline soon = Deadline::in(1.0);
      transport_->write(kHold, soon);
      // A reset switches off spindle and coolant, to which lasers are connected.
      transport_->write(kReset, soon);
      stopped_ = true;
      static_cast<void>(wait_for_greeting(soon));
      transport_->write(off_commands("\n"), Deadline::in(kWrite_s));
      discard_answers(off_command_count());
    } catch (const Error&) {  // NOLINT(bugprone-empty-catch) the line is broken
    }
  }

  [[nodiscard]] SafeOff safe_off() const override {
    return {.line = name(),
            .file = transport_->file(),
            .end_command = transport_->framed(std::string("\n") + kHold + kReset),
            .pause_s = kRestart_s,
            .off = off_commands("\n")};
  }

  /// By $110 and $120 (X): the highest rate in units per minute, the acceleration in units per s².
  [[nodiscard]] double move_time_s(double distance, double units_per_s) const override {
    const double rate = setting(kMaxRate) / 60.0;
    const double speed = rate > 0.0 ? std::min(rate, units_per_s) : units_per_s;
    const double acceleration = setting(kAcceleration);
    return distance / speed + (acceleration > 0.0 ? speed / acceleration : 0.0);
  }

  /// GRBL searches the switch over 1.5 times $130, the travel, at the rate $25, then approaches it
  /// again from $27 units at the rate $24.
  [[nodiscard]] double home_time_s() const override {
    const double seek = value_of(25) / 60.0;
    const double feed = value_of(24) / 60.0;
    if (!(seek > 0.0 && feed > 0.0)) return 0.0;
    constexpr double kSearch = 1.5;
    constexpr double kPasses = 4.0;  // two approaches and two retreats
    return kSearch * setting(kTravel) / seek + kPasses * value_of(27) / feed;
  }

 private:
  bool wait_for_greeting(const Deadline& deadline) {
    while (auto line = transport_->try_read('\n', deadline)) {
      if (is_greeting(*line)) return true;
      note(*line);
      if (line->find_first_not_of("\r ") != std::string::npos) last_line_ = *line;
    }
    return false;
  }

  /// Discards the answers to `count` commands and to abandoned ones before them.
  void discard_answers(std::size_t count) {
    const Deadline drained = Deadline::in(kDrain_s);
    for (;;) {
      const auto line = transport_->try_read('\n', count > 0 ? drained : drained.at_most(kQuiet_s));
      if (!line) return;
      note(*line);
      const bool is_answer = line->rfind("ok", 0) == 0 || line->rfind("error:", 0) == 0;
      if (is_answer && count > 0) --count;
    }
  }
  /// Remembers an alarm, which explains why later commands are refused.
  void note(const std::string& line) {
    if (line.rfind("ALARM:", 0) == 0) alarm_ = line.substr(0, line.find_last_not_of("\r ") + 1);
  }
  /// The settings before "ok".
  std::map<int, double> answer_to(const std::string& line, const Deadline& deadline) {
    stopped_ = false;
    transport_->write(line + "\n", deadline);
    std::map<int, double> values;
    for (;;) {
      const std::string answer = read_line(*transport_, deadline);
      if (answer == "ok") return values;
      if (answer.rfind("error:", 0) == 0) {
        fail_device(name(), refusal(line, answer));
      }
      if (answer.rfind("ALARM:", 0) == 0) {
        note(answer);
        fail_device(
            name(),
            fmt::format("{}; its angle is lost, home the table again", explained_alarm(answer)));
      }
      if (is_greeting(answer)) {
        fail_device(name(), "the board restarted; its angle is lost, home the table again");
      }
      if (answer.rfind('$', 0) == 0 && answer.find('=') != std::string::npos) {
        values[std::atoi(answer.c_str() + 1)] =  // NOLINT(cert-err34-c) 0 without a number
            std::atof(answer.c_str() + answer.find('=') + 1);  // NOLINT(cert-err34-c)
      } else if (!answer.empty() && answer.front() != '[' && answer.front() != '<') {
        fail_device(name(),
                    fmt::format("answered '{}' to {}; check that it runs GRBL at this baud rate",
                                printable(answer),
                                line));
      }
    }
  }
  [[nodiscard]] std::string refusal(const std::string& line, const std::string& answer) const {
    std::string text = fmt::format("refused {} {}", line, explained_error(answer));
    const bool locked = answer == "error:9";
    return locked && !alarm_.empty() ? explained_alarm(alarm_) + "; " + text : text;
  }

  [[nodiscard]] int axis_index() const { return index_of_axis(settings_.axis); }
  /// A value that the board reports by its number; 0 when it does not.
  [[nodiscard]] double value_of(int key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? 0.0 : found->second;
  }
  /// A setting of the axis that is driven; 0 when the board does not report it.
  [[nodiscard]] double setting(AxisSetting which) const { return value_of(which + axis_index()); }

  [[nodiscard]] bool steps_differ() const {
    const int key = kSteps + axis_index();
    if (values_.count(key) == 0) {
      fail_device(
          name(),
          fmt::format("does not report its ${0}, the steps of axis {1}; choose an axis that "
                      "the board has, or leave out steps_per_degree",
                      key,
                      settings_.axis));
    }
    constexpr double kResolution = 1e-3;  // GRBL reports three digits
    return std::abs(value_of(key) - settings_.steps_per_unit) >= kResolution;
  }

  void set_steps(const Deadline& deadline) {
    if (!steps_differ()) return;
    const int key = kSteps + axis_index();
    // Write only when different: the EEPROM wears, and the board loses bytes that arrive while it
    // writes, so wait for "ok" before sending more.
    command(fmt::format("${}={:.3f}", key, settings_.steps_per_unit), deadline);
    change_ = fmt::format(
        "its ${} was {:.6g} and is now {:.6g}, the steps of the rig; the board keeps it",
        key,
        value_of(key),
        settings_.steps_per_unit);
    values_[key] = settings_.steps_per_unit;
  }

  std::unique_ptr<Transport> transport_;
  MotionControllerSettings settings_;
  std::map<int, double> values_;  ///< settings of the board by their numbers
  std::string change_;            ///< of them, not told yet
  std::string last_line_;
  std::string alarm_;     ///< the last one, until it is cleared
  bool stopped_ = false;  ///< nothing was sent since the last stop
};

}  // namespace

std::unique_ptr<MotionController> make_grbl(std::unique_ptr<Transport> transport,
                                            const MotionControllerSettings& settings) {
  return std::make_unique<Grbl>(std::move(transport), settings);
}

}  // namespace frangia

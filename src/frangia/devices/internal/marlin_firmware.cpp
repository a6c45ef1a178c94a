#include <algorithm>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "frangia/devices/internal/motion_controller.h"

namespace frangia {
namespace {

constexpr int kMostResends = 5;

bool begins(const std::string& line, const char* with) {
  return line.rfind(with, 0) == 0;
}

class Marlin final : public MotionController {
 public:
  Marlin(std::unique_ptr<Transport> transport, const MotionControllerSettings& settings)
      : transport_(std::move(transport)), settings_(settings) {}

  void use(const MotionControllerSettings& settings) override { settings_ = settings; }

  [[nodiscard]] const std::string& name() const override { return transport_->name(); }

  void connect(const Deadline& deadline) override {
    const Deadline booted = deadline.at_most(settings_.boot_s);
    while (auto line = transport_->try_read('\n', booted)) {
      if (begins(*line, "start")) break;
    }
    // The messages of the boot end before the answer to this.
    transport_->discard_input();
    transport_->write("M110 N0\n", deadline);
    for (std::string answer; !begins(answer, "ok");)
      answer = read_line(*transport_, deadline);
    number_ = 0;
    command("G21", deadline);
    command("G90", deadline);
  }

  [[nodiscard]] std::string identify(const Deadline& deadline) override {
    command("M400", deadline);
    return "Marlin, ready";
  }

  void enable_motor(bool on, const Deadline& deadline) override {
    if (on) command("M503", deadline);  // reports the settings
    command(fmt::format("{} {}", on ? "M17" : "M18", settings_.axis), deadline);
  }

  void home(const Deadline& deadline) override {
    command(fmt::format("G28 {}", settings_.axis), deadline);
    set_zero(deadline);
  }

  void set_zero(const Deadline& deadline) override {
    command(fmt::format("G92 {}0", settings_.axis), deadline);
  }

  void move_to(double units, double units_per_s, const Deadline& deadline) override {
    try {
      command(fmt::format("G1 {}{:.4f} F{:.3f}", settings_.axis, units, 60.0 * units_per_s),
              deadline);
      command("M400", deadline);  // answered when all moves have ended
    } catch (const Error&) {
      stop();
      throw;
    }
  }

  void command(const std::string& line, const Deadline& deadline) override {
    const std::string numbered = fmt::format("N{} {}", ++number_, line);
    unsigned sum = 0;
    for (const char c : numbered) {
      sum ^= static_cast<unsigned char>(c);
    }
    const std::string message = fmt::format("{}*{}\n", numbered, sum);
    stopped_ = false;
    for (int sent = 0; sent <= kMostResends; ++sent) {
      transport_->write(message, deadline);
      if (was_accepted(line, deadline)) return;
    }
    fail_device(name(),
                fmt::format("requested '{1}' again {0} times; check the cable and the baud rate",
                            kMostResends + 1,
                            line));
  }

  void stop() noexcept override {
    record_stop();
    if (stopped_) return;
    try {
      // The line feed ends a command of which only a part was sent.
      transport_->write("\n" + quick_stop(), Deadline::in(1.0));
      stopped_ = true;
    } catch (const Error&) {  // NOLINT(bugprone-empty-catch) the line is broken
    }
  }

  [[nodiscard]] SafeOff safe_off() const override {
    // After a broken line, Marlin discards what it has received within this time.
    constexpr double kPause_s = 0.1;
    return {.line = name(),
            .file = transport_->file(),
            .end_command = transport_->framed("\n"),
            .pause_s = kPause_s,
            .off = quick_stop()};
  }

  /// By the highest feed rate of the axis, if the board reports it.
  [[nodiscard]] double move_time_s(double distance, double units_per_s) const override {
    return distance / (max_rate_ > 0.0 ? std::min(max_rate_, units_per_s) : units_per_s);
  }

 private:
  /// Quick stop, fan output and spindle off, and the outputs that devices use.
  [[nodiscard]] std::string quick_stop() const { return "M410\nM107\nM5\n" + off_commands("\n"); }

  /// Reads the highest rate of the axis, in units per s, from a line such as
  /// "echo:  M203 X500.00 Y500.00".
  void read_max_rate(const std::string& line) {
    const std::size_t found = line.find("M203 ");
    if (found == std::string::npos) return;
    const std::size_t at = line.find(fmt::format(" {}", settings_.axis), found);
    if (at != std::string::npos)
      max_rate_ = std::atof(line.c_str() + at + 2);  // NOLINT(cert-err34-c)
  }

  /// False when the board requests the line again.
  bool was_accepted(const std::string& line, const Deadline& deadline) {
    bool again = false;
    std::string trouble;
    for (;;) {
      const std::string answer = read_line(*transport_, deadline);
      if (begins(answer, "ok")) {
        if (!again && !trouble.empty()) {
          fail_device(name(), fmt::format("refused {}: {}", line, printable(trouble)));
        }
        return !again;
      }
      if (begins(answer, "Resend:") || begins(answer, "rs ")) again = true;
      if (begins(answer, "start")) {
        fail_device(name(), "the board restarted; its angle is lost, home the table again");
      }
      if (answer.find("halted") != std::string::npos || begins(answer, "!!")) {
        fail_device(name(),
                    fmt::format("halted ('{}'); switch it off and on, then home the table again",
                                printable(trouble.empty() ? answer : trouble)));
      }
      // The first one names the cause.
      if (begins(answer, "Error:") && trouble.empty()) trouble = answer.substr(6);
      read_max_rate(answer);
      // "echo:busy: processing" and reports: the board is alive and the answer follows.
    }
  }

  std::unique_ptr<Transport> transport_;
  MotionControllerSettings settings_;
  double max_rate_ = 0.0;  ///< in units per s; 0 when the board does not report it
  int number_ = 0;
  bool stopped_ = false;  ///< nothing was sent since the last stop
};

}  // namespace

std::unique_ptr<MotionController> make_marlin(std::unique_ptr<Transport> transport,
                                              const MotionControllerSettings& settings) {
  return std::make_unique<Marlin>(std::move(transport), settings);
}

}  // namespace frangia

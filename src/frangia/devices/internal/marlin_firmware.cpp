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

  [[nodiscard]] const std::string& name() const override { return transport_->name(); }

  void connect(const Deadline& deadline) override {
    const Deadline booted = deadline.at_most(settings_.boot_s);
    while (auto line = transport_->try_read('\n', booted)) {
      if (begins(*line, "start")) break;
    }
    // The messages of the boot end before the answer to this.
    transport_->discard_input();
    transport_->write("M110 N0\n", deadline);
    while (!begins(read_line(*transport_, deadline), "ok")) {
    }
    number_ = 0;
    command("G21", deadline);
    command("G90", deadline);
  }

  [[nodiscard]] std::string identify(const Deadline& deadline) override {
    command("M400", deadline);
    return "Marlin, ready";
  }

  void enable_motor(bool on, const Deadline& deadline) override {
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
    try {
      const Deadline soon = Deadline::in(1.0);
      transport_->write("M410\nM107\nM5\n", soon);  // quick stop, fan output and spindle off
    } catch (const Error&) {  // NOLINT(bugprone-empty-catch) the line is broken
    }
  }

 private:
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
                                printable(answer)));
      }
      if (begins(answer, "Error:")) trouble = answer.substr(6);
      // "echo:busy: processing" and reports: the board is alive and the answer follows.
    }
  }

  std::unique_ptr<Transport> transport_;
  MotionControllerSettings settings_;
  int number_ = 0;
};

}  // namespace

std::unique_ptr<MotionController> make_marlin(std::unique_ptr<Transport> transport,
                                              const MotionControllerSettings& settings) {
  return std::make_unique<Marlin>(std::move(transport), settings);
}

}  // namespace frangia

#pragma once

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "support/emulated_port.h"

namespace frangia::testing {

/// GRBL 1.1 with one axis, from its published interface: moves queue and take their time, a dwell
/// is answered at standstill, realtime bytes act at once, a reset in motion loses the position, the
/// receiver is deaf while settings are written.
class EmulatedGrbl : public EmulatedDevice {
 public:
  using Clock = std::chrono::steady_clock;

  // Faults, and what a test wants to know.
  bool silent = false;
  bool reset_in_next_move = false;  ///< a brown-out
  bool limit_in_next_move = false;  ///< a limit switch is hit
  bool garbage = false;             ///< another baud rate
  bool starts_locked = false;       ///< $22=1: locked until homed
  std::string version = "Grbl 1.1h ['$' for help]";
  char axis = 'X';             ///< that the motor is on
  double speed_factor = 50.0;  ///< moves are faster than commanded by this factor
  double travel = 1000.0;      ///< soft limits at ± this
  std::map<int, double> settings = {{20, 1}, {22, 1}, {100, 250}};
  std::vector<double> targets;  ///< of all moves, machine coordinates
  std::vector<std::string> commands;
  bool spindle = false;
  bool coolant = false;
  bool alarm = false;
  int settings_written = 0;

  std::string greet() override {
    alarm = starts_locked;
    return silent ? "" : garbage ? kGarbage : greeting();
  }

  std::string receive(std::string_view bytes) override {
    std::string said;
    for (const char c : bytes) {
      if (silent || Clock::now() < deaf_until_) continue;
      said += garbage ? kGarbage : receive(c);
    }
    return said;
  }

  std::string tick() override {
    std::string said;
    while (!queue_.empty() && Clock::now() >= queue_.front().ends && !held_) {
      position_ = queue_.front().target;
      said += queue_.front().answer;
      queue_.pop_front();
      if (!queue_.empty()) queue_.front().ends = Clock::now() + queue_.front().lasts;
    }
    if (limit_in_next_move && moving()) {
      limit_in_next_move = false;
      alarm = true;
      queue_.clear();
      said += "ALARM:1\r\n[MSG:Reset to continue]\r\n";
    }
    if (reset_in_next_move && moving()) {
      reset_in_next_move = false;
      said += reset();
    }
    return said;
  }

  [[nodiscard]] bool moving() const { return !queue_.empty(); }
  [[nodiscard]] double position() const { return position_; }

 private:
  struct Block {
    double target = 0.0;
    Clock::duration lasts = {};
    std::string answer;
    Clock::time_point ends = {};
  };

  inline static const std::string kGarbage = "\xf3\x80\x9c\n";

  [[nodiscard]] std::string greeting() const { return "\r\n" + version + "\r\n"; }

  std::string receive(char c) {
    switch (c) {
      case '?':
        return status();
      case '!':
        held_ = true;
        return {};
      case '~':
        held_ = false;
        return {};
      case '\x18':
        return reset();
      case '\r':
        return {};
      case '\n':
        return answer(std::exchange(line_, {}));
      default:
        line_ += c;
        return {};
    }
  }
  std::string status() const {
    const char* state = alarm ? "Alarm" : held_ ? "Hold:0" : moving() ? "Run" : "Idle";
    return std::string("<") + state + "|MPos:" + std::to_string(position_) +
           ",0.000,0.000|FS:0,0>\r\n";
  }
  std::string reset() {
    const bool lost = moving();
    queue_.clear();
    line_.clear();
    held_ = spindle = coolant = false;
    offset_ = 0.0;
    alarm = alarm || lost;
    return (lost ? "ALARM:3\r\n" : "") + greeting() +
           (alarm ? "[MSG:'$H'|'$X' to unlock]\r\n" : "");
  }
  std::string answer(const std::string& line) {
    commands.push_back(line);
    if (line.empty()) return "ok\r\n";
    if (line == "$X") {
      alarm = false;
      return "[MSG:Caution: Unlocked]\r\nok\r\n";
    }
    if (line == "$H") {
      if (settings[22] == 0) return "error:5\r\n";
      alarm = false;
      position_ = 0.0;
      return "ok\r\n";
    }
    if (line == "$$") return all_settings();
    if (line.front() == '$') return write_setting(line);
    if (alarm) return "error:9\r\n";
    return gcode(line);
  }
  std::string all_settings() const {
    std::string text;
    for (const auto& [key, value] : settings) {
      text += "$" + std::to_string(key) + "=" + std::to_string(value) + "\r\n";
    }
    return text + "ok\r\n";
  }
  std::string write_setting(const std::string& line) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) return "error:3\r\n";
    settings[std::stoi(line.substr(1))] = std::stod(line.substr(equals + 1));
    ++settings_written;
    // The answer comes when the memory is written; what is sent before that is lost.
    deaf_until_ = Clock::now() + std::chrono::milliseconds(20);
    enqueue({last_target(), std::chrono::milliseconds(20), "ok\r\n"});
    return {};
  }
  std::string gcode(const std::string& line) {
    if (line == "M3" || line.rfind("M3 ", 0) == 0) spindle = true;
    if (line == "M5") spindle = false;
    if (line == "M8") coolant = true;
    if (line == "M9") coolant = false;
    if (line.rfind("G92", 0) == 0) offset_ = position_;
    if (line.rfind("G4", 0) == 0) {
      enqueue({last_target(), std::chrono::milliseconds(1), "ok\r\n"});
      return {};
    }
    if (line.find("G1") == std::string::npos) return "ok\r\n";
    const double target = number_after(line, axis) + offset_;
    if (settings[20] != 0 && std::abs(target) > travel) {
      alarm = true;
      return "ALARM:2\r\n[MSG:Reset to continue]\r\n";
    }
    const double travel_s = std::abs(target - last_target()) / (number_after(line, 'F') / 60.0);
    targets.push_back(target);
    enqueue({target,
             std::chrono::duration_cast<Clock::duration>(
                 std::chrono::duration<double>(travel_s / speed_factor + 0.004))});
    return "ok\r\n";
  }
  static double number_after(const std::string& line, char letter) {
    const std::size_t at = line.find(letter);
    return at == std::string::npos ? 0.0 : std::strtod(line.c_str() + at + 1, nullptr);
  }
  [[nodiscard]] double last_target() const {
    return queue_.empty() ? position_ : queue_.back().target;
  }
  void enqueue(Block block) {
    if (queue_.empty()) block.ends = Clock::now() + block.lasts;
    queue_.push_back(std::move(block));
  }

  std::deque<Block> queue_;
  std::string line_;
  double position_ = 0.0;
  double offset_ = 0.0;
  bool held_ = false;
  Clock::time_point deaf_until_ = {};
};

}  // namespace frangia::testing

#pragma once

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "support/emulated_port.h"

namespace frangia::testing {

inline double number_after(const std::string& line, char letter) {
  const std::size_t at = line.find(letter);
  return at == std::string::npos ? 0.0 : std::strtod(line.c_str() + at + 1, nullptr);
}

/// Marlin: numbered lines with checksums, "busy" while it moves, Resend for what came broken.
class EmulatedMarlin : public EmulatedLineDevice {
 public:
  int lines_to_break = 0;  ///< number of the next lines that arrive damaged
  bool kill_in_next_move = false;
  double position = 0.0;
  double max_rate = 500.0;
  bool fan = false;
  bool pin = false;
  std::vector<std::string> commands;

  std::string greet() override { return "start\necho:Marlin 2.0.9\necho: Last Updated\n"; }

  std::string answer(const std::string& line) override {
    if (line.rfind("M110", 0) == 0) {
      expected_ = 1;
      return "ok\n";
    }
    if (line.empty()) return {};
    const std::size_t star = line.rfind('*');
    if (line.front() != 'N' || star == std::string::npos) {
      switch_output(line);
      commands.push_back(line);
      return "ok\n";
    }
    unsigned sum = 0;
    for (const char c : line.substr(0, star)) {
      sum ^= static_cast<unsigned char>(c);
    }
    const bool broken = lines_to_break > 0 && lines_to_break-- > 0;
    if (broken || sum != std::stoul(line.substr(star + 1)) ||
        std::stoi(line.substr(1)) != expected_) {
      return "Error:checksum mismatch, Last Line: " + std::to_string(expected_ - 1) +
             "\nResend: " + std::to_string(expected_) + "\nok\n";
    }
    ++expected_;
    return execute(line.substr(line.find(' ') + 1, star - line.find(' ') - 1));
  }

 private:
  /// The fan output and pin 4.
  void switch_output(const std::string& command) {
    if (command.rfind("M106", 0) == 0) fan = true;
    if (command == "M107") fan = false;
    if (command.rfind("M42 P4 ", 0) == 0) pin = command != "M42 P4 S0";
  }
  std::string execute(const std::string& command) {
    commands.push_back(command);
    switch_output(command);
    if (command == "M503") return "echo:  M203 X" + std::to_string(max_rate) + " Y500.00\nok\n";
    if (command.rfind("G1 ", 0) == 0) position = number_after(command, 'X');
    if (command == "M400") {
      if (std::exchange(kill_in_next_move, false)) {
        return "Error:Printer halted. kill() called!\n";
      }
      return "echo:busy: processing\necho:busy: processing\nok\n";
    }
    if (command.rfind("G28", 0) == 0) position = 0.0;
    return command.rfind("M999", 0) == 0 ? "Error:no such thing\nok\n" : "ok P15 B3\n";
  }
  int expected_ = 1;
};

/// The Ciclop's board with Horus 0.2.
class EmulatedHorus : public EmulatedLineDevice {
 public:
  std::string version = "Horus 0.2 ['$' for help]";
  double position = 0.0;
  std::array<bool, 2> lasers = {true, true};
  bool motor = false;

  std::string greet() override { return "\r\n" + version + "\r\n"; }
  std::string receive(std::string_view bytes) override {
    if (bytes.find('\x18') != std::string_view::npos) {
      lasers[0] = lasers[1] = motor = false;
      return greet();
    }
    return EmulatedLineDevice::receive(bytes);
  }
  std::string answer(const std::string& line) override {
    if (line.rfind("G1X", 0) == 0) position = number_after(line, 'X');
    if (line.rfind("M70T", 0) == 0) lasers.at(static_cast<std::size_t>(line[4] - '1')) = false;
    if (line.rfind("M71T", 0) == 0) lasers.at(static_cast<std::size_t>(line[4] - '1')) = true;
    if (line == "M17") motor = true;
    return "ok\r\n";
  }
};

/// A function generator: offset within ± 5 V, an error queue, *OPC? once the output stands.
class EmulatedScpi : public EmulatedLineDevice {
 public:
  double volts = 0.0;
  bool output = false;
  bool silent = false;
  bool never_settles = false;
  std::vector<double> set;

  std::string answer(const std::string& line) override {
    if (silent || line.empty()) return {};
    if (line == "*IDN?") return "Frangia,Emulated generator,0,1\n";
    if (line == "*OPC?") return never_settles ? "0\n" : "1\n";
    if (line == "SYST:ERR?") return std::exchange(error_, "+0,\"No error\"") + "\n";
    if (line == "OUTP ON" || line == "OUTP OFF") {
      output = line == "OUTP ON";
    } else if (line.rfind("VOLT:OFFS ", 0) == 0) {
      const double value = std::stod(line.substr(10));
      if (std::abs(value) > 5.0) {
        error_ = "-222,\"Data out of range\"";
      } else {
        volts = value;
        set.push_back(value);
      }
    } else if (line != "*CLS") {
      error_ = "-113,\"Undefined header\"";
    }
    return {};
  }

 private:
  std::string error_ = "+0,\"No error\"";
};

/// A PI controller of one axis: servo, range 0 to 100 µm, on target after a while.
class EmulatedGcs2 : public EmulatedLineDevice {
 public:
  double target = 0.0;
  bool servo = false;
  std::vector<double> moves;
  int polls_until_on_target = 3;

  std::string answer(const std::string& line) override {
    if (line == "ERR?") return std::to_string(std::exchange(error_, 0)) + "\n";
    if (line == "ONT? 1") return ++polls_ < polls_until_on_target ? "1=0\n" : "1=1\n";
    if (line == "POS? 1") return "1=" + std::to_string(target) + "\n";
    if (line.rfind("SVO 1 ", 0) == 0) {
      servo = line.back() == '1';
    } else if (line.rfind("MOV 1 ", 0) == 0) {
      const double to = std::stod(line.substr(6));
      if (!servo) {
        error_ = 5;
      } else if (to < 0.0 || to > 100.0) {
        error_ = 7;
      } else {
        target = to;
        moves.push_back(to);
        polls_ = 0;
      }
    } else if (line.rfind("STP", 0) == 0) {
      error_ = 10;
    } else {
      error_ = 2;
    }
    return {};
  }

 private:
  int error_ = 0;
  int polls_ = 0;
};

/// A Prologix adapter with one instrument at an address: it sends only when commanded to.
class EmulatedPrologix : public EmulatedDevice {
 public:
  EmulatedPrologix(std::unique_ptr<EmulatedDevice> instrument, int address)
      : instrument_(std::move(instrument)), address_(address) {}

  [[nodiscard]] EmulatedDevice& instrument() { return *instrument_; }

  std::string receive(std::string_view bytes) override {
    std::string said;
    for (const char c : bytes) {
      if (escaped_) {
        line_ += c;
        escaped_ = false;
      } else if (c == '\x1b') {
        escaped_ = true;
      } else if (c == '\n') {
        said += execute(std::exchange(line_, {}));
      } else {
        line_ += c;
      }
    }
    return said;
  }

 private:
  std::string execute(const std::string& line) {
    if (line == "++ver") return "Prologix GPIB-ETHERNET Controller version 01.06.06.00\r\n";
    if (line.rfind("++addr ", 0) == 0) selected_address_ = std::stoi(line.substr(7));
    if (line == "++read eoi" && selected_address_ == address_) return std::exchange(waiting_, {});
    if (line.rfind("++", 0) == 0 || selected_address_ != address_) return {};
    waiting_ += instrument_->receive(line + "\n");
    return {};
  }

  std::unique_ptr<EmulatedDevice> instrument_;
  int address_ = 0;
  int selected_address_ = 0;
  bool escaped_ = false;
  std::string line_;
  std::string waiting_;
};

}  // namespace frangia::testing

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "frangia/devices/internal/transport.h"
#include "frangia/devices/safe_off.h"

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

}  // namespace frangia

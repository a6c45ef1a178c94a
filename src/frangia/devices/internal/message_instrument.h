#pragma once

#include <memory>
#include <string>
#include <vector>

#include "frangia/devices/internal/transport.h"

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
  [[nodiscard]] std::string ask(const std::string& question, const Deadline& deadline);
  [[nodiscard]] std::string identify(const Deadline& deadline);
  /// Sends commands without error queries, in any state of the instrument.
  void send_unchecked(const std::vector<std::string>& commands) noexcept;
  void discard_input() { transport_->discard_input(); }

 private:
  std::unique_ptr<Transport> transport_;
  Language language_;
};

}  // namespace frangia

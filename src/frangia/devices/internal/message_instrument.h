#pragma once

#include <memory>
#include <string>
#include <vector>

#include "frangia/devices/internal/transport.h"

namespace frangia {

/// Commands to an instrument on a line, each followed by the question whether it went well.
class MessageInstrument {
 public:
  struct Language {
    std::string error_query;        ///< asked after each command; empty: never
    std::string no_error;           ///< how an answer begins that tells of no error
    std::string terminator = "\n";  ///< of each line
    std::string identify;           ///< "*IDN?"; empty: it cannot tell
  };

  MessageInstrument(std::unique_ptr<Transport> transport, Language language);

  [[nodiscard]] const std::string& name() const { return transport_->name(); }
  /// errors   Error(Device) when it is silent, or says that something is wrong
  void send(const std::string& command, const Deadline& deadline);
  [[nodiscard]] std::string ask(const std::string& question, const Deadline& deadline);
  [[nodiscard]] std::string identify(const Deadline& deadline);
  /// Sends them without a question, whatever state the instrument is in.
  void send_unchecked(const std::vector<std::string>& commands) noexcept;
  void discard_input() { transport_->discard_input(); }

 private:
  std::unique_ptr<Transport> transport_;
  Language language_;
};

}  // namespace frangia

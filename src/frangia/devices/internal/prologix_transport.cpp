#include "frangia/devices/internal/prologix_transport.h"

#include <utility>

#include <fmt/format.h>

namespace frangia {
namespace {

class PrologixTransport final : public Transport {
 public:
  PrologixTransport(std::unique_ptr<Transport> adapter, int gpib_address)
      : adapter_(std::move(adapter)),
        name_(fmt::format("{} GPIB {}", adapter_->name(), gpib_address)) {}

  [[nodiscard]] const std::string& name() const override { return name_; }

  /// Each line is one message; the adapter adds the terminator and EOI.
  void write(std::string_view bytes, const Deadline& deadline) override {
    adapter_->write(framed(bytes), deadline);
    asked_ = false;
  }

  [[nodiscard]] int file() const override { return adapter_->file(); }
  [[nodiscard]] std::string framed(std::string_view bytes) const override {
    while (!bytes.empty() && (bytes.back() == '\n' || bytes.back() == '\r')) {
      bytes.remove_suffix(1);
    }
    std::string message;
    for (const char c : bytes) {
      // The adapter itself would interpret these.
      if (c == '\n' || c == '\r' || c == '+' || c == '\x1b') message += '\x1b';
      message += c;
    }
    return message + "\n";
  }
  /// After an escape byte, the first line feed is data and the second ends the command.
  [[nodiscard]] std::string end_of_command(std::string_view /*terminator*/) const override {
    return "\n\n";
  }

  [[nodiscard]] std::optional<std::string> try_read(char end, const Deadline& deadline) override {
    if (!std::exchange(asked_, true)) adapter_->write("++read eoi\n", deadline);
    std::optional<std::string> text = adapter_->try_read(end, deadline);
    if (text) asked_ = false;
    return text;
  }

  void discard_input() override {
    adapter_->discard_input();
    asked_ = false;
  }

 private:
  std::unique_ptr<Transport> adapter_;
  std::string name_;
  bool asked_ = false;  ///< the instrument is addressed to talk
};

}  // namespace

std::unique_ptr<Transport> open_prologix(std::unique_ptr<Transport> adapter,
                                         int gpib_address,
                                         const Deadline& deadline) {
  if (gpib_address < 0 || gpib_address > 30) {
    throw Error(ErrorKind::Input,
                fmt::format("gpib_address is {}; it must lie between 0 and 30", gpib_address));
  }
  adapter->write("++ver\n", deadline);
  const std::string version = read_line(*adapter, deadline);
  if (version.find("Prologix") == std::string::npos && version.find("GPIB") == std::string::npos) {
    fail_device(adapter->name(),
                fmt::format("is not a Prologix adapter: it answered '{}'", printable(version)));
  }
  // Do not save to EEPROM; no automatic read after write; EOI ends messages; append CR LF.
  for (const char* command : {"++savecfg 0", "++mode 1", "++auto 0", "++eoi 1", "++eos 0"}) {
    adapter->write(fmt::format("{}\n", command), deadline);
  }
  adapter->write(fmt::format("++addr {}\n", gpib_address), deadline);
  return std::make_unique<PrologixTransport>(std::move(adapter), gpib_address);
}

}  // namespace frangia

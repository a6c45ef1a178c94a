#include "frangia/devices/internal/open_transport.h"

#include <gtest/gtest.h>

#include "support/emulated_boards.h"
#include "support/error_of.h"
#include "support/pseudo_terminal_test.h"
#include "support/soon.h"
#include "support/wait_until.h"

namespace frangia {
namespace {

using testing::EmulatedPort;
using testing::EmulatedScpi;
using testing::error_of;
using testing::soon;
using testing::unread_bytes;
using testing::wait_until;

class OpenTransport : public testing::PseudoTerminalTest {};

TEST_F(OpenTransport, NamesAMissingPort) {
  EXPECT_EQ(error_of([] {
              static_cast<void>(open_serial({"/dev/ttyNONE9"}));
            }).find("/dev/ttyNONE9: cannot be opened"),
            0U);
}

TEST_F(OpenTransport, LocksAPortForOneProgram) {
  EmulatedPort port(std::make_unique<EmulatedScpi>());
  const auto first = open_serial({port.path()});
  EXPECT_NE(error_of([&] { static_cast<void>(open_serial({port.path()})); }).find("in use"),
            std::string::npos);
}

TEST_F(OpenTransport, NamesAWrongTcpPort) {
  int closed = 0;
  {
    const EmulatedPort port(std::make_unique<EmulatedScpi>(), EmulatedPort::Kind::Tcp);
    closed = port.tcp_port();
  }
  const std::string sentence =
      error_of([&] { static_cast<void>(open_tcp("127.0.0.1", closed, soon())); });
  EXPECT_EQ(sentence.find("127.0.0.1:" + std::to_string(closed) + ": no connection"), 0U);
}

TEST_F(OpenTransport, ReadsWholeLinesInOrderOverSerialAndTcp) {
  for (const auto kind : {EmulatedPort::Kind::Terminal, EmulatedPort::Kind::Tcp}) {
    EmulatedPort port(std::make_unique<EmulatedScpi>(), kind);
    const Deadline deadline = soon();
    const auto line = kind == EmulatedPort::Kind::Tcp
                          ? open_tcp("127.0.0.1", port.tcp_port(), deadline)
                          : open_serial({port.path()});
    line->write("*IDN?\n*OPC?\n", deadline);
    EXPECT_EQ(read_line(*line, deadline), "Frangia,Emulated generator,0,1");
    EXPECT_EQ(read_line(*line, deadline), "1");
    EXPECT_FALSE(line->try_read('\n', Deadline::in(0.02)).has_value());
  }
}

TEST_F(OpenTransport, DiscardsAbandonedAnswers) {
  EmulatedPort port(std::make_unique<EmulatedScpi>());
  const auto line = open_serial({port.path()});
  line->write("*IDN?\n", soon());
  const std::string answer = "Frangia,Emulated generator,0,1\n";
  EXPECT_TRUE(wait_until([&] { return unread_bytes(line->file()) == answer.size(); }));
  line->discard_input();
  line->write("*OPC?\n", soon());
  EXPECT_EQ(read_line(*line, soon()), "1");
}

TEST_F(OpenTransport, ReportsAnUnpluggedDeviceAtOnce) {
  for (const auto kind : {EmulatedPort::Kind::Terminal, EmulatedPort::Kind::Tcp}) {
    EmulatedPort port(std::make_unique<EmulatedScpi>(), kind);
    const auto line = kind == EmulatedPort::Kind::Tcp
                          ? open_tcp("127.0.0.1", port.tcp_port(), soon())
                          : open_serial({port.path()});
    line->write("*OPC?\n", soon());
    static_cast<void>(read_line(*line, soon()));
    port.unplug();
    EXPECT_NE(error_of([&] {
                static_cast<void>(read_line(*line, soon()));
              }).find("check that it is plugged in"),
              std::string::npos);
  }
}

TEST_F(OpenTransport, EscapesUnprintableBytes) {
  EXPECT_EQ(printable("ok\r\xff"), "ok\\x0d\\xff");
}

}  // namespace
}  // namespace frangia

#pragma once

#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

namespace frangia::testing {

/// Skips its tests where the machine has no pseudo-terminals, as in a sandbox without /dev/pts.
class PseudoTerminalTest : public ::testing::Test {
 protected:
  void SetUp() override {
    int first = -1;
    int second = -1;
    if (::openpty(&first, &second, nullptr, nullptr, nullptr) != 0)
      GTEST_SKIP() << "no pseudo-terminal can be opened; mount /dev/pts to run this test";
    ::close(first);
    ::close(second);
  }
};

}  // namespace frangia::testing

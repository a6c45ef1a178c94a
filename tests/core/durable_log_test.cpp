#include "frangia/core/durable_log.h"

#include <csignal>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "frangia/core/atomic_file.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using testing::text_of;

TEST(DurableLog, ReadsBackAppendedLines) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "log.txt";
  DurableLog(path).append("one");
  DurableLog log(path);
  EXPECT_EQ(log.text(), "one\n");
  log.append("two");
  EXPECT_EQ(text_of(path), "one\ntwo\n");
}

TEST(DurableLog, RemovesAnIncompleteLastLine) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "log.txt";
  std::ofstream(path) << "one\ntw";
  DurableLog log(path);
  EXPECT_EQ(log.text(), "one\n");
  log.append("three");
  EXPECT_EQ(text_of(path), "one\nthree\n");
}

TEST(DurableLog, ReportsAFullDiskInOneSentence) {
  const testing::TemporaryFolder folder;
  DurableLog log(folder.path() / "log.txt");
  std::signal(SIGXFSZ, SIG_IGN);
  ::rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const ::rlimit full{2, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &full);
  const std::string sentence = testing::error_of([&] { log.append("more"); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_NE(sentence.find("log.txt: cannot be written"), std::string::npos) << sentence;
}

TEST(AtomicFileSynced, WritesAllBytesUnderItsName) {
  const testing::TemporaryFolder folder;
  AtomicFile file(folder.path() / "a.txt", Durability::Synced);
  file.stream() << "whole";
  file.commit();
  EXPECT_EQ(text_of(folder.path() / "a.txt"), "whole");
}

}  // namespace
}  // namespace frangia

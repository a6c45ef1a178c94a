#include "frangia/core/durable_log.h"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/internal/parse_log.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using testing::text_of;

/// The texts of the lines; that of a damaged one is "(damaged)".
std::vector<std::string> texts_of(const std::vector<LogLine>& lines) {
  std::vector<std::string> texts;
  for (const LogLine& line : lines)
    texts.push_back(line.damaged ? "(damaged)" : line.text);
  return texts;
}

using Texts = std::vector<std::string>;

TEST(DurableLog, ReadsBackAppendedLines) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "log.txt";
  DurableLog(path).append("one");
  DurableLog log(path);
  EXPECT_EQ(texts_of(log.lines()), Texts{"one"});
  log.append("two");
  // The checksums are those of Python's zlib.crc32(b"one").
  EXPECT_EQ(text_of(path), "one crc=7a6c86f1\ntwo crc=11ca8a66\n");
}

TEST(DurableLog, RemovesAnIncompleteLastLine) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "log.txt";
  std::ofstream(path) << "one crc=7a6c86f1\ntwo crc=11ca8a";
  DurableLog log(path);
  EXPECT_EQ(texts_of(log.lines()), Texts{"one"});
  log.append("two");
  EXPECT_EQ(text_of(path), "one crc=7a6c86f1\ntwo crc=11ca8a66\n");
}

TEST(DurableLog, CompletesALastLineThatLacksOnlyItsEnd) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "log.txt";
  for (const auto* end : {"", "\v"}) {
    std::ofstream(path) << "one crc=7a6c86f1" << end;
    DurableLog log(path);
    EXPECT_EQ(texts_of(log.lines()), Texts{"one"});
    log.append("two");
    EXPECT_EQ(text_of(path), "one crc=7a6c86f1\ntwo crc=11ca8a66\n");
  }
}

TEST(ParseLog, TrustsNoLineInWhichABitIsWrongAndAllOthers) {
  const Texts lines = {"frame views/000/fringe-0.png 1c291ca3 184211 attempts=1 scale=1",
                       "set views/000/fringe 0 good scale=0.952",
                       "exposures 2.5 10",
                       "JJJ ***"};  // one wrong bit makes a line end of these letters
  std::string text;
  for (const std::string& line : lines)
    text += with_checksum(line) + "\n";
  for (std::size_t i = 0; i < 8 * text.size(); ++i) {
    std::string damaged = text;
    damaged[i / 8] = static_cast<char>(damaged[i / 8] ^ (1 << (i % 8)));
    const ParsedLog log = parse_log(damaged);
    std::size_t trusted = 0;
    for (const LogLine& line : log.lines) {
      if (line.damaged) continue;
      ++trusted;
      ASSERT_NE(std::find(lines.begin(), lines.end(), line.text), lines.end()) << "bit " << i;
    }
    // A wrong line end damages the lines on both sides of it.
    ASSERT_GE(trusted, lines.size() - 2) << "bit " << i;
  }
}

TEST(ParseLog, NamesDamagedLinesInTheirPlaceAndKeepsTheOthers) {
  const ParsedLog log =
      parse_log("one crc=7a6c86f1\n" + std::string(20, '\0') + "\ngarbage\ntwo crc=11ca8a66\n");
  EXPECT_EQ(texts_of(log.lines), (Texts{"one", "(damaged)", "(damaged)", "two"}));
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

#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "support/run_program.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia::testing {

inline std::string word_of(const std::filesystem::path& path) {
  return "'" + path.string() + "'";
}

/// A folder with the scans `a` and `b`, and `broken`, which is none.
class BatchFixture : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;  // NOLINT(*-owning-memory) deleted below
    for (const char* name : {"a", "b"}) {
      const auto scan = small_scan(scans() / name, "plate", "digital", 1, {.samples_per_px = 1}, 4);
      static_cast<void>(scan);
    }
    std::filesystem::create_directories(scans() / "broken");
    std::ofstream(scans() / "broken" / "scan.toml") << "format = \"frangia-scan\"\nversion = 2\n";
  }
  static void TearDownTestSuite() { delete folder_; }  // NOLINT(*-owning-memory)

  [[nodiscard]] static std::filesystem::path scans() { return folder_->path() / "scans"; }
  [[nodiscard]] static std::filesystem::path out(const char* name) {
    return folder_->path() / name;
  }
  [[nodiscard]] static Answer batch(const std::filesystem::path& plan,
                                    const std::filesystem::path& to,
                                    const char* more = "") {
    return run_program("--json batch " + word_of(plan) + " -o " + word_of(to) + " " + more);
  }

 private:
  static inline TemporaryFolder* folder_ = nullptr;
};

}  // namespace frangia::testing

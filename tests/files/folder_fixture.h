#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include <gtest/gtest.h>
#include <unistd.h>

namespace frangia::testing {

/// A test with its own temporary folder.
class FolderFixture : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::filesystem::path at(std::string_view name) const { return folder_ / name; }
  [[nodiscard]] bool folder_is_empty() const { return std::filesystem::is_empty(folder_); }

  [[nodiscard]] std::filesystem::path put(std::string_view name, std::string_view bytes) const {
    std::ofstream(at(name), std::ios::binary).write(bytes.data(), std::ssize(bytes));
    return at(name);
  }
  [[nodiscard]] std::string bytes_in(std::string_view name) const {
    std::ifstream stream(at(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

 private:
  std::filesystem::path folder_ = std::filesystem::path(::testing::TempDir()) /
                                  (std::string("frangia-") + std::to_string(::getpid()) + "-" +
                                   ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

}  // namespace frangia::testing

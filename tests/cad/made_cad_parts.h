#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace frangia::testing {

/// A folder with the CAD files that OpenCASCADE's own writers make, see make_cad_parts.cpp.
class MadeCadParts : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    const std::string command =
        std::string(FRANGIA_MAKE_CAD_PARTS) + " " + folder_->path().string() + " > /dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0);
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::filesystem::path at(const std::string& name) { return folder_->path() / name; }

  static std::filesystem::path written(const std::string& name, const std::string& text) {
    std::ofstream(at(name), std::ios::binary) << text;
    return at(name);
  }

 private:
  static inline std::unique_ptr<TemporaryFolder> folder_;
};

}  // namespace frangia::testing

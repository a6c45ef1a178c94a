// The frame of a study: a program that takes a part and a number of seeds, and prints rows of JSON.
#pragma once

#include <charconv>
#include <cstdlib>
#include <exception>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/error.h"

namespace frangia {

/// The arguments of a study.
struct StudyArguments {
  std::string part;
  int seeds = 0;
  bool verbose = false;  ///< -v: also prints the result of each seed to standard error
};

/// @errors   Error(Input) unless the arguments are `PART SEEDS [-v]`
inline StudyArguments study_arguments(const std::vector<std::string_view>& arguments) {
  StudyArguments study;
  if (arguments.size() == 2 || (arguments.size() == 3 && arguments[2] == "-v")) {
    study.part = arguments[0];
    std::from_chars(arguments[1].data(), arguments[1].data() + arguments[1].size(), study.seeds);
    study.verbose = arguments.size() == 3;
  }
  if (study.seeds < 1) throw Error(ErrorKind::Input, "usage: PART SEEDS [-v]");
  return study;
}

/// The `main` of a study, whose rows are JSON objects.
inline int study_main(int argc,
                      char** argv,
                      const std::function<std::vector<std::string>(const StudyArguments&)>& rows) {
  try {
    fmt::print("[{}]\n", fmt::join(rows(study_arguments({argv + 1, argv + argc})), ",\n "));
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", argv[0], error.what());
    return EXIT_FAILURE;
  }
}

}  // namespace frangia

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
  int first_seed = 1;
  int seeds = 0;
  bool verbose = false;  ///< -v: also prints the result of each seed to standard error
  std::string only;      ///< measures the cases alone whose names contain it; empty: all
};

/// @errors   Error(Input) unless the arguments are `PART SEEDS [-v] [CASE]`, with a number of seeds
/// or
///           FIRST-LAST
inline StudyArguments study_arguments(const std::vector<std::string_view>& arguments) {
  StudyArguments study;
  if (arguments.size() >= 2) {
    study.part = arguments[0];
    const std::string_view seeds = arguments[1];
    const char* const end = seeds.data() + seeds.size();
    const char* const rest = std::from_chars(seeds.data(), end, study.seeds).ptr;
    if (rest != end && *rest == '-') {
      study.first_seed = study.seeds;
      std::from_chars(rest + 1, end, study.seeds);
      study.seeds -= study.first_seed - 1;
    }
    study.verbose = arguments.size() > 2 && arguments[2] == "-v";
    const std::size_t last = study.verbose ? 3 : 2;
    if (arguments.size() > last) study.only = arguments[last];
  }
  if (study.seeds < 1) throw Error(ErrorKind::Input, "usage: PART SEEDS [-v] [CASE]");
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

#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace frangia {

/// A cause that `explain_frames` knows, for people.
struct CauseRow {
  std::string cause;                ///< its word in JSON
  std::string model;                ///< what the frames show
  std::string consequence;          ///< what is done
  std::vector<std::size_t> counts;  ///< hypotheses with each number of steps, 0 for none
};

/// Causes whose frames are the same for any phases, so that frames alone do not tell them apart.
struct AlikeCauses {
  int steps = 0;                    ///< number of equal steps of the set
  std::vector<std::string> causes;  ///< words; one word alone for different frames of one cause
  std::size_t classes = 0;          ///< classes of hypotheses with just these causes
};

/// The numbers of equal steps for which the table is computed.
[[nodiscard]] std::vector<int> tabulated_steps();

/// All causes with the number of their hypotheses, from `frame_hypotheses`.
[[nodiscard]] std::vector<CauseRow> hypothesis_table();

/// The classes with more than one hypothesis, for each number of steps, by `predict_alike`.
[[nodiscard]] std::vector<AlikeCauses> alike_causes();

}  // namespace frangia

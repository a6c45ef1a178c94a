#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "frangia/dataset/scan_folder.h"
#include "frangia/decode/decode_view.h"
#include "frangia/decode/write_stages.h"
#include "frangia/range/range_grid.h"

#include "terminal.h"

namespace frangia {

/// One decoded view and its files.
struct ViewResult {
  std::size_t view = 0;            ///< counted from 0
  DecodedView decoded{};           ///< phase and what led to it
  RangeGrid range{};               ///< empty without geometry, or where nothing fits
  std::string reason{};            ///< why it is not trustworthy; empty otherwise
  std::string empty{};             ///< why no pixel has a phase; empty if one has
  std::vector<StageFile> files{};  ///< in the view's folder
};

/// Prints the causes that explain frames as the table of docs/phase.md.
void print_hypotheses(Terminal& terminal);

/// Prints how the views of a scan are decoded.
void print_plan(const DecodePlan& plan, Terminal& terminal);

/// Prints the stages of one view: what the pixels are, the assessments of the frames, the files.
void print_decoded_view(const Scan& scan,
                        const DecodePlan& plan,
                        const ViewResult& result,
                        const std::filesystem::path& folder,
                        Terminal& terminal);

/// Prints the views of a scan, one line each as it is decoded, or JSON at the end.
class DecodedScan {
 public:
  /// The references must outlive it. `folder` holds a folder for each view.
  DecodedScan(const Scan& scan,
              const DecodePlan& plan,
              const std::filesystem::path& folder,
              Terminal& terminal);
  ~DecodedScan();
  DecodedScan(const DecodedScan&) = delete;
  DecodedScan& operator=(const DecodedScan&) = delete;
  DecodedScan(DecodedScan&&) = delete;
  DecodedScan& operator=(DecodedScan&&) = delete;

  void add(const ViewResult& result);
  void finish();

 private:
  const Scan& scan_;
  const DecodePlan& plan_;
  const std::filesystem::path& folder_;
  Terminal& terminal_;
  std::unique_ptr<nlohmann::ordered_json> views_;
  std::vector<std::string> untrusted_;  ///< a clause for each view that is not trustworthy
  std::vector<std::string> empty_;      ///< a clause for each view without a phase
};

}  // namespace frangia

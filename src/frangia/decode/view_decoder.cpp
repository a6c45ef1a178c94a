#include "frangia/decode/view_decoder.h"

#include <utility>

#include "frangia/dataset/read_frames.h"

namespace frangia {

ViewDecoder::ViewDecoder(const Scan& scan,
                         const Image<Eigen::Vector2f>& rays,
                         const DecodeOptions& options,
                         const Run& run,
                         std::shared_ptr<const DecodedViews> known)
    : scan_(scan),
      rays_(rays),
      options_(options),
      plan_(plan_decoding(scan.patterns, scan.rig, options)),
      run_(run),
      known_(std::move(known)),
      forward_stop_(run.stop, [this] { stop_.request_stop(); }) {
  start();
}

ViewDecoder::~ViewDecoder() {
  stop_.request_stop();
  if (pending_.valid()) pending_.wait();
}

void ViewDecoder::start() {
  if (view_ == scan_.views.size()) return;
  pending_ = std::async(std::launch::async, [this, view = view_] { return decode(view); });
}

DecodedView ViewDecoder::next() {
  Outcome outcome = pending_.get();
  outcome.told.tell(run_);
  if (outcome.error) std::rethrow_exception(outcome.error);
  ++view_;
  start();
  return std::move(outcome.told.view);
}

ViewDecoder::Outcome ViewDecoder::decode(std::size_t view) const {
  Outcome out;
  std::vector<DecodeMessage> said;
  Run run;
  run.stop = stop_.get_token();
  run.on_warning = [&](const std::string& sentence) { said.push_back({true, sentence}); };
  run.on_note = [&](const std::string& sentence) { said.push_back({false, sentence}); };
  try {
    if (known_) {
      if (const auto known = known_->find(scan_, options_, view)) {
        out.told = *known;
        return out;
      }
    }
    const std::vector<FrameStack> stacks = read_frames(scan_, view, run);
    out.told = decode_told(scan_, view, stacks, plan_, rays_, options_, run.stop);
  } catch (...) {
    out.error = std::current_exception();
  }
  out.told.messages.insert(out.told.messages.begin(), said.begin(), said.end());
  return out;
}

}  // namespace frangia

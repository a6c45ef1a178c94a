#include "frangia/decode/view_decoder.h"

#include <utility>

#include "frangia/dataset/read_frames.h"
#include "frangia/decode/internal/view_color.h"

namespace frangia {

ViewDecoder::ViewDecoder(const Scan& scan,
                         const Image<Eigen::Vector2f>& rays,
                         const DecodeOptions& options,
                         const Run& run)
    : scan_(scan),
      rays_(rays),
      options_(options),
      plan_(plan_decoding(scan.patterns, scan.rig, options)),
      run_(run),
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
  for (const Message& message : outcome.messages)
    message.warning ? run_.warn(message.sentence) : run_.note(message.sentence);
  if (outcome.error) std::rethrow_exception(outcome.error);
  ++view_;
  start();
  return std::move(outcome.view);
}

ViewDecoder::Outcome ViewDecoder::decode(std::size_t view) const {
  Outcome out;
  Run run;
  run.stop = stop_.get_token();
  run.on_warning = [&](const std::string& sentence) { out.messages.push_back({true, sentence}); };
  run.on_note = [&](const std::string& sentence) { out.messages.push_back({false, sentence}); };
  // Frames are named by the reader; the decoder does not know which view they are.
  const std::string prefix = scan_.views[view].folder.string() + ": ";
  Run decoding = run;
  decoding.on_warning = [&](const std::string& sentence) { run.warn(prefix + sentence); };
  decoding.on_note = [&](const std::string& sentence) { run.note(prefix + sentence); };
  try {
    const std::vector<FrameStack> stacks = read_frames(scan_, view, run);
    out.view =
        decode_view(stacks, plan_, scan_.rig, rays_, options_of_view(options_, view), decoding);
    out.view.color = view_color(stacks, options_.colors);
  } catch (...) {
    out.error = std::current_exception();
  }
  return out;
}

}  // namespace frangia

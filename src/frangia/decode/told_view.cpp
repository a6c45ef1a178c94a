#include "frangia/decode/told_view.h"

#include "frangia/decode/internal/view_color.h"

namespace frangia {

void ToldView::tell(const Run& run) const {
  for (const DecodeMessage& message : messages)
    message.warning ? run.warn(message.sentence) : run.note(message.sentence);
}

ToldView decode_told(const Scan& scan,
                     std::size_t view,
                     std::span<const FrameStack> stacks,
                     const DecodePlan& plan,
                     const Image<Eigen::Vector2f>& rays,
                     const DecodeOptions& options,
                     const std::stop_token& stop) {
  ToldView out;
  // Frames are named by the reader; the decoder does not know which view they are.
  const std::string prefix = scan.views[view].folder.string() + ": ";
  Run run;
  run.stop = stop;
  run.on_warning = [&](const std::string& sentence) {
    out.messages.push_back({true, prefix + sentence});
  };
  run.on_note = [&](const std::string& sentence) {
    out.messages.push_back({false, prefix + sentence});
  };
  out.view = decode_view(stacks, plan, scan.rig, rays, options_of_view(options, view), run);
  out.view.color = view_color(stacks, options.colors);
  return out;
}

}  // namespace frangia

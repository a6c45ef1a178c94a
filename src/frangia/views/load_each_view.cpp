#include "frangia/views/load_each_view.h"

#include <future>

namespace frangia {

void load_each_view(const ViewStore& views,
                    const std::function<void(std::size_t index, View& view)>& use,
                    PointSigma sigma) {
  const auto load = [&](std::size_t i) {
    return std::async(std::launch::async,
                      [&views, i, sigma] { return views.load_points(i, sigma); });
  };
  std::future<View> next;
  for (std::size_t i = 0; i < views.size(); ++i) {
    View view = i == 0 ? views.load_points(0, sigma) : next.get();
    if (i + 1 < views.size()) next = load(i + 1);
    use(i, view);
  }
}

}  // namespace frangia

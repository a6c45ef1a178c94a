#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/views/view_store.h"

namespace frangia {
namespace {

ViewStore views_of(const std::vector<float>& depths_mm) {
  ViewStore views;
  for (const float depth_mm : depths_mm) {
    View view;
    view.range = {Image<float>(4, 3, depth_mm), Image<float>(4, 3, 0.1F)};
    views.add(view);
  }
  return views;
}

TEST(LoadEachView, LoadsTheViewsInTheirOrder) {
  const std::vector<float> depths_mm = {300.0F, 100.0F, 200.0F};
  std::vector<float> loaded_mm;
  load_each_view(views_of(depths_mm), [&](std::size_t i, const View& view) {
    EXPECT_EQ(i, loaded_mm.size());
    loaded_mm.push_back(view.range.depth_mm(3, 2));
  });
  EXPECT_EQ(loaded_mm, depths_mm);
  load_each_view({}, [](std::size_t, const View&) { FAIL(); });
}

TEST(LoadEachView, StopsAtAnError) {
  int calls = 0;
  const auto fail = [&](std::size_t, const View&) {
    ++calls;
    throw Error(ErrorKind::Cancelled, "stopped");
  };
  EXPECT_THROW(load_each_view(views_of({1.0F, 2.0F, 3.0F}), fail), Error);
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace frangia

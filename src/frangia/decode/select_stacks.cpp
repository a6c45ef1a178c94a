#include "frangia/decode/select_stacks.h"

#include <algorithm>
#include <cstddef>

namespace frangia {

std::vector<const FrameStack*> fringes_of(std::span<const FrameStack> stacks,
                                          FringeDirection direction) {
  std::vector<const FrameStack*> fringes;
  for (const FrameStack& stack : stacks) {
    const bool first = stack.exposure == 0;
    if (first && stack.pattern.kind == PatternKind::Fringe && stack.pattern.direction == direction)
      fringes.push_back(&stack);
  }
  std::stable_sort(fringes.begin(), fringes.end(), [](const auto* a, const auto* b) {
    return a->pattern.fringes_per_unit() < b->pattern.fringes_per_unit();
  });
  return fringes;
}

const FrameStack* line_of(std::span<const FrameStack> stacks) {
  const auto found = std::find_if(stacks.begin(), stacks.end(), [](const FrameStack& stack) {
    return stack.pattern.kind == PatternKind::Line;
  });
  return found == stacks.end() ? nullptr : &*found;
}

std::span<const FrameStack> exposures_of(const FrameStack* stack) {
  return {stack, static_cast<std::size_t>(stack->pattern.exposure_count())};
}

bool are_bracketed(std::span<const FrameStack> stacks) {
  return std::any_of(stacks.begin(), stacks.end(), [](const FrameStack& one) {
    return one.pattern.exposure_count() > 1;
  });
}

std::span<const FrameStack> gray_of(std::span<const FrameStack> stacks, FringeDirection direction) {
  for (const FrameStack& stack : stacks) {
    if (stack.pattern.kind == PatternKind::Gray && stack.pattern.direction == direction)
      return exposures_of(&stack);
  }
  return {};
}

std::vector<Pattern> patterns_of(std::span<const FrameStack> stacks) {
  std::vector<Pattern> patterns;
  for (const FrameStack& stack : stacks)
    if (stack.exposure == 0) patterns.push_back(stack.pattern);
  return patterns;
}

}  // namespace frangia

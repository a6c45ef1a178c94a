#include "frangia/core/enum_names.h"

#include <gtest/gtest.h>

#include "support/error_of.h"

namespace frangia {
namespace {

enum class Light { Off, Dim, Full, Hidden };

constexpr auto names_of(Light /*any*/) {
  return EnumNames<Light, 3>{{{Light::Full, "full"}, {Light::Dim, "dim"}, {Light::Off, "off"}}};
}

TEST(EnumNames, GoFromValuesToNamesAndBack) {
  for (const auto& [value, name] : names_of(Light{})) {
    EXPECT_EQ(name_of(value), name);
    EXPECT_EQ(find_named<Light>(name), value);
    EXPECT_EQ(value_named<Light>("light", name), value);
  }
  EXPECT_EQ(name_of(Light::Hidden), "");
  EXPECT_EQ(find_named<Light>("Full"), std::nullopt);
  EXPECT_EQ(find_named<Light>(""), std::nullopt);
}

TEST(EnumNames, AreListedInTheOrderOfTheirTable) {
  EXPECT_EQ(all_names<Light>(), (std::vector<std::string>{"full", "dim", "off"}));
  EXPECT_EQ(listed_names<Light>(), "full, dim or off");
  EXPECT_EQ(testing::error_of([] { static_cast<void>(value_named<Light>("light", "bright")); }),
            "light is \"bright\"; use full, dim or off");
}

}  // namespace
}  // namespace frangia

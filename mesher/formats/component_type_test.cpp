#include "mesher/formats/component_type.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <type_traits>

namespace cbc3d::formats {
namespace {

struct Properties {
  std::size_t bytes;
  bool has_sign, is_floating;
  bool operator==(const Properties&) const = default;
};

Properties properties_of(Component component) {
  return with_type(component, [](const auto* type) {
    using T = std::remove_const_t<std::remove_pointer_t<decltype(type)>>;
    return Properties{sizeof(T), std::numeric_limits<T>::is_signed, std::is_floating_point_v<T>};
  });
}

TEST(ComponentType, HasTheSizeAndTheSignThatItsNameSays) {
  EXPECT_EQ(properties_of(Component::uint8), (Properties{1, false, false}));
  EXPECT_EQ(properties_of(Component::int8), (Properties{1, true, false}));
  EXPECT_EQ(properties_of(Component::uint16), (Properties{2, false, false}));
  EXPECT_EQ(properties_of(Component::int16), (Properties{2, true, false}));
  EXPECT_EQ(properties_of(Component::uint32), (Properties{4, false, false}));
  EXPECT_EQ(properties_of(Component::int32), (Properties{4, true, false}));
  EXPECT_EQ(properties_of(Component::uint64), (Properties{8, false, false}));
  EXPECT_EQ(properties_of(Component::int64), (Properties{8, true, false}));
  EXPECT_EQ(properties_of(Component::float32), (Properties{4, true, true}));
  EXPECT_EQ(properties_of(Component::float64), (Properties{8, true, true}));
}

}  // namespace
}  // namespace cbc3d::formats

#include <type_traits>
#include <utility>

#include <gtest/gtest.h>

#include <boresight/io/case/section.hpp>

namespace boresight::io {
namespace {

struct Numbers {
  int first = 1, second = 2;
};

TEST(Section, CopiesAreIndependent) {
  Section<Numbers> own;
  own->first = 3;
  Section<Numbers> copy = own, assigned;
  assigned = own;
  own->first = 4;
  EXPECT_EQ(copy->first, 3);
  EXPECT_EQ(assigned->first, 3);
  assigned = Numbers{5, 6};
  EXPECT_EQ((*assigned).second, 6);
  own = std::move(assigned);
  EXPECT_EQ(own->first, 5);
}

TEST(Section, ConstantSectionGivesConstantContent) {
  EXPECT_TRUE((std::is_same_v<decltype(*std::declval<const Section<Numbers>&>()), const Numbers&>));
  EXPECT_TRUE((std::is_same_v<decltype(std::declval<const Section<Numbers>&>().operator->()),
                              const Numbers*>));
}

TEST(OptionalSection, IsEmptyUntilAssignedAndAfterReset) {
  OptionalSection<Numbers> own;
  EXPECT_FALSE(own);
  OptionalSection<Numbers> copy = own;
  EXPECT_FALSE(copy.has_value());
  own.emplace().first = 7;
  copy = own;
  own.reset();
  EXPECT_FALSE(own);
  ASSERT_TRUE(copy);
  EXPECT_EQ(copy->first, 7);
}

}  // namespace
}  // namespace boresight::io

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/description/recording_visitor.hpp"

namespace boresight::io {

// A result of which a part is described by its own function, found beside its type.
struct DescribedPart {
  double angle = 0.0;
};
struct DescribedResult {
  std::vector<DescribedPart> parts;
  std::optional<DescribedPart> best;
  std::optional<std::string> remark;
};

void describe(Visitor& v, const DescribedPart& part) {
  v.number("angle", part.angle, key_units::degree_as_kept, "Of the part.");
}

void describe(Visitor& v, const DescribedResult& result) {
  v.list("parts", result.parts, "All.");
  v.object("best", result.best, "Null without one.");
  v.optional_members(result.remark, [&](const std::string& remark) {
    v.text("remark", remark, "Only where there is one.");
  });
}

namespace {

using testing::ElementsAre;

TEST(Visitor, VisitsEveryMemberInOrder) {
  RecordingVisitor v;
  describe(v, DescribedResult{{{1.0}, {2.0}}, DescribedPart{3.0}, "much"});
  EXPECT_THAT(v.places,
              ElementsAre("parts[0].angle_deg", "parts[1].angle_deg", "best.angle_deg", "remark"));
  EXPECT_EQ(v.numbers_found["parts[1].angle_deg"], 2.0);
  EXPECT_EQ(v.numbers_found["best.angle_deg"], 3.0);
}

TEST(Visitor, LeavesOutWhatIsNotThere) {
  RecordingVisitor v;
  describe(v, DescribedResult{});
  EXPECT_THAT(v.places, ElementsAre("best"));
}

TEST(Visitor, ShowsTheWholeFormByExample) {
  RecordingVisitor v(true);
  describe(v, DescribedResult{});
  EXPECT_THAT(v.places, ElementsAre("parts[0].angle_deg", "best.angle_deg", "remark"));
}

}  // namespace
}  // namespace boresight::io

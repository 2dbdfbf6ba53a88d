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

TEST(Visitor, ListsHaveOneElementEach) {
  RecordingVisitor v;
  v.number_rows("correlation", std::vector<std::vector<double>>{{1.0, 0.5}, {0.5, 1.0}},
                key_units::ratio, "Of two.");
  v.counts("states_1", std::vector<std::uint64_t>{0, 2}, "In order.");
  EXPECT_THAT(v.places,
              ElementsAre("correlation_1[0][0]", "correlation_1[0][1]", "correlation_1[1][0]",
                          "correlation_1[1][1]", "states_1[0]", "states_1[1]"));
  EXPECT_EQ(v.numbers_found["correlation_1[0][1]"], 0.5);
}

TEST(Visitor, ListsThatAreNotPresentHaveNoElements) {
  RecordingVisitor v, example(true);
  const std::vector<double> peaks{1.0, 2.0};
  v.numbers_if("peaks", false, peaks, key_units::ratio, "Null without.");
  EXPECT_TRUE(v.places.empty());
  v.numbers_if("peaks", true, peaks, key_units::ratio, "Null without.");
  EXPECT_THAT(v.places, ElementsAre("peaks_1[0]", "peaks_1[1]"));
  example.numbers_if("peaks", false, {}, key_units::ratio, "Null without.");
  EXPECT_THAT(example.places, ElementsAre("peaks_1[0]"));
}

}  // namespace
}  // namespace boresight::io

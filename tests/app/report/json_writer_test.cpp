#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <boresight/app/report/json_writer.hpp>

namespace boresight::app {

// Written in every way that a member can be.
struct WrittenResult {
  double angle = std::numeric_limits<double>::infinity();
  std::vector<std::string> names;
  std::vector<double> values;
  std::optional<double> extra;
};

void describe(io::Visitor& v, const WrittenResult& result) {
  v.number("angle", result.angle, io::key_units::degree_as_kept, "Of it.");
  v.texts("names", result.names, "Of its parts.");
  v.numbers("values", result.values, io::key_units::second, "Of its parts.");
  v.group("inner", "A part.", [&] { v.count("seed", std::uint64_t{1} << 63U, "Large."); });
  v.optional_members(result.extra, [&](double extra) {
    v.number("extra", extra, io::key_units::ratio, "Only where there is one.");
  });
  v.text_or_null("remark", "", "Null.");
}

namespace {

TEST(JsonWriter, WritesInOrderAndNullForWhatIsInfinite) {
  EXPECT_EQ(json_of(WrittenResult{}).dump(),
            R"({"angle_deg":null,"names":[],"values_s":[],"inner":{"seed":9223372036854775808},)"
            R"("remark":null})");
}

TEST(JsonWriter, WritesListsAndOptionalMembers) {
  const auto json = json_of(WrittenResult{90.0, {"a"}, {0.5, 2.0}, 3.0});
  EXPECT_EQ(json.at("angle_deg"), 90.0);
  EXPECT_EQ(json.at("names").dump(), R"(["a"])");
  EXPECT_EQ(json.at("values_s").dump(), "[0.5,2.0]");
  EXPECT_EQ(json.at("extra_1"), 3.0);
}

}  // namespace
}  // namespace boresight::app

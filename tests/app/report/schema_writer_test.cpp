#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <boresight/app/report/schema_writer.hpp>

namespace boresight::app {

struct SchemaPart {
  double angle = 0.0;
};
// Of two parts and what is not always there.
struct SchemaResult {
  std::vector<SchemaPart> parts;
  std::optional<SchemaPart> best;
  std::optional<double> extra;
};
struct TwiceDescribed {};

void describe(io::Visitor& v, const SchemaPart& part) {
  v.defined_as("part", "A part.");
  v.number("angle", part.angle, io::key_units::degree_as_kept, "Its angle.",
           {.minimum = 0.0, .finite = true});
}

void describe(io::Visitor& v, const SchemaResult& result) {
  v.list("parts", result.parts, "All.", io::ListSize{.minimum = 1});
  v.object("best", result.best, "Null without one.");
  v.optional_members(result.extra, [&](double extra) {
    v.number("extra", extra, io::key_units::ratio, "Only where there is one.");
  });
  v.word("form", "round", {"round", "square"}, "Its form.");
}

void describe(io::Visitor& v, const TwiceDescribed& /*result*/) {
  v.flag("again", true, "First.");
  v.flag("again", true, "Second.");
}

namespace {

using Json = nlohmann::ordered_json;

TEST(SchemaWriter, RequiresEveryKeyThatIsAlwaysThereAndAllowsNoOther) {
  const Json schema = schema_of<SchemaResult>({"Result", "", ""});
  EXPECT_EQ(schema.at("required").dump(), R"(["parts","best","form"])");
  EXPECT_EQ(schema.at("additionalProperties"), false);
  EXPECT_TRUE(schema.at("properties").contains("extra_1"));
  EXPECT_EQ(schema.at("properties").at("form").at("enum").dump(), R"(["round","square"])");
  EXPECT_EQ(schema.at("properties").at("extra_1").at("type").dump(), R"(["number","null"])");
}

TEST(SchemaWriter, DefinesAPartOnce) {
  const Json schema = schema_of<SchemaResult>({"Result", "", ""});
  const Json& part = schema.at("$defs").at("part");
  EXPECT_EQ(part.at("properties").at("angle_deg").dump(),
            R"({"description":"Its angle.","type":"number","minimum":0})");
  const Json& parts = schema.at("properties").at("parts");
  EXPECT_EQ(parts.at("items").at("$ref"), "#/$defs/part");
  EXPECT_EQ(parts.at("minItems"), 1);
  EXPECT_EQ(schema.at("properties").at("best").at("anyOf").dump(),
            R"([{"$ref":"#/$defs/part"},{"type":"null"}])");
}

TEST(SchemaWriter, KeepsConditions) {
  const Json schema =
      schema_of<SchemaResult>({"Result", "", ""}, Json::array({{{"required", {"extra_1"}}}}));
  EXPECT_EQ(schema.at("allOf").size(), 1U);
  EXPECT_FALSE(schema_of<SchemaResult>({"Result", "", ""}).contains("allOf"));
}

TEST(SchemaWriter, RefusesAKeyThatIsDescribedTwice) {
  EXPECT_THROW(schema_of<TwiceDescribed>({"", "", ""}), std::logic_error);
}

}  // namespace
}  // namespace boresight::app

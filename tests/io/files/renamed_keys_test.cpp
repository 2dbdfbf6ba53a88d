#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <boresight/io/files/input_files.hpp>
#include <boresight/io/files/renamed_keys.hpp>

namespace boresight::io {
namespace {

using Json = nlohmann::ordered_json;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

TEST(RenamedKeys, AreSortedAndNameEachKeyOnce) {
  std::set<std::string_view> before;
  for (const auto& key : renamed_keys()) {
    EXPECT_TRUE(before.insert(key.before).second) << key.before;
    EXPECT_NE(key.before, key.now);
  }
  EXPECT_TRUE(std::ranges::is_sorted(renamed_keys(), {}, &RenamedKey::before));
  // No present key is one of before: a report of today is read as it is.
  for (const auto& key : renamed_keys()) EXPECT_FALSE(before.contains(key.now)) << key.now;
}

TEST(UsePresentKeys, RenamesAtAnyDepthInOrder) {
  const std::string last(renamed_keys().back().before);
  Json report;
  report["title"] = "t";
  report["list"] = Json::array({Json{{last, 1}, {"other", 2}}});
  use_present_keys(report, "deep.json");
  const std::string now(renamed_keys().back().now);
  EXPECT_EQ(report.dump(), R"({"title":"t","list":[{")" + now + R"(":1,"other":2}]})");
  EXPECT_THAT(warnings_noted(),
              Contains(AllOf(HasSubstr("deep.json"), HasSubstr(last), HasSubstr(now))));
}

TEST(UsePresentKeys, LeavesAPresentReportAsItIs) {
  const auto& key = renamed_keys().front();
  Json report{{std::string(key.now), 1}, {std::string(key.before), 2}};
  const Json same = report;
  use_present_keys(report, "present.json");
  EXPECT_EQ(report, same);
  EXPECT_THAT(warnings_noted(), testing::Not(Contains(HasSubstr("present.json"))));
}

}  // namespace
}  // namespace boresight::io

#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/app/report/report_schemas.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

TEST(ReportSchemas, PublishedFilesAreThoseOfTheDescriptions) {
  for (const auto name : described_reports()) {
    std::ifstream file(std::string(BORESIGHT_SOURCE_DIR "/docs/") + std::string(name) +
                       ".schema.json");
    const std::string published{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(published, report_schema(name)) << "./dev schemas renews it";
  }
}

TEST(ReportSchemas, UnknownReportIsRefused) {
  EXPECT_THROW(report_schema("bench"), InvalidInput);
}

}  // namespace
}  // namespace boresight::app

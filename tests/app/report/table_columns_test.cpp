#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/app/report/table_columns.hpp>
#include <boresight/io/description/loop_results.hpp>

namespace boresight::app {
namespace {

using testing::ElementsAre;

TEST(TableColumns, ShowNumbersThatHaveAHeading) {
  control::Margins margins;
  margins.increasing_gain_margin = 10.0;
  margins.decreasing_gain_margin = 0.0;
  margins.phase_margin_deg = 45.04;
  margins.delay_margin = 0.1234;
  margins.sensitivity.magnitude = 1.6;
  const TableColumns columns = columns_of(margins);
  EXPECT_THAT(columns.headings,
              ElementsAre("gain up dB", "gain down dB", "modulus", "phase deg", "delay ms"));
  EXPECT_THAT(columns.cells, ElementsAre("20.0", "none", "0.625", "45.0", "123.4"));
}

}  // namespace
}  // namespace boresight::app

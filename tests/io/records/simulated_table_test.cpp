#include <gtest/gtest.h>

#include <boresight/io/records/simulated_table.hpp>

namespace boresight::io {
namespace {

design::SimulatedRecord short_record() {
  design::SimulatedRecord record;
  record.test = "slosh";
  record.channels = {{"time", "s", 3, Eigen::Vector2d(0.0, 0.005)},
                     {"tach", "V", 1, Eigen::Vector2d(-1.25, 10.0)}};
  record.duration = 0.005;
  record.planned_duration = 0.005;
  record.sample_time = 0.005;
  return record;
}

TEST(SimulatedTable, HasTheChannelsInTheirUnits) {
  EXPECT_EQ(to_csv(table_of(short_record())), "time [s],tach [V]\n0.000,-1.2\n0.005,10.0\n");
}

TEST(SimulatedTable, SaysThatTheRunWasEnded) {
  auto record = short_record();
  record.complete = false;
  record.planned_duration = 10.0;
  EXPECT_EQ(table_of(record).comments,
            std::vector<std::string>{"incomplete: interrupted after 0.005 s of 10.000 s"});
}

}  // namespace
}  // namespace boresight::io

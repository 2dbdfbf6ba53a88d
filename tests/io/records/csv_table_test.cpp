#include <gtest/gtest.h>

#include <boresight/io/records/csv_table.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

TEST(CsvTable, IsWrittenAsARecorderWould) {
  CsvTable table;
  table.comments = {"a remark"};
  table.columns = {{"time", "s", 3, Eigen::Vector2d(0.0, 0.005)},
                   {"tach", "V", 1, Eigen::Vector2d(-1.25, 10.0)}};
  EXPECT_EQ(to_csv(table), "# a remark\ntime [s],tach [V]\n0.000,-1.2\n0.005,10.0\n");
  table.columns[1].values.resize(3);
  EXPECT_THROW(to_csv(table), InvalidInput);
}

}  // namespace
}  // namespace boresight::io

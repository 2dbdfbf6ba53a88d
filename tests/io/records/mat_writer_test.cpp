#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/io/records/mat_elements.hpp>
#include <boresight/io/records/mat_writer.hpp>
#include <boresight/io/records/record_mat.hpp>
#include <boresight/io/records/record_mat_writer.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using testing::HasSubstr;

// The arrays of a file, one behind the other.
std::vector<io::MatArray> arrays_of(const std::string& file) {
  std::vector<io::MatArray> arrays;
  io::MatCursor cursor(std::string_view(file).substr(128), false, "f.mat");
  while (!cursor.at_end()) arrays.push_back(io::read_mat_array(cursor.next(), false, "f.mat"));
  return arrays;
}

io::CsvTable awkward_record() {
  io::CsvTable record;
  record.comments = {"one", "two"};
  Eigen::VectorXd time(5), tach(5);
  time << 0.0, 0.005, 0.01, 0.1 + 0.2, 1e300;
  tach << -0.0, std::numeric_limits<double>::denorm_min(), std::numbers::pi, -1e-300,
      std::nextafter(1.0, 2.0);
  record.columns = {{"time", "s", 3, time}, {"tach", "V", 1, tach}};
  return record;
}

TEST(MatWriter, WritesRecordsThatTheReaderHasBackBitByBit) {
  const io::CsvTable record = awkward_record();
  const io::RecordTable read = io::read_record_mat(to_mat(record), "r.mat");
  ASSERT_EQ(read.columns.size(), record.columns.size());
  for (std::size_t i = 0; i < read.columns.size(); ++i) {
    const auto& written = record.columns[i];
    EXPECT_EQ(read.columns[i].name, written.name);
    EXPECT_EQ(read.columns[i].unit, written.unit);
    ASSERT_EQ(read.columns[i].values.size(), static_cast<std::size_t>(written.values.size()));
    EXPECT_EQ(std::memcmp(read.columns[i].values.data(), written.values.data(),
                          read.columns[i].values.size() * sizeof(double)),
              0)
        << written.name;
  }
  EXPECT_TRUE(read.remarks.empty());
  EXPECT_EQ(to_mat(record), to_mat(record));
}

TEST(MatWriter, RefusesARecordOfUnequalColumnsAndNamesThatMatlabDoesNotTake) {
  io::CsvTable record = awkward_record();
  record.columns[1].values.conservativeResize(4);
  EXPECT_THROW(to_mat(record), InvalidInput);
  io::MatVariables variables;
  const std::vector<std::string> refused{"", "1a", "a b", "a-b", "_a", std::string(64, 'a')};
  for (const auto& name : refused) {
    EXPECT_THROW(variables.add_number(name, 1.0), InvalidInput) << name;
  }
  variables.add_number(std::string(63, 'a'), 1.0);
  EXPECT_THROW(variables.add_text(std::string(63, 'a'), "again"), InvalidInput);
}

TEST(MatWriter, KeepsShapesPagesAndEmptyThings) {
  io::MatVariables variables;
  variables.add_matrix("empty", Eigen::MatrixXd(0, 3));
  const Eigen::MatrixXcd page = Eigen::MatrixXcd::Constant(2, 3, {1.5, -2.5});
  variables.add_pages("pages", {page, 2.0 * page, 3.0 * page, 4.0 * page});
  variables.add_pages("no_pages", {});
  variables.add_text("no_text", "");
  const std::string file = variables.file("test");
  auto arrays = arrays_of(file);
  ASSERT_EQ(arrays.size(), 4U);
  EXPECT_EQ(arrays[0].dimensions, (std::vector<std::int64_t>{0, 3}));
  io::MatArray& pages = arrays[1];
  EXPECT_EQ(pages.name, "pages");
  EXPECT_TRUE(pages.complex);
  EXPECT_EQ(pages.dimensions, (std::vector<std::int64_t>{2, 3, 4}));
  const auto real = pages.rest.numbers(pages.rest.next());
  const auto imaginary = pages.rest.numbers(pages.rest.next());
  ASSERT_EQ(real.size(), 24U);
  ASSERT_EQ(imaginary.size(), 24U);
  EXPECT_EQ(real[23], 6.0);
  EXPECT_EQ(imaginary[6], -5.0);
  EXPECT_TRUE(pages.rest.at_end());
  EXPECT_EQ(arrays[2].elements, 0U);
  EXPECT_EQ(arrays[3].elements, 0U);
  EXPECT_THROW(variables.add_pages("uneven", {page, Eigen::MatrixXcd::Zero(2, 2)}), InvalidInput);
}

TEST(MatWriter, WritesTextBeyondAsciiAsUtf16) {
  io::MatVariables variables;
  variables.add_text("text", "a\xC2\xB0\xE2\x82\xAC\xF0\x9D\x84\x9E\xFFz");  // degree, euro, clef
  const std::string file = variables.file("test");
  auto arrays = arrays_of(file);
  ASSERT_EQ(arrays.size(), 1U);
  io::MatElement element = arrays[0].rest.next();
  EXPECT_EQ(element.type, 17U);
  element.type = 4;  // the units, as numbers
  EXPECT_EQ(arrays[0].rest.numbers(element),
            (std::vector<double>{'a', 0xB0, 0x20AC, 0xD834, 0xDD1E, '?', 'z'}));
}

}  // namespace
}  // namespace boresight::io

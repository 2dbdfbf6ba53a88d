#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/io/records/record_file.hpp>
#include <boresight/io/records/record_mat.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string path_of(const std::string& file) {
  return std::string(BORESIGHT_SOURCE_DIR) + "/tests/data/records/" + file;
}

std::string content_of(const std::string& file) {
  std::ifstream stream(path_of(file), std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

const io::RecordColumn& column(const io::RecordTable& table, const std::string& name) {
  for (const auto& one : table.columns) {
    if (one.name == name) return one;
  }
  throw std::runtime_error("no column " + name);
}

std::string refusal(const std::string& content) {
  try {
    io::read_record_mat(content, "r.mat");
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "taken";
}

// A file written by hand, of either byte order.
class MatFile {
 public:
  explicit MatFile(bool swapped = false) : swapped_(swapped) {
    bytes_ = std::string("MATLAB 5.0 MAT-file, by hand");
    bytes_.resize(124, ' ');
    bytes_ += swapped ? std::string("\x01\x00MI", 4) : std::string("\x00\x01IM", 4);
  }
  template <typename Number>
  std::string number(Number value) const {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return swapped_ ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
  }
  std::string element(std::uint32_t type, const std::string& content) const {
    return number(type) + number(static_cast<std::uint32_t>(content.size())) + content +
           std::string((8 - content.size() % 8) % 8, '\0');
  }
  std::string head(std::uint32_t kind, std::int32_t rows, std::int32_t width,
                   const std::string& name) const {
    return element(6, number(kind) + number(std::uint32_t{0})) +
           element(5, number(rows) + number(width)) + element(1, name);
  }
  std::string vector(const std::string& name, const std::vector<double>& values) const {
    std::string numbers;
    for (const double value : values) numbers += number(value);
    return element(
        14, head(6, static_cast<std::int32_t>(values.size()), 1, name) + element(9, numbers));
  }
  std::string with(const std::string& elements) const { return bytes_ + elements; }

 private:
  bool swapped_;
  std::string bytes_;
};

TEST(ReadRecordMat, TakesOctavesVectorsCompressedOrNot) {
  for (const std::string file : {"vectors-v6.mat", "vectors-v7.mat"}) {
    const io::RecordTable table = io::read_record(path_of(file));
    EXPECT_EQ(table.format, "MAT 5");
    ASSERT_EQ(table.columns.size(), 4U) << file;
    EXPECT_EQ(column(table, "t").unit, "s");
    EXPECT_EQ(column(table, "p1_in").unit, "psi");
    EXPECT_EQ(column(table, "p1_out").unit, "");
    for (std::size_t i = 0; i < 50; ++i) {
      const double t = 0.005 * static_cast<double>(i);
      EXPECT_NEAR(column(table, "t").values[i], t, 1e-15);
      EXPECT_NEAR(column(table, "p1_in").values[i], 1e3 + std::sin(50 * t), 1e-9);
      EXPECT_NEAR(column(table, "p1_out").values[i], 900 + std::cos(40 * t), 1e-4);
      EXPECT_EQ(column(table, "tach").values[i], std::round(1000 * std::sin(9 * t)));
    }
    EXPECT_THAT(table.remarks, ElementsAre("no vectors of numbers, left out: 'fs'"));
  }
}

TEST(ReadRecordMat, TakesAStructureAndEveryNumberType) {
  const io::RecordTable table = io::read_record(path_of("structure-v7.mat"));
  EXPECT_EQ(column(table, "p1_out").unit, "bar");  // of { data, unit }
  EXPECT_NEAR(column(table, "p1_out").values[0], 901.0, 1e-4);
  EXPECT_EQ(column(table, "time").values.size(), 50U);  // a row
  for (const std::string name : {"p1_in", "i8", "u16", "i32", "u32", "i64", "u64", "l"}) {
    EXPECT_EQ(column(table, name).values.size(), 50U) << name;
  }
  EXPECT_EQ(column(table, "p1_in").values[49], 25.0);
  EXPECT_THAT(table.remarks, ElementsAre("no vectors of numbers, left out: 'c', 'z', 'e'"));
}

TEST(ReadRecordMat, TakesTheColumnsOfAMatrix) {
  const io::RecordTable table = io::read_record(path_of("matrix-v6.mat"));
  ASSERT_EQ(table.columns.size(), 3U);
  EXPECT_NEAR(column(table, "data(:,2)").values[1], 1e3 + std::sin(0.25), 1e-9);
  EXPECT_THAT(table.remarks, ElementsAre("no vectors of numbers, left out: 's', 'a', 'q'"));
}

TEST(ReadRecordMat, TakesTheOtherByteOrder) {
  for (const bool swapped : {false, true}) {
    const MatFile file(swapped);
    const io::RecordTable table =
        io::read_record_mat(file.with(file.vector("x", {1.5, -2.5, 1e300})), "r.mat");
    EXPECT_EQ(table.columns[0].name, "x");
    EXPECT_THAT(table.columns[0].values, ElementsAre(1.5, -2.5, 1e300));
  }
}

TEST(ReadRecordMat, RefusesOtherVersionsWithTheRemedy) {
  EXPECT_EQ(refusal("MATLAB 7.3 MAT-file, Platform"),
            "r.mat: expected a MAT file of version 5, found version 7.3 (save it with `save -v7`)");
  EXPECT_THAT(refusal("\x89HDF\r\n"), HasSubstr("found version 7.3"));
  EXPECT_THAT(refusal(content_of("vectors-v4.mat")), HasSubstr("found another version"));
  EXPECT_THAT(refusal("MATLAB 5.0 MAT-file"), HasSubstr("found 19 bytes"));
  EXPECT_FALSE(io::is_mat("MATLAB export of the recorder\ntime [s],tach [V]\n0,1\n"));
}

TEST(ReadRecordMat, RefusesDamageWithWhatItIs) {
  const MatFile file;
  const std::string whole = file.with(file.vector("x", {1.0, 2.0}));
  EXPECT_THAT(refusal(whole.substr(0, whole.size() - 8)),
              HasSubstr("expected a whole MAT file of version 5, found an element of "));
  EXPECT_THAT(refusal(whole + "abc"), HasSubstr("its end within the head of an element"));
  EXPECT_THAT(refusal(file.with("")), HasSubstr("expected vectors of numbers, found none"));
  EXPECT_THAT(refusal(file.with(file.element(
                  14, file.head(6, 5, 1, "x") + file.element(9, std::string(16, '\0'))))),
              HasSubstr("2 numbers in 'x' that should have 5"));
  EXPECT_THAT(refusal(file.with(file.element(
                  14, file.head(6, 5, 1, "x") + file.element(14, std::string(16, '\0'))))),
              HasSubstr("an element of type 14 where numbers belong"));
  EXPECT_THAT(refusal(file.with(file.element(14, file.head(6, -5, 1, "x")))),
              HasSubstr("an array of negative size"));
  EXPECT_THAT(refusal(file.with(file.element(14, file.head(6, 1 << 20, 1 << 20, "x")))),
              HasSubstr("an array larger than the format allows"));
  EXPECT_THAT(refusal(file.with(file.element(14, file.element(6, "")))),
              HasSubstr("an array without flags"));
  EXPECT_THAT(refusal(file.with(file.element(14, file.element(9, std::string(8, '\0'))))),
              HasSubstr("an element of type 9 where integers belong"));
  EXPECT_THAT(
      refusal(file.with(file.element(14, file.element(6, file.number(std::uint64_t{6})) +
                                             file.element(5, file.number(std::int32_t{3}))))),
      HasSubstr("fewer than two dimensions"));
  EXPECT_THAT(refusal(file.with(file.element(14, file.head(2, 1, 1, "s") +
                                                     file.element(5, file.number(std::int32_t{0})) +
                                                     file.element(1, "x")))),
              HasSubstr("a structure whose field names have no length"));
  EXPECT_THAT(refusal(file.with(file.number(std::uint32_t{0x00080001}) + "abcd")),
              HasSubstr("a short element of 8 bytes"));
}

TEST(ReadRecordMat, RefusesCompressedBytesThatDoNotUnpack) {
  std::string content = content_of("vectors-v7.mat");
  content[140] = static_cast<char>(content[140] ^ 0x55);
  EXPECT_THAT(refusal(content), HasSubstr("a compressed element that"));
  const MatFile file;
  EXPECT_THAT(refusal(file.with(file.element(15, "not deflated"))),
              HasSubstr("a compressed element that does not unpack"));
}

TEST(ReadRecordMat, RefusesEveryCutFileOrTakesAPart) {
  for (const std::string name : {"vectors-v6.mat", "vectors-v7.mat", "structure-v7.mat"}) {
    const std::string content = content_of(name);
    for (std::size_t size = 0; size < content.size(); size += 3) {
      try {
        const io::RecordTable table = io::read_record_mat(content.substr(0, size), "r.mat");
        EXPECT_LT(table.columns.size(), 20U);
      } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), HasSubstr("r.mat: expected "));
      }
    }
  }
}

}  // namespace
}  // namespace boresight::io

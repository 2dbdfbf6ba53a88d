#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refused_call.hpp"
#include <boresight/io/files/input_files.hpp>
#include <boresight/io/records/record_file.hpp>
#include <boresight/io/records/record_text.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::NanSensitiveDoubleEq;

io::RecordTable read(const std::string& text) {
  return io::read_record_text(text, "r.csv");
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "taken";
}

void expect_three_rows(const io::RecordTable& table) {
  ASSERT_EQ(table.columns.size(), 2U);
  EXPECT_EQ(table.columns[0].name, "time");
  EXPECT_EQ(table.columns[0].unit, "s");
  EXPECT_EQ(table.columns[1].name, "Tach Out");
  EXPECT_EQ(table.columns[1].unit, "V");
  EXPECT_THAT(table.columns[0].values, ElementsAre(0.0, 0.5, 1.0));
  EXPECT_THAT(table.columns[1].values, ElementsAre(1.25, -2.5, 3e-3));
}

TEST(ReadRecordText, TakesEverySeparatorLineEndAndDecimalSign) {
  expect_three_rows(read("time [s],Tach Out [V]\n0,1.25\n0.5,-2.5\n1,3e-3\n"));
  expect_three_rows(read("time [s];Tach Out [V]\r\n0;1.25\r\n0.5;-2.5\r\n1;3e-3\r\n"));
  expect_three_rows(read("time [s];Tach Out [V]\n0;1,25\n0,5;-2,5\n1,0;3e-3\n"));
  expect_three_rows(read("time [s]\tTach Out [V]\n0\t1,25\n0,5\t-2,5\n1\t3e-3\n"));
  expect_three_rows(read("time [s]\tTach Out [V]\r0\t1.25\r0.5\t-2.5\r1\t3e-3\r"));
  expect_three_rows(read(" time[s] , Tach Out  [ V ] \n 0 , 1.25 \n0.5,\t-2.5\n1,3E-3\n"));
  expect_three_rows(read("time (s),Tach Out (V)\n0,1.25\n0.5,-2.5\n1.0,+3e-3\n"));
}

TEST(ReadRecordText, SkipsWhatIsNeitherHeaderNorNumbers) {
  expect_three_rows(
      read("\xEF\xBB\xBF# recorder 7\n% of\n\ntime [s],Tach Out [V]\n# go\n0,1.25\n\n"
           "0.5,-2.5\n  \n% stop\n1,3e-3\n"));
  expect_three_rows(read("\"time [s]\",\"Tach Out [V]\"\n\"0\",1.25\n0.5,\"-2.5\"\n1,3e-3\n"));
  expect_three_rows(read("time [s],Tach Out [V],\n0,1.25,\n0.5,-2.5,\n1,3e-3,\n"));
  expect_three_rows(read("\n\n\ntime [s],Tach Out [V]\n0,1.25\n0.5,-2.5\n1,3e-3\n"));
  const io::RecordTable titled =
      read("Recorder 7\nSerial,5x\ntime,Tach Out\n[s],[V]\n0,1.25\n0.5,-2.5\n1,3e-3\n");
  expect_three_rows(titled);
  EXPECT_THAT(titled.remarks, ElementsAre("the line below the names was taken for their units",
                                          "2 lines above the header were skipped"));
  const io::RecordTable commented = read("# time [s],Tach Out [V]\n0,1.25\n0.5,-2.5\n1,3e-3\n");
  expect_three_rows(commented);
  EXPECT_THAT(commented.remarks, ElementsAre("the header was taken from a comment line"));
}

TEST(ReadRecordText, TakesALineOfUnitsBelowTheNames) {
  for (const std::string units : {"[s],[V]", "s,V", "(s),(V)", "SEC,Volts", "\"s\", V ,"}) {
    const bool ended = units.back() == ',';
    const io::RecordTable table = read(std::string("time,Tach Out") + (ended ? ",\n" : "\n") +
                                       units + "\n0,1.25\n0.5,-2.5\n1,3e-3\n");
    ASSERT_EQ(table.columns.size(), 2U) << units;
    EXPECT_EQ(table.columns[0].name, "time");
    EXPECT_EQ(table.columns[1].name, "Tach Out");
    EXPECT_THAT(table.columns[0].unit, testing::AnyOf("s", "SEC"));
    EXPECT_THAT(table.columns[1].unit, testing::AnyOf("V", "Volts"));
    EXPECT_THAT(table.columns[1].values, ElementsAre(1.25, -2.5, 3e-3)) << units;
  }
  // A column without a unit, and names that are units' too.
  const io::RecordTable without = read("time;counter;p\ns;-;bar\n0,5;1;2\n1;2;3\n");
  EXPECT_EQ(without.columns[1].unit, "");
  EXPECT_EQ(without.columns[2].unit, "bar");
  EXPECT_EQ(read("Recorder 7,b\nt,V\n0,1\n").columns[0].name, "t");
}

TEST(ReadRecordText, FindsTheHeaderAmongOtherLines) {
  const io::RecordTable noted =
      read("time [s];Tach Out [V]\nfrom 12:00 on\n0;1,25\n0,5;-2,5\n1;3e-3\n");
  expect_three_rows(noted);
  EXPECT_THAT(noted.remarks, ElementsAre("1 line below the header was skipped"));
  const io::RecordTable titled =
      read("Recorder 7\n# time [s],Tach Out [V]\n0,1.25\n0.5,-2.5\n1,3e-3\n");
  expect_three_rows(titled);
  EXPECT_THAT(titled.remarks, ElementsAre("the header was taken from a comment line",
                                          "1 line above the header was skipped"));
  expect_three_rows(read("sep=;\ntime [s];Tach Out [V];;\n0;1,25;;\n0,5;-2,5;;\n1;3e-3;;\n"));
  expect_three_rows(read("time [s],Tach Out [V]\n0,1.25,\n0.5,-2.5,\n1,3e-3,\n"));
}

TEST(ReadRecordText, KeepsBracketsThatHoldNoUnitInTheName) {
  const io::RecordTable table =
      read("t (ms),Tach (raw),Tach (filtered) [V],p (kPa)\n0,1,2,3\n1,2,3,4\n");
  EXPECT_EQ(table.columns[0].unit, "ms");
  EXPECT_EQ(table.columns[1].name, "Tach (raw)");
  EXPECT_EQ(table.columns[1].unit, "");
  EXPECT_EQ(table.columns[2].name, "Tach (filtered)");
  EXPECT_EQ(table.columns[3].unit, "kPa");
}

TEST(ReadRecordText, TakesASeparatorInQuotesForText) {
  const io::RecordTable table = read("\"time, from start [s]\",\"p, in [psi]\"\n0,1\n1,2\n");
  EXPECT_EQ(table.columns[0].name, "time, from start");
  EXPECT_EQ(table.columns[1].name, "p, in");
}

TEST(ReadRecordText, LeavesAColumnWithoutUnitWithout) {
  const io::RecordTable table = read("t,x [ ],y[bar]\n0,1,2\n");
  EXPECT_EQ(table.columns[0].unit, "");
  EXPECT_EQ(table.columns[1].unit, "");
  EXPECT_EQ(table.columns[2].unit, "bar");
}

TEST(ReadRecordText, TakesEveryMarkOfNoNumberForNone) {
  const double nan = std::nan("");
  for (const std::string mark : {"", "nan", "NaN", "-nan", "inf", "-Inf", "+INF", "NA", "n/a",
                                 "#N/A", "null", "None", "-", "--", "---", "?", "*", "\"\""}) {
    const io::RecordTable table = read("t,x,y\n0,1,2\n1," + mark + ",3\n2,4," + mark + "\n");
    EXPECT_THAT(table.columns[1].values, ElementsAre(1.0, NanSensitiveDoubleEq(nan), 4.0)) << mark;
    EXPECT_THAT(table.columns[2].values, ElementsAre(2.0, 3.0, NanSensitiveDoubleEq(nan))) << mark;
  }
}

TEST(ReadRecordText, LeavesAnUnfinishedLastLineOutAndSaysSo) {
  for (const std::string end : {"2.0", "2.0,", "2.0,3", "2.0,3.", "2."}) {
    const io::RecordTable table = read("t,x\n0.0,1.25\n1.0,2.50\n" + end);
    EXPECT_THAT(table.columns[0].values, ElementsAre(0.0, 1.0)) << end;
    EXPECT_THAT(table.remarks, ElementsAre("the last line, sample 2, is unfinished: left out"))
        << end;
  }
  const io::RecordTable whole = read("t,x\n0.0,1.25\n1.0,2.50\n2.0,3.75");
  EXPECT_THAT(whole.columns[1].values, ElementsAre(1.25, 2.5, 3.75));
  EXPECT_THAT(whole.remarks, IsEmpty());
}

TEST(ReadRecordText, NamesLinesThatEndEarly) {
  const io::RecordTable table = read("t,x,y\n0,1,2\n1,2\n2,3,4\n3\n4,5,6\n");
  EXPECT_THAT(table.columns[2].values, ElementsAre(2.0, NanSensitiveDoubleEq(std::nan("")), 4.0,
                                                   NanSensitiveDoubleEq(std::nan("")), 6.0));
  EXPECT_THAT(table.remarks, ElementsAre("the line of sample 1 ends after 2 of 3 cells, and 1 more "
                                         "lines end early"));
}

TEST(ReadRecordText, GrowsBeyondItsFirstGuess) {
  // A first line much longer than the others.
  std::string text = "t,x\n0.00000000000000000000000000000000,1.0000000000000000000000000000000\n";
  for (int i = 1; i < 1000; ++i) text += std::to_string(i) + ",2\n";
  const io::RecordTable table = read(text);
  ASSERT_EQ(table.columns[0].values.size(), 1000U);
  EXPECT_EQ(table.columns[0].values.back(), 999.0);
}

TEST(ReadRecordText, RefusesWithThePlace) {
  EXPECT_EQ(refusal("t,x\n0,1\n1,abc\n"),
            "r.csv:3:3: expected a number, found 'abc' (a missing one is left empty, or nan, na, "
            "null or -; a comment begins with # or %)");
  EXPECT_THAT(refusal("t,x\r\n0,1\r\n1,1e\r\n"), HasSubstr("r.csv:3:3: expected a number"));
  EXPECT_THAT(refusal("t,x\n0,1\n1,1e999\n"),
              HasSubstr("r.csv:3:3: expected a number that fits double precision, found '1e999'"));
  EXPECT_EQ(refusal("t,x\n0,1\n1,2,3\n"),
            "r.csv:3:5: expected the line to end after 2 cells, as many as the header has, found "
            "one more");
  EXPECT_THAT(refusal("t;x\n0;1.5\n1;1,5\n"),
              HasSubstr("r.csv:3:3: expected a number, found '1,5'"));
  EXPECT_THAT(refusal("t,x\n0,abc\n1,2\n"), HasSubstr("r.csv:2:3: expected a number, found 'abc'"));
  EXPECT_THAT(
      refusal("0,1\n1,2\n"),
      HasSubstr("r.csv:1:1: expected a header such as 'time [s],tach [V]' above the numbers"));
  EXPECT_THAT(refusal("time\n0,1\n1,2\n"), HasSubstr("r.csv:1:1: expected a header of 2 to 4096"));
  EXPECT_THAT(refusal("time [s]\n0\n1\n"), HasSubstr("found no line of two or more numbers"));
  EXPECT_THAT(refusal("t,x\n"), HasSubstr("found no line of two or more numbers"));
  EXPECT_EQ(refusal("t,x,y,when\n0,1,2,12:00:01\n1,2,3,12:00:02\n"),
            "r.csv:2:7: expected a number, found '12:00:01' (columns of text, dates and times of "
            "day are not read: leave them out)");
  EXPECT_THAT(refusal("time tach\n0 1\n1 2\n"), HasSubstr("separated by comma, semicolon or tab"));
  EXPECT_THAT(refusal(std::string("t,x\n0,1\n\0", 9)), HasSubstr("found other bytes"));
  EXPECT_THAT(refusal("\xFF\xFEt"), HasSubstr("save as CSV in UTF-8"));
  std::string ragged = "t,x,y,z\n0,1,2,3\n";
  for (int i = 0; i < 200; ++i) ragged += "1\n";
  EXPECT_THAT(refusal(ragged), HasSubstr("expected 4 cells in each line, as in the header"));
  std::string wide = "t";
  for (int i = 0; i < 5000; ++i) wide += ",x";
  EXPECT_THAT(refusal(wide + "\n0,1\n"), HasSubstr("found 5001"));
}

TEST(ReadRecord, RefusesWhatIsNoRecorderFile) {
  const std::string folder = testing::TempDir();
  const auto refused = [&](const std::string& content) -> std::string {
    const std::string path = folder + "/refused_record";
    FILE* file = fopen(path.c_str(), "wb");
    fwrite(content.data(), 1, content.size(), file);
    fclose(file);
    try {
      io::read_record(path);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_THAT(refused(""), HasSubstr("expected a readable recorder file, found an empty one"));
  EXPECT_THAT(refused("\x1F\x8B compressed"), HasSubstr("a gzip file (unpack it"));
  EXPECT_THAT(refused("PK\x03\x04"), HasSubstr("a zip or spreadsheet file"));
  EXPECT_THAT(refused("\xD0\xCF\x11\xE0"), HasSubstr("a spreadsheet file"));
  EXPECT_THAT(reference::Call([&] { io::read_record(folder); }),
              testing::ThrowsMessage<InvalidInput>(HasSubstr("found a folder")));
  EXPECT_THAT(reference::Call([&] { io::read_record(folder + "/nobody"); }),
              testing::ThrowsMessage<InvalidInput>(HasSubstr("No such file")));
  EXPECT_EQ(refused("t,x\n0,1\n"), "taken");
  const io::RecordTable table = io::read_record(folder + "/refused_record");
  EXPECT_EQ(table.bytes, 8U);
  EXPECT_EQ(table.sha256, io::sha256_hex("t,x\n0,1\n"));
}

}  // namespace
}  // namespace boresight::io

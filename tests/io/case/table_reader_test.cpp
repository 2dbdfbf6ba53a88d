#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/io/case/table_reader.hpp>

namespace boresight::io {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

template <typename Read>
std::string refusal_of(Read read) {
  try {
    read();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

io::TableReader parse(std::string_view text) {
  return io::TableReader::parse(text, "case.toml");
}

std::string refused_quantity(std::string_view text, io::Kind kind, io::Range range = {}) {
  return refusal_of([&] { parse(text).quantity("x", kind, range); });
}

TEST(TableReader, ReadsAQuantityWrittenAsText) {
  const io::Quantity motor =
      parse("\n  x = \"0.22177 lbf.ft.s2\"").quantity("x", io::Kind::inertia);
  EXPECT_NEAR(motor.value, 0.300679746401455, 5e-16);
  EXPECT_NEAR(motor.half_unit, 0.000005 * 1.3558179483314004, 1e-20);
  EXPECT_DOUBLE_EQ(motor.standard_uncertainty, motor.half_unit / std::sqrt(3.0));
  EXPECT_FALSE(motor.uncertainty_given);
  EXPECT_EQ(motor.text, "0.22177 lbf.ft.s2");
  EXPECT_EQ(motor.kind, io::Kind::inertia);
  EXPECT_EQ(motor.basis, io::Basis::unstated);
  EXPECT_EQ(motor.key, "x");
  EXPECT_EQ(motor.location.file, "case.toml");
  EXPECT_EQ(motor.location.line, 2);
  EXPECT_EQ(motor.location.column, 7);
}

TEST(TableReader, ReadsAQuantityWrittenAsTable) {
  io::TableReader drive = parse(R"([drive.inertia]
value = "0.97 Hz"
uncertainty = "0.02 Hz"
also = ["6.09 rad/s", "58.2 rpm"]
basis = "measured"
source = "table 3"
uncertainty_source = "assumed: usual for a recorder"
)")
                              .table("drive");
  const io::Quantity frequency = drive.quantity("inertia", io::Kind::frequency);
  EXPECT_EQ(frequency.value, 0.97);
  EXPECT_EQ(frequency.standard_uncertainty, 0.02);
  EXPECT_TRUE(frequency.uncertainty_given);
  ASSERT_EQ(frequency.also.size(), 2U);
  EXPECT_NEAR(frequency.also[0].value, 0.969254, 1e-6);
  EXPECT_DOUBLE_EQ(frequency.also[1].value, 0.97);
  EXPECT_EQ(frequency.also[1].text, "58.2 rpm");
  EXPECT_EQ(frequency.basis, io::Basis::measured);
  EXPECT_EQ(frequency.source, "table 3");
  EXPECT_EQ(frequency.uncertainty_source, "assumed: usual for a recorder");
  EXPECT_EQ(frequency.key, "drive.inertia");
  EXPECT_EQ(frequency.location.line, 2);
  drive.finish();
}

TEST(TableReader, KnowsEveryBasisByItsName) {
  for (const io::Basis basis :
       {io::Basis::measured, io::Basis::published, io::Basis::inferred, io::Basis::assumed}) {
    const std::string text = "x = { value = \"1 m\", basis = \"" + std::string(to_string(basis)) +
                             "\", also = \"100 cm\" }";
    const io::Quantity length = parse(text).quantity("x", io::Kind::length);
    EXPECT_EQ(length.basis, basis);
    EXPECT_EQ(length.also.size(), 1U);
  }
  EXPECT_EQ(to_string(io::Basis::unstated), "unstated");
}

TEST(TableReader, TakesAnUncertaintyInPercentOfTheMagnitude) {
  EXPECT_DOUBLE_EQ(parse(R"(x = { value = "-40 N.m", uncertainty = "1 %" })")
                       .quantity("x", io::Kind::torque)
                       .standard_uncertainty,
                   0.4);
  EXPECT_DOUBLE_EQ(parse(R"(x = { value = "5 %", uncertainty = "1%" })")
                       .quantity("x", io::Kind::number)
                       .standard_uncertainty,
                   0.0005);
  EXPECT_DOUBLE_EQ(parse(R"(x = { value = "5 %", uncertainty = "0.01" })")
                       .quantity("x", io::Kind::number)
                       .standard_uncertainty,
                   0.01);
  EXPECT_DOUBLE_EQ(parse(R"(x = { value = 0.938, uncertainty = 0.01 })")
                       .quantity("x", io::Kind::number)
                       .standard_uncertainty,
                   0.01);
}

TEST(TableReader, RefusesUncertaintiesThatAreNone) {
  const std::vector<std::pair<std::string_view, std::string_view>> refused{
      {R"(x = { value = "4 N.m", uncertainty = "-1 N.m" })",
       "case.toml:1:38: x.uncertainty: expected an uncertainty of at least 0, found '-1 N.m'"},
      {R"(x = { value = "4 N.m", uncertainty = "-1 %" })",
       "case.toml:1:38: x.uncertainty: expected an uncertainty of at least 0, found '-1 %'"},
      {R"(x = { value = "4 N.m", uncertainty = "inf N.m" })", "a number must be finite"},
      {R"(x = { value = "4 N.m", uncertainty = "1 N" })", "found '1 N', a force"},
      {R"(x = { value = "4 N.m", uncertainty = 0.1 })", "which has no unit"},
      {R"(x = { value = "0 N.m", uncertainty = "1 %" })",
       "expected a torque (such as N.m, lbf.ft), found '1 %', relative to a value of 0"},
  };
  for (const auto& [text, message] : refused) {
    EXPECT_THAT(refused_quantity(text, io::Kind::torque), HasSubstr(message)) << text;
  }
}

TEST(TableReader, TakesBareNumbersOnlyWhereThereIsNoUnit) {
  const io::Quantity efficiency = parse("x = 0.9380 # printed so").quantity("x", io::Kind::number);
  EXPECT_EQ(efficiency.value, 0.938);
  EXPECT_DOUBLE_EQ(efficiency.half_unit, 0.00005);
  EXPECT_EQ(efficiency.text, "0.9380");
  EXPECT_EQ(parse("x = 1_000").quantity("x", io::Kind::number).value, 1000.0);
  EXPECT_EQ(parse("\xEF\xBB\xBFx = +2.5e3").quantity("x", io::Kind::number).value, 2500.0);
  EXPECT_EQ(parse("\"·é\".x=[{ y=-1.25 }]\r\n")
                .table("·é")
                .tables("x")
                .at(0)
                .quantity("y", io::Kind::number)
                .value,
            -1.25);
  EXPECT_EQ(refused_quantity("x = 0.970", io::Kind::frequency),
            "case.toml:1:5: x: expected a frequency (such as Hz, rad/s), found the number 0.970, "
            "which has no unit (write \"0.970 Hz\")");
  EXPECT_THAT(refused_quantity("x = nan", io::Kind::number), HasSubstr("a number must be finite"));
  EXPECT_THAT(refused_quantity("x = inf", io::Kind::number), HasSubstr("a number must be finite"));
  EXPECT_THAT(refused_quantity("x = 0x1F", io::Kind::number), HasSubstr("write a decimal number"));
}

TEST(TableReader, PointsAtTheTokenWithinAQuantity) {
  EXPECT_EQ(refused_quantity("x = \"5 kgg.m2\"", io::Kind::inertia),
            "case.toml:1:8: x: expected an inertia (such as kg.m2, lbf.ft.s2), found 'kgg' in '5 "
            "kgg.m2' (unknown unit, did you mean 'kg'?)");
  EXPECT_EQ(refused_quantity("x = '5 kg·mm2·mh'", io::Kind::inertia).substr(0, 17),
            "case.toml:1:15: x");
  // With an escape or three quotation marks the column in the file is that of the value.
  EXPECT_EQ(refused_quantity("x = \"5 kg\\u00b7mh\"", io::Kind::inertia).substr(0, 16),
            "case.toml:1:5: x");
  EXPECT_EQ(refused_quantity("x = \"\"\"5 kg mh\"\"\"", io::Kind::inertia).substr(0, 16),
            "case.toml:1:5: x");
}

TEST(TableReader, NamesTheMissingKeyAtTheHeaderOfItsTable) {
  io::TableReader line = std::move(parse("[oil]\n[[oil.line]]\n[[oil.line]]\n  lenght = \"3 m\"\n")
                                       .table("oil")
                                       .tables("line")
                                       .at(1));
  EXPECT_EQ(refusal_of([&] { line.quantity("volume", io::Kind::volume); }),
            "case.toml:3:1: oil.line[1].volume: expected a volume (such as L, in3), found nothing: "
            "key is missing");
  EXPECT_EQ(refusal_of([&] { line.quantity("length", io::Kind::length); }),
            "case.toml:3:1: oil.line[1].length: expected a length (such as m, in), found nothing: "
            "key is missing (is 'lenght' misspelt?)");
  EXPECT_EQ(refusal_of([] { parse("").quantity("inertia", io::Kind::inertia); }),
            "case.toml:1:1: inertia: expected an inertia (such as kg.m2, lbf.ft.s2), found "
            "nothing: key is missing");
  EXPECT_THAT(
      refused_quantity("x = { basis = \"measured\" }", io::Kind::mass),
      HasSubstr("case.toml:1:5: x.value: expected a mass (such as kg, lbm), found nothing"));
}

TEST(TableReader, StatesTheRangeWithItsUnit) {
  EXPECT_EQ(refused_quantity("x = \"-5 lbf.ft.s2\"", io::Kind::inertia, io::Range::positive()),
            "case.toml:1:5: x: expected an inertia above 0 kg.m2, found '-5 lbf.ft.s2', which is "
            "-6.77909 kg.m2");
  EXPECT_EQ(refused_quantity("x = \"0 kg.m2\"", io::Kind::inertia, io::Range::positive()),
            "case.toml:1:5: x: expected an inertia above 0 kg.m2, found '0 kg.m2'");
  EXPECT_THAT(refused_quantity("x = \"-1 m\"", io::Kind::length, io::Range::not_negative()),
              HasSubstr("expected a length at least 0 m, found '-1 m'"));
  EXPECT_THAT(refused_quantity("x = \"30 Hz\"", io::Kind::frequency, io::Range::between(0.0, 25.0)),
              HasSubstr("expected a frequency from 0 Hz to 25 Hz, found '30 Hz'"));
  EXPECT_THAT(refused_quantity("x = \"30 Hz\"", io::Kind::frequency, io::Range::positive(25.0)),
              HasSubstr("above 0 Hz and at most 25 Hz"));
  EXPECT_THAT(refused_quantity("x = \"110 %\"", io::Kind::number, io::Range::between(0.0, 1.0)),
              EndsWith("expected a number from 0 to 1, found '110 %', which is 1.1"));
  EXPECT_THAT(refused_quantity("x = { value = 7 }", io::Kind::number, {-1e300, 5.0, false}),
              EndsWith("1:15: x.value: expected a number at most 5, found '7'"));
  EXPECT_EQ(parse("x = \"0 m\"").quantity("x", io::Kind::length, io::Range::not_negative()).value,
            0.0);
}

TEST(TableReader, SaysWhatStandsInsteadOfTheExpected) {
  const std::vector<std::pair<std::string_view, std::string_view>> found{
      {"x = true", "found true"},
      {"x = [1]", "found a list"},
      {"x = []", "found an empty list"},
      {"x = 2024-01-01", "found a date or time"},
      {"x = { value = { value = \"1 m\" } }",
       "x.value: expected a length (such as m, in), found a table"},
      {"x = \"3 kg\"", "found '3 kg', a mass"},
      {"x = { value = \"3 m\", also = [\"3 kg\"] }", "1:33: x.also[0]: expected a length"},
      {"x = { value = \"3 m\", bassis = \"measured\" }",
       "1:22: x.bassis: expected one of the keys 'also', 'basis', 'source', 'uncertainty', "
       "'uncertainty_source', 'value', found an unknown key (did you mean 'basis'?)"},
      {"x = { value = \"3 m\", basis = \"mesured\" }",
       "1:30: x.basis: expected one of 'measured', 'published', 'inferred', 'assumed', found "
       "'mesured' (did you mean 'measured'?)"},
      {"x = { value = \"3 m\", source = 3 }",
       "x.source: expected a text, found the integer 3 (a text stands in quotes)"},
  };
  for (const auto& [text, message] : found) {
    EXPECT_THAT(refused_quantity(text, io::Kind::length), HasSubstr(message)) << text;
  }
}

TEST(TableReader, ReadsPlainValues) {
  io::TableReader table =
      parse("name = \"antenna\"\nteeth = 17\nopen = true\nlist = [\"a\", \"b\"]\n");
  EXPECT_EQ(table.text("name"), "antenna");
  EXPECT_EQ(table.integer("teeth", 1, 100), 17);
  EXPECT_TRUE(table.boolean("open"));
  EXPECT_THAT(table.texts("list"), ElementsAre("a", "b"));
  EXPECT_EQ(table.optional_text("absent"), std::nullopt);
  EXPECT_EQ(table.optional_integer("absent", 0, 1), std::nullopt);
  EXPECT_EQ(table.optional_boolean("absent"), std::nullopt);
  EXPECT_EQ(table.optional_quantity("absent", io::Kind::mass), std::nullopt);
  EXPECT_FALSE(table.optional_table("absent").has_value());
  EXPECT_TRUE(table.tables("absent").empty());
  EXPECT_EQ(table.optional_text("name"), "antenna");
  EXPECT_EQ(table.optional_integer("teeth", 1, 100), 17);
  EXPECT_EQ(table.optional_boolean("open"), true);
  EXPECT_NO_THROW(table.finish());
}

TEST(TableReader, RefusesPlainValuesOfTheWrongType) {
  constexpr long all = std::numeric_limits<long>::max();
  io::TableReader table = parse("a = 1\nb = \"x\"\nc = [1]\nd = 2.0\n[e]\n[[f]]\n");
  const std::vector<std::pair<std::string, std::string>> messages{
      {refusal_of([&] { table.text("a"); }),
       "case.toml:1:5: a: expected a text, found the integer 1 (a text stands in quotes)"},
      {refusal_of([&] { table.integer("b", 0, 9); }),
       "case.toml:2:5: b: expected an integer from 0 to 9, found 'x'"},
      {refusal_of([&] { table.integer("a", 2, 9); }),
       "case.toml:1:5: a: expected an integer from 2 to 9, found the integer 1"},
      {refusal_of([&] { table.integer("a", 2, all); }),
       "case.toml:1:5: a: expected an integer at least 2, found the integer 1"},
      {refusal_of([&] { table.integer("d", -all - 1, all); }),
       "case.toml:4:5: d: expected an integer, found the number 2.0"},
      {refusal_of([&] { table.boolean("a"); }),
       "case.toml:1:5: a: expected true or false, found the integer 1"},
      {refusal_of([&] { table.texts("c"); }),
       "case.toml:3:6: c[0]: expected a text, found the integer 1 (a text stands in quotes)"},
      {refusal_of([&] { table.texts("b"); }),
       "case.toml:2:5: b: expected a list of texts, found 'x' (a list stands in brackets)"},
      {refusal_of([&] { table.table("f"); }),
       "case.toml:6:1: f: expected a table, found a list (write [f] once)"},
      {refusal_of([&] { table.optional_table("a"); }),
       "case.toml:1:5: a: expected a table, found the integer 1 (write [a] once)"},
      {refusal_of([&] { table.tables("e"); }),
       "case.toml:5:1: e: expected a list of tables [[e]], found a table"},
      {refusal_of([&] { table.tables("c"); }),
       "case.toml:3:6: c[0]: expected a table, found the integer 1"},
      {refusal_of([&] { table.tables("g", true); }),
       "case.toml:1:1: g: expected a list of tables [[g]], found nothing: key is missing"},
      {refusal_of([&] { parse("g = []").tables("g", true); }),
       "case.toml:1:5: g: expected a list of tables [[g]], found an empty list"},
      {refusal_of([&] {
         table.choice("b", {"pump", "valve"});
       }),
       "case.toml:2:5: b: expected one of 'pump', 'valve', found 'x'"},
      {refusal_of([&] {
         table.choice("a", {"pump", "valve"});
       }),
       "case.toml:1:5: a: expected one of 'pump', 'valve', found the integer 1"},
      {refusal_of([&] {
         parse("b = \"Pumpe\"").choice("b", {"pump", "valve"});
       }),
       "case.toml:1:5: b: expected one of 'pump', 'valve', found 'Pumpe' (did you mean 'pump'?)"},
      {refusal_of([&] {
         table.choice("h", {"pump", "valve"});
       }),
       "case.toml:1:1: h: expected one of 'pump', 'valve', found nothing: key is missing"},
  };
  for (const auto& [found, expected] : messages) {
    EXPECT_EQ(found, expected);
  }
  EXPECT_EQ(parse("b = \"valve\"").choice("b", {"pump", "valve"}), "valve");
}

TEST(TableReader, RefusesKeysNobodyReads) {
  io::TableReader table = parse("mass = \"1 kg\"\nwidht = 3\n[zone]\na = 1\n[dish]\nb = 2\n");
  table.quantity("mass", io::Kind::mass);
  table.optional_quantity("width", io::Kind::length);
  EXPECT_EQ(refusal_of([&] { table.finish(); }),
            "case.toml:2:1: widht: expected one of the keys 'mass', 'width', found an unknown key "
            "(did you mean 'width'?)");
}

TEST(TableReader, RefusesTablesNobodyOpens) {
  io::TableReader table = parse("[zone]\na = 1\n[dish]\nb = 2\n[[gear]]\n");
  io::TableReader dish = table.table("dish");
  EXPECT_EQ(refusal_of([&] { table.finish(); }),
            "case.toml:1:2: zone: expected one of the keys 'dish', found an unknown key");
  EXPECT_EQ(refusal_of([&] { dish.finish(); }),
            "case.toml:4:1: dish.b: expected no key here, found an unknown key");
  table.table("zone");
  EXPECT_EQ(refusal_of([&] { table.finish(); }),
            "case.toml:5:3: gear: expected one of the keys 'dish', 'zone', found an unknown key");
}

TEST(TableReader, KnowsPlacesAndPaths) {
  io::TableReader root = parse("[oil]\n\"a.b\" = 1\nc = 2\n");
  io::TableReader oil = root.table("oil");
  EXPECT_TRUE(oil.has("c"));
  EXPECT_FALSE(oil.has("d"));
  EXPECT_EQ(root.path(), "");
  EXPECT_EQ(oil.path(), "oil");
  EXPECT_EQ(oil.path("c"), "oil.c");
  EXPECT_EQ(oil.path("a.b"), "oil.'a.b'");
  EXPECT_EQ(oil.location("c").line, 3);
  EXPECT_EQ(oil.location("c").column, 5);
  EXPECT_EQ(oil.location("d").line, 1);
  EXPECT_EQ(oil.location().line, 1);
  EXPECT_EQ(refusal_of([&] { oil.refuse("c", "expected less than d, found 2"); }),
            "case.toml:3:5: oil.c: expected less than d, found 2");
  EXPECT_EQ(refusal_of([&] { root.refuse("", "expected oil or gas, found both"); }),
            "case.toml:1:1: expected oil or gas, found both");
}

TEST(TableReader, OutlivesTheReaderItCameFrom) {
  io::TableReader line = parse("[oil.line]\nlength = \"3 m\"").table("oil").table("line");
  io::TableReader moved = parse("");
  moved = std::move(line);
  EXPECT_EQ(moved.quantity("length", io::Kind::length).value, 3.0);
}

TEST(TableReader, LocatesSyntaxErrors) {
  const std::vector<std::pair<std::string_view, std::string_view>> places{
      {"a = 1\nb = 1,5\n", "case.toml:2:6: expected valid TOML, found a syntax error ("},
      {"a = \"x\nb = 1", "case.toml:1:7: expected valid TOML, found a syntax error ("},
      {"a = 1\na = 2", "cannot redefine existing integer 'a'"},
      {"a = 0.2.2", "expected decimal digit or exponent, saw '.'"},
      {"a = \xff", "case.toml:1:"},
      {"a = 1\nLänge = 1", "case.toml:2:2: expected valid TOML"},
      {"ä = 1", "case.toml:1:1: expected valid TOML"},
      {"[[\n#", "case.toml:1:3: expected valid TOML"},
      {"[[[a]]]", "case.toml:1:3: expected valid TOML"},
  };
  for (const auto& [text, message] : places) {
    EXPECT_THAT(refusal_of([text = text] { parse(text); }), HasSubstr(message)) << text;
  }
}

TEST(TableReader, ReadsLettersBeyondAsciiWhereverTextMayStand) {
  io::TableReader table = parse("a = \"\"\"\\\n§ 5 ä\"\"\" # ä\n'Länge' = 'ä'\n");
  EXPECT_EQ(table.text("a"), "§ 5 ä");
  EXPECT_EQ(table.text("Länge"), "ä");
}

TEST(TableReader, OpensFiles) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "boresight_table_reader";
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "case.toml").string();
  std::ofstream(file) << "mass = \"2 kg\"\n";
  EXPECT_EQ(io::TableReader::open(file).quantity("mass", io::Kind::mass).value, 2.0);
  EXPECT_EQ(io::TableReader::open(file).location("mass").file, file);
  std::filesystem::remove(file);
  EXPECT_EQ(refusal_of([&] { io::TableReader::open(file); }),
            file + ": expected a readable file, found none (No such file or directory)");
  EXPECT_EQ(refusal_of([&] { io::TableReader::open(folder.string()); }),
            folder.string() + ": expected a readable file, found a folder");
  std::filesystem::remove(folder);
}

}  // namespace
}  // namespace boresight::io

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/every_kind.hpp"
#include <boresight/io/case/table_reader.hpp>
#include <boresight/io/units/units.hpp>

namespace boresight::io {
namespace {

using testing::HasSubstr;

/// Texts that come near the grammar reach deeper than random bytes alone.
std::string random_text(std::mt19937_64& random) {
  constexpr std::array<std::string_view, 36> pieces{
      "lbf", "ft", "s2", "N",   "m",   "rad", "rev", "deg", "US_gal", "gal", "lb",   "%",
      "1",   "-1", "²",  "⁻",   "·",   "µ",   ".",   "*",   "/",      "(",   ")",    "^",
      " ",   "-",  "5",  "0.5", "1,5", "e9",  "e",   "inf", "GPa9",   "x",   "\xc2", "\xe2\x81"};
  std::string text;
  const std::size_t length = random() % 12;
  for (std::size_t i = 0; i < length; ++i) {
    if (random() % 8 == 0) {
      text += static_cast<char>(random() % 256);
    } else {
      text += pieces[random() % pieces.size()];
    }
  }
  return text;
}

TEST(ParseUnit, SurvivesRandomBytes) {
  std::mt19937_64 random(1);
  int accepted = 0;
  for (int round = 0; round < 40000; ++round) {
    const std::string text = random_text(random);
    try {
      const io::Unit unit = io::parse_unit(text);
      ++accepted;
      EXPECT_TRUE(std::isfinite(unit.factor) && unit.factor > 0.0) << text;
    } catch (const io::UnitError& error) {
      EXPECT_GE(error.column, 1) << text;
      EXPECT_LE(error.column, static_cast<int>(text.size()) + 1) << text;
    }
  }
  EXPECT_GT(accepted, 500);
}

TEST(ParseQuantity, SurvivesRandomBytes) {
  const std::vector<io::Kind> kinds = every_kind();
  std::mt19937_64 random(2);
  int accepted = 0;
  for (int round = 0; round < 40000; ++round) {
    const std::string text = (random() % 2 == 0 ? "1.5 " : "") + random_text(random);
    const io::Kind kind = kinds[random() % kinds.size()];
    try {
      const io::PrintedNumber number = io::parse_quantity(text, kind);
      ++accepted;
      EXPECT_TRUE(std::isfinite(number.value) && std::isfinite(number.half_unit)) << text;
    } catch (const io::UnitError& error) {
      EXPECT_GE(error.column, 1) << text;
      EXPECT_LE(error.column, static_cast<int>(text.size()) + 1) << text;
    }
  }
  EXPECT_GT(accepted, 50);
}

/// Files made of pieces that come near the grammar.
std::string random_file(std::mt19937_64& random) {
  constexpr std::array<std::string_view, 44> pieces{"x",
                                                    "y",
                                                    "value",
                                                    "uncertainty",
                                                    "also",
                                                    "basis",
                                                    " = ",
                                                    "=",
                                                    "\n",
                                                    "\n",
                                                    "\n",
                                                    "[",
                                                    "]",
                                                    "[[",
                                                    "]]",
                                                    "{",
                                                    "}",
                                                    ",",
                                                    ".",
                                                    "\"1 m\"",
                                                    "'2 m'",
                                                    "\"\"\"3 m",
                                                    "\"\"\"",
                                                    "\"",
                                                    "'",
                                                    "#",
                                                    "1",
                                                    "-2.50",
                                                    "1_0",
                                                    "nan",
                                                    "true",
                                                    "0x1F",
                                                    "\\u00b7",
                                                    "\xEF\xBB\xBF",
                                                    "é",
                                                    "\r\n",
                                                    "x = 1\n",
                                                    "x = \"1 m\"\n",
                                                    "[x]\n",
                                                    "[[x]]\n",
                                                    "value = \"3 m\"\n",
                                                    "2024-01-01",
                                                    "x = { value = \"1 m\" }\n",
                                                    "y = [ 1.0, 'a' ]\n"};
  std::string text;
  const std::size_t length = random() % 16;
  for (std::size_t i = 0; i < length; ++i) {
    if (random() % 12 == 0) {
      text += static_cast<char>(random() % 256);
    } else {
      text += pieces[random() % pieces.size()];
    }
  }
  return text;
}

/// Everything a caller may ask of a table; what it refuses must be an InvalidInput.
int read_all(io::TableReader& table, int depth) {
  int read = 0;
  const auto attempt = [&read](const auto& ask) {
    try {
      ask();
      ++read;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr("expected "));
    }
  };
  for (const std::string_view key : {"x", "y", "value"}) {
    attempt([&] { table.quantity(key, io::Kind::length, io::Range::positive()); });
    attempt([&] { table.quantity(key, io::Kind::number); });
    attempt([&] { table.text(key); });
    attempt([&] { table.texts(key); });
    attempt([&] { table.integer(key, -5, 5); });
    attempt([&] { table.boolean(key); });
    attempt([&] { table.choice(key, {"1 m", "2 m"}); });
    if (depth < 3) {
      attempt([&] {
        io::TableReader inner = table.table(key);
        read += read_all(inner, depth + 1);
      });
      attempt([&] {
        for (io::TableReader& inner : table.tables(key, true)) {
          read += read_all(inner, depth + 1);
        }
      });
    }
  }
  attempt([&] { table.finish(); });
  return read;
}

TEST(TableReader, SurvivesRandomFiles) {
  std::mt19937_64 random(3);
  int parsed = 0;
  int read = 0;
  for (int round = 0; round < 40000; ++round) {
    const std::string text = random_file(random);
    try {
      io::TableReader table = io::TableReader::parse(text, "case.toml");
      ++parsed;
      read += read_all(table, 0);
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr(": expected valid TOML, found a syntax error ("));
    }
  }
  EXPECT_GT(parsed, 2000);
  EXPECT_GT(read, 2000);
}

}  // namespace
}  // namespace boresight::io

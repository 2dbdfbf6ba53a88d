#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boresight/io/code/c_code.hpp>
#include <boresight/io/code/octave_code.hpp>
#include <boresight/io/code/structured_text.hpp>

namespace boresight::io {
namespace {

using control::program::Builder;
using control::program::Expression;
using control::program::Precision;
using control::program::Program;
using control::program::Type;
using testing::HasSubstr;

// Operations that a language groups otherwise than they are meant.
Program grouped() {
  Builder builder("grouping", 0.01);
  const Expression a = builder.input("one", Type::real, "V", "first input");
  const Expression b = builder.input("two", Type::real, "", "");
  const Expression w = builder.input("angle", Type::wide, "deg", "");
  const Expression result = builder.output("result", Type::real, "", "");
  builder.remark("Grouping.");
  builder.assign(result, a - (b - a));
  builder.assign(result, (a + b) * (a - b) / (a * b));
  builder.assign(result, -(a * b) + control::program::to_real(w));
  builder.begin_if(complement(both(a < b, b < control::program::constant(0.1))));
  builder.assign(result, smaller(a, control::program::absolute(b)));
  builder.end_if();
  return builder.finish();
}

TEST(CodeWriter, GroupsInC) {
  const auto code = c_code(grouped(), Precision::single_precision)[1].content;
  EXPECT_THAT(code, HasSubstr("outputs->result = inputs->one - (inputs->two - inputs->one);"));
  EXPECT_THAT(
      code,
      HasSubstr("= (inputs->one + inputs->two) * (inputs->one - inputs->two) / (inputs->one *\n"
                "      inputs->two);"));
  EXPECT_THAT(code, HasSubstr("= -(inputs->one * inputs->two) + (servo_real)(inputs->angle);"));
  EXPECT_THAT(code, HasSubstr("if (!(inputs->one < inputs->two && (inputs->two < 0.1f)))"));
  EXPECT_THAT(code, HasSubstr("smaller_real(inputs->one, fabsf(inputs->two))"));
}

TEST(CodeWriter, GroupsInStructuredText) {
  const auto code = structured_text(grouped(), Precision::single_precision).content;
  EXPECT_THAT(code, HasSubstr("result := one - (two - one);"));
  EXPECT_THAT(code, HasSubstr("result := -(one * two) + LREAL_TO_REAL(angle);"));
  EXPECT_THAT(code, HasSubstr("IF NOT (one < two AND (two < REAL#0.1)) THEN"));
  EXPECT_THAT(code, HasSubstr("one : REAL; (* V: first input *)"));
}

TEST(CodeWriter, GroupsInOctave) {
  const auto code = octave_code(grouped())[0].content;
  EXPECT_THAT(code, HasSubstr("outputs.result = inputs.one - (inputs.two - inputs.one);"));
  EXPECT_THAT(code,
              HasSubstr("if ~(inputs.one < inputs.two && (inputs.two < 0.10000000000000001))"));
}

TEST(RealLiteral, HasAPointAndAllDigits) {
  EXPECT_EQ(real_literal(3.0, false), "3.0");
  EXPECT_EQ(real_literal(1e-9, false), "1.0000000000000001e-09");
  EXPECT_EQ(real_literal(1e30, true), "1.0e+30");
  EXPECT_EQ(real_literal(0.1, true), "0.1");
  EXPECT_EQ(real_literal(1.0 / 3.0, true), "0.333333333");
}

}  // namespace
}  // namespace boresight::io

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include <boresight/control/program/interpreter.hpp>
#include <boresight/control/program/program.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control::program {
namespace {

TEST(Program, KeepsOnlyWhatIsRead) {
  Builder builder("test", 0.1);
  const Expression input = builder.input("signal", Type::real, "", "");
  const Expression used = builder.parameter("used", Type::real, 2.0, "", "");
  builder.parameter("unused", Type::real, 3.0, "", "");
  const Expression first = builder.assigned("first", input * used, "", "");
  // Read only by a local that nothing reads.
  const Expression only = builder.assigned("only", input + used, "", "");
  builder.assigned("last", only, "", "");
  const Expression output = builder.output("result", Type::real, "", "");
  builder.assign(output, first);
  const Program program = builder.finish();
  ASSERT_EQ(program.variables.size(), 4U);
  EXPECT_EQ(program.step.size(), 2U);
  EXPECT_EQ(operation_count(program), 1U);
  Interpreter interpreter(program);
  interpreter.set("signal", 5.0);
  interpreter.step();
  EXPECT_EQ(interpreter.get("result"), 10.0);
  EXPECT_THROW(variable_index(program, "only"), InvalidInput);
}

TEST(Program, RefusesTypesThatDoNotFit) {
  Builder builder("test", 0.1);
  const Expression real = builder.input("real_signal", Type::real, "", "");
  const Expression wide = builder.input("wide_signal", Type::wide, "", "");
  const Expression state = builder.state("kept", Type::real, "", "");
  EXPECT_THROW(real + wide, std::logic_error);
  EXPECT_THROW(truncated(real), std::logic_error);
  EXPECT_THROW(builder.assign(state, wide), std::logic_error);
  EXPECT_THROW(builder.assign(real, real), std::logic_error) << "an input";
  EXPECT_THROW(builder.begin_if(real), std::logic_error);
  EXPECT_THROW(builder.state("kept", Type::real, "", ""), std::logic_error);
  builder.begin_if(real < state);
  EXPECT_THROW(builder.finish(), std::logic_error);
}

// (a + b) + c of the precision, a condition, and what a state keeps.
TEST(Interpreter, RoundsEveryOperationToItsPrecision) {
  Builder builder("test", 0.1);
  const Expression a = builder.input("first", Type::real, "", "");
  const Expression w = builder.input("angle", Type::wide, "", "");
  const Expression sum = builder.output("sum", Type::real, "", "");
  const Expression turns = builder.output("turns", Type::wide, "", "");
  const Expression total = builder.state("total", Type::real, "", "");
  builder.assign(sum, a * constant(0.1) + constant(0.2));
  builder.assign(turns, truncated(w / constant(3.0, Type::wide)));
  builder.begin_if(a < constant(0.0));
  builder.assign(total, exponential(a));
  builder.otherwise();
  builder.assign(total, total + to_real(w));
  builder.end_if();
  const Program program = builder.finish();
  Interpreter wide(program), single(program, Precision::single_precision);
  for (Interpreter* one : {&wide, &single}) {
    one->set("first", 0.3);
    one->set("angle", -7.7);
    one->step();
    one->step();
    EXPECT_EQ(one->get("turns"), -2.0);
  }
  EXPECT_EQ(wide.get("sum"), 0.3 * 0.1 + 0.2);
  EXPECT_EQ(single.get("sum"), static_cast<double>(0.3F * 0.1F + 0.2F));
  EXPECT_EQ(wide.get("total"), -7.7 - 7.7);
  EXPECT_EQ(single.get("total"), static_cast<double>(-7.7F - 7.7F));
  single.set("first", -0.5);
  single.step();
  EXPECT_EQ(single.get("total"), static_cast<double>(std::exp(-0.5F)));
  // False with a NaN: the other branch.
  wide.set("first", std::numeric_limits<double>::quiet_NaN());
  wide.step();
  EXPECT_EQ(wide.get("total"), -7.7 - 7.7 - 7.7);
  wide.restart();
  EXPECT_EQ(wide.get("total"), 0.0);
}

}  // namespace
}  // namespace boresight::control::program

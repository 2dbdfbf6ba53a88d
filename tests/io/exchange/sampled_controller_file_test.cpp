#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lag_loops.hpp"
#include "refused_call.hpp"
#include "scratch_folder.hpp"
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/io/exchange/sampled_controller_file.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double sample_time = 0.02;

control::Controller leaky() {
  return reference::lag_loops();
}

class SampledControllerFileTest : public testing::Test {
 protected:
  SampledControllerFile read(const plant::StateSpace& system) const {
    write_controller(path(), system);
    return read_sampled_controller(path(), 1.0, sample_time);
  }
  std::string path() const { return folder_.file("k.json"); }
  void refused(const plant::StateSpace& system, const char* why) const {
    EXPECT_THAT(reference::Call([&] { read(system); }),
                testing::ThrowsMessage<InvalidInput>(
                    testing::AllOf(HasSubstr("k.json: expected"), HasSubstr(why))));
  }

 private:
  ScratchFolder folder_;
};

TEST_F(SampledControllerFileTest, TakesASampledStateSpaceAsItIs) {
  const auto sampled = plant::subsystem(control::sampled_controller(leaky(), sample_time),
                                        {"tachometer", "encoder"}, {"valve_demand"});
  const auto file = read(sampled);
  EXPECT_THAT(file.remarks, IsEmpty());
  EXPECT_EQ(file.controller.structure.name(), "state space, order 2");
  const plant::StateSpace& found = *file.controller.structure.state_space();
  EXPECT_EQ(found.a, sampled.a);
  EXPECT_EQ(found.b, sampled.b);
  EXPECT_EQ(found.c, sampled.c);
  EXPECT_EQ(found.d, sampled.d);
}

// The ports of the rate command rest at 0.
TEST_F(SampledControllerFileTest, SamplesAContinuousOneByTustin) {
  const auto file = read(control::to_state_space(leaky()));
  EXPECT_THAT(file.remarks, ElementsAre("the continuous controller is sampled every 0.02 s by "
                                        "Tustin's method"));
  const plant::StateSpace& found = *file.controller.structure.state_space();
  EXPECT_THAT(found.inputs, ElementsAre("tachometer", "encoder"));
  const auto continuous = plant::subsystem(control::to_state_space(leaky()),
                                           {"tachometer", "encoder"}, {"valve_demand"});
  const double w = 2.0;
  const std::complex<double> s{0.0, 2.0 / sample_time * std::tan(0.5 * w * sample_time)};
  const Eigen::MatrixXcd response = plant::frequency_response(found, w);
  const Eigen::MatrixXcd expected = plant::frequency_response(continuous, s.imag());
  EXPECT_LT((response - expected).norm(), 1e-10 * expected.norm());
}

TEST_F(SampledControllerFileTest, RefusesWhatTheAntennasComputerCannotRun) {
  auto sampled = plant::subsystem(control::sampled_controller(leaky(), sample_time),
                                  {"tachometer", "encoder"}, {"valve_demand"});
  refused(plant::subsystem(sampled, {"encoder"}, {"valve_demand"}),
          "reads tachometer and encoder, found one that reads encoder");
  sampled.sample_time = 0.01;
  refused(sampled, "0.02 s ([controller] delay over 1.5), found 0.01 s");
  refused(
      control::to_state_space({control::LoopStructure::pi_with_lag(), {0.2, 0.8, 6.0, 0.2, 0.02}}),
      "stable by itself, found a pole of magnitude 1");
}

}  // namespace
}  // namespace boresight::io

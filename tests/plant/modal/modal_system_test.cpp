#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "peer_family.hpp"
#include "random_numbers.hpp"
#include "refused_call.hpp"
#include <boresight/numerics/error.hpp>
#include <boresight/plant/modal/modal_system.hpp>

namespace boresight::plant {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(ModalSystem, OfThePeersAntennaIsTheirStateSpace) {
  for (const int modes : {1, 5, 20}) {
    const auto dense = reference::peer_closed_loop(modes);
    const auto built = to_state_space(reference::peer_modal_system(modes));
    EXPECT_EQ(built.a.rows(), dense.a.rows());
    for (const double w : {0.02, 0.9, 6.0, 11.0, 90.0, 400.0}) {
      const Eigen::MatrixXcd expected = frequency_response(dense, w);
      const Eigen::MatrixXcd found = frequency_response(built, w);
      for (Eigen::Index o = 0; o < 2; ++o) {
        for (Eigen::Index i = 0; i < 3; ++i) {
          EXPECT_LT(std::abs(found(o, i) - expected(o, i)), 1e-11 * expected.row(o).norm());
        }
      }
    }
  }
}

TEST(ModalSystem, WithoutModesIsTheDenseOne) {
  const auto dense = reference::peer_closed_loop(3);
  const auto same = to_state_space(without_modes(dense));
  EXPECT_EQ(same.a, dense.a);
  EXPECT_EQ(same.b, dense.b);
  EXPECT_EQ(same.c, dense.c);
  EXPECT_EQ(same.inputs, dense.inputs);
}

TEST(ModalSystem, NamesEachDefect) {
  const auto refuse = [](auto change, const char* message) {
    auto system = reference::peer_modal_system(3);
    change(system);
    EXPECT_THAT(reference::Call([&] { validate(system); }),
                ThrowsMessage<InvalidInput>(HasSubstr(message)));
  };
  refuse([](ModalSystem& s) { s.modes.frequency[1] = -2.0; },
         "expected mode 2 at 0 rad/s or above, found -2 rad/s");
  refuse([](ModalSystem& s) { s.modes.damping_ratio[2] = std::nan(""); },
         "expected mode 3 with a damping ratio of 0 or above, found nan");
  refuse(
      [](ModalSystem& s) { s.modes.force_shape(0, 0) = std::numeric_limits<double>::infinity(); },
      "a mode shape has elements that are not finite");
  refuse([](ModalSystem& s) { s.modes.force_shape.conservativeResize(2, 2); },
         "expected the force shapes as 3 x 2, found 2 x 2");
  refuse([](ModalSystem& s) { s.modes.rates.pop_back(); },
         "expected the rates' names as 2 x 1, found 1 x 1");
  refuse([](ModalSystem& s) { s.modes.forces[0] = "torque"; }, "found 'torque'");
  refuse([](ModalSystem& s) { s.modes.displacements[1] = ""; },
         "expected the core's input 'beam bend' to be fed once, found nothing feeding it");
  refuse([](ModalSystem& s) { s.modes.displacements[1] = "motor bend"; },
         "expected the core's input 'beam bend' to be fed once");
  refuse([](ModalSystem& s) { s.inputs.push_back("motor bend rate"); },
         "expected the core's input 'motor bend rate' to be fed once, found 2 things feeding it");
  refuse([](ModalSystem& s) { s.core.sample_time = 0.02; }, "expected a continuous core");
  refuse(
      [](ModalSystem& s) {
        s.inputs.pop_back();
        s.dead_times.push_back({"u", "d", -0.1});
      },
      "expected a dead time from 'u' to 'd' of 0 s or more, found -0.1 s");
}

TEST(ModalSystem, WithADeadTimeHasNoStateSpace) {
  auto system = reference::peer_modal_system(3);
  system.inputs.pop_back();
  system.dead_times.push_back({"u", "d", 0.01});
  EXPECT_THAT(reference::Call([&] { to_state_space(system); }),
              ThrowsMessage<InvalidInput>(HasSubstr("the dead time from 'u' to 'd'")));
}

}  // namespace
}  // namespace boresight::plant

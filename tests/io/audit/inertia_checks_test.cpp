// What an audit holds measured inertias against.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/audit/failed_checks.hpp"
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/case_statements.hpp>
#include <boresight/io/case/case_structure.hpp>
#include <boresight/io/case/case_tests.hpp>

namespace boresight::io {
namespace {

using testing::Each;
using testing::Field;
using testing::IsEmpty;
using testing::Ne;

const Checks& remainders() {
  static const Checks found = failed(read_case(case_path("dss14-70m")), "inertia_remainder");
  return found;
}

TEST(InertiaRemainder, IsAtLeastHalfOfTheAntennas) {
  ASSERT_FALSE(remainders().empty());
  EXPECT_EQ(remainders()[0].quantity, "resonance.reflected_inertia");
  EXPECT_EQ(remainders()[0].explanation, "recomputed");
  for (const auto& check : remainders()) {
    EXPECT_NEAR(check.number("remainder").lower, 0.5 * 0.397, 1e-3);
    EXPECT_LT(check.number("remainder").value, check.number("remainder").lower);
    EXPECT_NEAR(check.number("remainder").value,
                check.number("inertia").value - check.number("motors").value -
                    check.number("gear train").value,
                1e-12);
  }
  EXPECT_LT(remainders()[0].number("remainder").value, 0.0);
  EXPECT_THAT(remainders(), Each(Field(&design::PhysicalCheck::quantity,
                                       Ne("impulse.constant-speed.reflected_inertia"))));
}

// The motors and the gear train alone ring on the oil: that is no antenna without inertia.
TEST(InertiaRemainder, IsNoneOfAResonanceOfTheOilAlone) {
  Case antenna = read_case(case_path("dss14-70m"));
  std::erase_if(antenna.stated, [](const StatedEntry& entry) {
    return entry.quantity == "resonance.reflected_inertia";
  });
  antenna.impulse_results.clear();
  antenna.structure->locked_rotor_frequency.value = 0.2;
  const auto modes = plant::plant_modes(make_plant(antenna));
  antenna.resonance->frequency->value = plant::mode_of_oil(modes).frequency;
  antenna.resonance->of_oil = true;
  EXPECT_THAT(failed(antenna, "inertia_remainder"), IsEmpty());
  antenna.structure->locked_rotor_frequency.value = 2.0;
  antenna.resonance->of_oil = false;
  EXPECT_FALSE(failed(antenna, "inertia_remainder").empty());
}

TEST(ImpulseOrder, GivesLessInertiaWithMoreFriction) {
  Case antenna = read_case(case_path("dss14-70m"));
  const auto found = failed(antenna, "impulse_order");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].quantity, "impulse.constant-speed.reflected_inertia");
  EXPECT_NEAR(found[0].number("friction difference").value, 69.49 - 19.77, 1e-9);
  EXPECT_NEAR(
      found[0].number("deceleration it would take").value,
      found[0].number("friction difference").value / found[0].number("inertia difference").value,
      1e-12);
  ASSERT_EQ(found[0].entries.size(), 3U);
  EXPECT_NEAR(found[0].entries[2].value, 69.49, 1e-9);
  for (auto& result : antenna.impulse_results) result.reflected_inertia.value = 1.5;
  EXPECT_THAT(failed(antenna, "impulse_order"), IsEmpty());
}

TEST(Coincidence, IsOneOfTwoMethodsThatPrintTheSame) {
  Case antenna = read_case(case_path("dss14-70m"));
  // Printed in sections III.D and V, but one coincidence.
  const auto found = failed(antenna, "coincidence");
  ASSERT_EQ(found.size(), 1U);
  ASSERT_EQ(found[0].entries.size(), 2U);
  EXPECT_EQ(found[0].entries[0].text, found[0].entries[1].text);
  EXPECT_NE(found[0].entries[0].id, found[0].entries[1].id);
  antenna.impulse_results.clear();
  EXPECT_THAT(failed(antenna, "coincidence"), IsEmpty());
}

}  // namespace
}  // namespace boresight::io

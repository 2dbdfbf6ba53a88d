#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/io/case/case_mechanics.hpp>
#include <boresight/io/case/case_tests.hpp>
#include <boresight/io/case/drive_evidence.hpp>
#include <boresight/io/case/plant_numbers.hpp>
#include <boresight/io/case/resonating_mode.hpp>

namespace boresight::io {
namespace {

TEST(DriveEvidence, HasTheInertiasOfTheCaseAtTheMotorShaft) {
  const Case stated = read_case(case_path("dss14-70m"));
  const auto evidence = make_evidence(stated);
  ASSERT_EQ(evidence.antenna.size(), 2U);
  EXPECT_EQ(evidence.antenna[0].reflected.value, antenna_inertia(stated));
  // 10 % of the inertia, at either shaft.
  EXPECT_NEAR(evidence.antenna[0].reflected.standard_uncertainty / antenna_inertia(stated), 0.1,
              1e-12);
  EXPECT_EQ(evidence.antenna[1].reflected.value,
            antenna_inertia(stated, stated.antenna->alternatives.front()));
  EXPECT_EQ(evidence.assemblies.size(), stated.gear_train->assemblies.size());
}

TEST(DriveEvidence, ReadsTheResonanceOnlyWhereTheAntennaRingsAsRigid) {
  Case stated = read_case(case_path("dss14-70m"));
  EXPECT_EQ(make_evidence(stated).resonance_frequency.has_value(), rings_as_rigid(stated));
  stated.resonance->frequency.reset();
  EXPECT_FALSE(make_evidence(stated).resonance_frequency.has_value());
}

}  // namespace
}  // namespace boresight::io

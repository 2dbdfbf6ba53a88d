#pragma once

#include <cstdint>

#include "random_drive.hpp"
#include <boresight/identification/records/record_defects.hpp>

namespace boresight::coverage {

/// The tests of a full campaign as the recorder shows them, and what its errors make of two truths.
struct SimulatedCampaign {
  std::vector<identification::RawRecord> raw;
  identification::Campaign campaign;  // of these records, cleaned
  double inertia_as_recorded = 0.0;   // kg m2
  double offset_as_recorded = 0.0;    // N m, at the campaign's mean pressure
  double oil_stiffness = 0.0;         // N m/rad, with the air, at the mean pressure
  std::vector<double> speeds;         // rad/s, of the constant-speed tests
};

/// How long the tests are.
struct CampaignLength {
  std::vector<double> speeds{0.025, 0.05, 0.1, 0.2, 0.4, 0.8};  // parts of the recorder's limit
  double half_period = 8.0;  // s, of a constant speed, four times up and down
  double chirp = 60.0;       // s
};

/// Slosh, fast ramp into clipping, slow ramp, six constant speeds, valve steps and chirp on the
/// nonlinear antenna, under wind, each shorter than an engineer would run it. `seed` of wind and
/// noise.
/// @throws NumericalFailure as plant::simulate, and for a record that cannot be used.
SimulatedCampaign simulate_campaign(const RandomDrive& drive, std::uint64_t seed,
                                    const CampaignLength& length = {});

}  // namespace boresight::coverage

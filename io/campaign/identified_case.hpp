#pragma once

#include <boresight/identification/grey_box/grey_box.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::io {

/// The case with what its records say in the place of what it states: the motors' and the antenna's
/// inertia (gear train as stated), oil stiffness and bulk modulus (both volumes scaled alike to
/// meet the stiffness), leakage, friction curve, offset torque and bristles where the case has
/// them, and all structural frequencies in proportion to the lowest of the locked rotor. These
/// numbers then have the basis "measured".
/// @throws NumericalFailure for an estimate that leaves the antenna no inertia, and for one that
/// the records' contradiction with the case makes none (DriveEstimate::contradicted).
Case with_identified(const Case& antenna, const identification::DriveEstimate& estimate);

}  // namespace boresight::io

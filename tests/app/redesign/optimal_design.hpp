// A design that met every constraint, of a given linear rms.
#pragma once

#include <boresight/design/tuning/design_study.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {

inline design::Design design_of(double rms_mdeg) {
  design::Design design;
  design.tuning.status = design::TuningStatus::optimal;
  design.verification.passed = true;
  design.boresight_rms = rms_mdeg * millidegree;
  return design;
}

}  // namespace boresight::app

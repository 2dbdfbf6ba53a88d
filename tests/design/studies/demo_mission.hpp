#pragma once

#include "reference_antenna.hpp"
#include <boresight/design/problem/mission.hpp>

namespace boresight::reference {

/// The demo antenna in a wind of 10 m/s, with two PI structures to be tuned.
inline design::Mission demo_mission() {
  design::Mission mission;
  mission.antenna = plant::demo_antenna();
  mission.wind = {wind_site(), plant::WindModel::coherence, 10.0};
  mission.structures.loops = {{"PI-0", control::LoopStructure::named("PI-0")},
                              {"PI", control::LoopStructure::named("PI")}};
  mission.max_disks = 24.0;
  return mission;
}

}  // namespace boresight::reference

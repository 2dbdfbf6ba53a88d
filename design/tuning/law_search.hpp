#pragma once

#include <memory>
#include <vector>

#include <boresight/design/tuning/feasible_search.hpp>
#include <boresight/design/tuning/judged_plant.hpp>

namespace boresight::design {

/// Which plants a search carries: hard goals hold on each of `goals`; the cost is the root of the
/// mean beam variance of `rms`, or the largest of their rms. Indices into the plants.
struct CarriedPlants {
  std::vector<std::size_t> goals;
  std::vector<std::size_t> rms;
  bool largest = false;
};

/// The control laws of a structure as points (logarithms of the gains), and back: gains beyond the
/// bounds of their descriptions are set on them.
std::vector<double> log_gains(const control::ControlLaw& law);
control::ControlLaw law_at(const control::LoopStructure& structure,
                           const std::vector<double>& point);

/// The search of one structure over several plants: ln of the beam rms is the cost, ln of each goal
/// ratio (plus `reserve`) a constraint; undefined where a carried plant's loop is unstable. The
/// plants must outlive the problem, and are used by it. At most three peaks a break, gain margins
/// and phase margins count.
ConstrainedProblem law_problem(std::vector<JudgedPlant>& plants, const CarriedPlants& carried,
                               const control::LoopStructure& structure, const HardGoals& goals,
                               double reserve);

}  // namespace boresight::design

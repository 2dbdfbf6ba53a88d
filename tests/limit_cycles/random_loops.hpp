#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <boresight/design/problem/mission.hpp>
#include <boresight/design/verification/simulated_loop.hpp>

namespace boresight::limit_cycles {

/// One friction and encoder, and loops with them.
struct RandomLoops {
  design::SimulatedLoop antenna;  // with the first of the controllers
  std::vector<control::Controller> controllers;
};

/// Loops of an antenna with random friction, encoder steps and gains; the same for any number of
/// threads. Friction torques 0.5 to 2 times, breakaway up to 1.65 times
/// more, Stribeck rate 0.5 to 2 times, encoder steps 0.3 to 3.3 times those of the mission.
/// Controllers are those that tuning without regard to limit cycles finds for nine structures, each
/// gain times exp(0.7 n) with n normal, of which those remain that are stable as linear loops.
std::vector<RandomLoops> random_loops(const design::Mission& mission, std::size_t frictions,
                                      std::size_t controllers, std::uint64_t seed,
                                      unsigned threads);

}  // namespace boresight::limit_cycles

#pragma once

#include <optional>
#include <vector>

#include <boresight/design/problem/goals.hpp>
#include <boresight/plant/antenna/antenna.hpp>

namespace boresight::design {

/// Angle at the sky (rad) between two codes of the encoder: rounding to steps q errs by q/sqrt(12)
/// rms, the encoder's noise. 0 without noise.
double encoder_step(const plant::Antenna& antenna);
/// The same from the noise (rad rms).
double encoder_step(double noise);

/// Friction slopes (N m s/rad) for Standstill: what the friction curve amounts to
/// (plant::equivalent_friction) in the smallest oscillation that matters, and a third and a sixth
/// of it for larger ones. That oscillation has an amplitude of half an encoder step, below which
/// the loop sees no motion, and a sixth of the hydraulic mode's frequency. Limit cycles of a
/// position loop lie there or below. Slopes not above the antenna's own viscous friction are left
/// out, so that a drive without dry friction has none.
///
/// A condition on the linear loop, and necessary only: a simulation with bristles, backlash and
/// quantisation decides (limit_cycle_search.hpp).
/// @throws InvalidInput as plant::linear_plant; NumericalFailure as plant::hydraulic_mode.
std::vector<double> standstill_friction(const plant::Antenna& antenna);

/// Amplitudes (rad of motor) of these oscillations at that frequency, Standstill::amplitude: those
/// in which the friction curve amounts to each slope, at most 1e4 times the smallest.
/// @throws as standstill_friction.
std::vector<double> standstill_amplitudes(const plant::Antenna& antenna);

/// Linear equivalents of a limit cycle across an edge between two codes of the encoder, by
/// describing functions. A sine of amplitude A about the edge is read as a square wave of one step
/// q, with the gain 2 q/(pi A) (A. Gelb, W. E. Vander Velde, Multiple-Input Describing Functions,
/// 1968, appendix B). Dry friction is plant::equivalent_friction at the amplitude of its rate. A is
/// a quarter of a step, at four frequencies from 0.27 to 1.35 times the hydraulic mode's, the range
/// in which simulated loops limit-cycled. Empty where standstill_friction is.
/// @throws as standstill_friction.
std::vector<Standstill::Edge> encoder_edges(const plant::Antenna& antenna);

/// Breakaway torque over the angle of the motor (N m/rad) that is one step of the encoder: the gain
/// from encoder to motor torque with which a change by one code frees a motor that friction holds.
/// None where standstill_friction is empty.
/// @throws as standstill_friction.
std::optional<double> breakaway_stiffness(const plant::Antenna& antenna);

}  // namespace boresight::design

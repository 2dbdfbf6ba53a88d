#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/design/verification/nonlinear_verification.hpp>
#include <boresight/design/verification/simulated_loop.hpp>
#include <boresight/plant/antenna/plant_response.hpp>

namespace boresight::design {

/// A steady oscillation at rest that harmonic balance or predicted_limit_cycle predicts.
struct PredictedLimitCycle {
  double frequency = 0.0;            // Hz; 0 of a confirmed one with fewer than two periods
  double encoder_amplitude = 0.0;    // rad at the sky, half of peak to peak
  double boresight_amplitude = 0.0;  // the same
  /// Small changes of the amplitude decay, by J. Loeb's criterion; other unstable poles are not
  /// excluded. An unstable limit cycle separates motion that dies out from motion that grows.
  bool stable = false;
  /// A simulation of the reduced antenna ends in it (predicted_limit_cycle).
  bool confirmed = false;
};

/// Limit cycles at rest, without wind and noise, of any controller of one antenna by describing
/// functions. Up to 1.5 times the hydraulic mode's frequency that of oil, leakage and friction
/// together (plant::oscillation_of, a rigid antenna), above it that of friction alone, with the
/// whole structure. The encoder's steps are those of the motion about the middle of a code and
/// about an edge between two; a conditional integral has its own describing function. The rest is
/// linear, with exact dead time. Sought are the zeros of the closed loops' characteristic function
/// over frequency and amplitude, from 2e-3 times the hydraulic mode's frequency up to that of
/// Nyquist, from an opening that just moves the motor to 60 times as much.
///
/// The tables take some tenths of a second, a controller then a millisecond; simulating it
/// (limit_cycle_run) takes some tenths. Neglected are harmonics, bristles, backlash, the offset
/// torque, oil lines and air, steps of the tachometer, and limits, overlap and null offset of the
/// valve. `./dev limit-cycles` counts what is missed, and limit_cycle_search.hpp decides.
/// Source: A. Gelb, W. E. Vander Velde, Multiple-Input Describing Functions and Nonlinear System
/// Design, 1968, chapters 2 and 3.
class LimitCyclePrediction {
 public:
  /// Of all but the loop's controller. Without dry friction none is predicted.
  /// @throws InvalidInput as plant::to_state_space; NumericalFailure as plant::hydraulic_mode.
  LimitCyclePrediction(const SimulatedLoop& loop, unsigned threads);

  /// In order of rising amplitude; one of many encoder steps may stand twice, about a middle and an
  /// edge.
  std::vector<PredictedLimitCycle> of(const control::Controller& controller) const;

 private:
  /// The drive's answers over frequency and amplitude, each per opening of the valve's ports; of
  /// the fast ones per command, with the valve's dynamics in them.
  struct Answers {
    plant::StructureResponse structure;  // at the frequencies
    Eigen::ArrayXcd valve;               // opening per command, with dead time
    Eigen::ArrayXXd opening;             // rad/s
    Eigen::ArrayXXcd tachometer, torque;
    /// rad of motor, of the bull gear as the encoder reads it about the middle of a code and about
    /// an edge.
    Eigen::ArrayXXcd middle_reading, edge_reading;
    Eigen::ArrayXXd amplitude;  // rad of motor, of the bull gear, half of peak to peak
  };
  Answers slow_answers(const SimulatedLoop& loop, double highest, unsigned threads) const;
  Answers fast_answers(const SimulatedLoop& loop, double lowest, double highest) const;
  void append(const control::Controller& controller, const Answers& answers,
              const Eigen::ArrayXXcd& reading, std::vector<PredictedLimitCycle>& found) const;

  double gear_ratio_ = 1.0;
  std::vector<Answers> answers_;
};

/// The largest stable one above an amplitude (rad at the sky) at the encoder.
std::optional<PredictedLimitCycle> largest_stable(const std::vector<PredictedLimitCycle>& predicted,
                                                  double amplitude);

/// The largest limit cycle at rest above min_limit_cycle_amplitude in which simulations of the
/// reduced antenna end (reduced_limit_cycle_run, from limit_cycle_starts initial steps): confirmed.
/// If none does, the largest stable one of harmonic balance, not confirmed: it may arise from other
/// initial states, and mostly does not. The three simulations take some hundredths of a second.
/// They have bristles and harmonics, which harmonic balance neglects: bristles are what makes its
/// amplitudes of a few encoder steps too large. `./dev limit-cycles` counts both kinds.
/// None without dry friction. @throws as LimitCyclePrediction and reduced_limit_cycle_run.
std::optional<PredictedLimitCycle> predicted_limit_cycle(
    const SimulatedLoop& loop, const LimitCyclePrediction& harmonic_balance,
    const NonlinearVerificationOptions& options);

}  // namespace boresight::design

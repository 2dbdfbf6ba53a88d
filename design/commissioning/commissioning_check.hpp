#pragma once

#include <Eigen/Core>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/design/problem/tracking_problem.hpp>
#include <boresight/plant/antenna/plant_response.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::design {

/// A controller as it acts in one stage of commissioning.
struct StageController {
  control::Controller controller;
  bool position_open = false;  // external rate command; position and compliance paths inactive
  bool feedforward = false;    // control::plant_feedforward, with the position loop closed
  /// Of a state space: the factor on its output, which `controller` contains.
  double output_factor = 1.0;
};

/// Rms of recorded signals, at the motor: measured values including the sensors' own noise, over
/// the noise's band. The encoder error is NaN with the position loop open.
struct RecordedRms {
  double encoder_error = 0.0;  // rad
  double tachometer = 0.0;     // rad/s
  double torque = 0.0;         // N m
  double valve_command = 0.0;  // rad/s
};

/// Response of one linear plant with a stage's controller: steps within saturation, no friction
/// curve. All at the motor. NaN except `stable` where it is unstable.
struct StageObservation {
  bool stable = false;          // by eigenvalues, of the loops closed
  double abscissa = 0.0;        // 1/s, of the eigenvalue farthest to the right
  double peak = 0.0;            // Ms over the breaks that are closed
  double crossover = 0.0;       // rad/s, lowest gain crossover of the outer closed loop
  double rise_time = 0.0;       // s, 10 % to 90 % of a step of the rate or position command
  double overshoot = 0.0;       // fraction of the step
  double settling_time = 0.0;   // s, into 5 %; infinite if not within the time simulated
  double largest_demand = 0.0;  // rad/s of valve demand per unit of step
  double largest_torque = 0.0;  // N m per unit of step
  /// Change of the steady valve command over that of the steady motor rate, as the tachometer shows
  /// it: 1 + leakage rate x viscous friction / oil stiffness of a plant as stated.
  double valve_per_rate = 0.0;
  double oil_stiffness = 0.0;  // N m/rad, as torque and tachometer show it
  RecordedRms calm;            // in still air
  RecordedRms windy;           // in the problem's wind, and noise
  double boresight_rms = 0.0;  // rad, in the wind; NaN with the position loop open
  double move_error = 0.0;  // rad, largest encoder error of the move; NaN with position loop open
};

/// A move feasible for the command preprocessor: rest to rate to rest (at the motor).
struct CommandedMove {
  double rate = 0.0;          // rad/s
  double acceleration = 0.0;  // rad/s2
};

/// Factors on valve and sensors of an antenna that is not wired, scaled or built as stated; -1: the
/// wrong sign.
struct SignalFactors {
  double valve = 1.0, tachometer = 1.0, torque = 1.0, encoder = 1.0;

  bool as_stated() const;
};

/// Evaluates controllers on one plant. Use one object per thread.
class StageObserver {
 public:
  /// `plant` replaces the problem's, whose feedforward stays: it is what the computer is loaded
  /// with. With factors other than 1, everything is as the sensors show it, stability is that of
  /// command_loop.hpp, and Ms, boresight rms and rms in wind are NaN.
  /// @throws InvalidInput for a move that is not positive.
  StageObserver(const TrackingProblem& problem, const plant::AntennaPlant& plant,
                const WindTable& wind, const CommandedMove& move,
                const SignalFactors& factors = {});

  /// Ms over the breaks that are closed, infinity for an unstable loop, by Nyquist encirclements
  /// along the frequencies. Fast. @throws InvalidInput as control::validate.
  double peak(const StageController& stage);
  /// All values, stability by eigenvalues. Time responses are exact at their samples; the simulated
  /// time, 60 over the crossover, has 6000 samples. @throws as peak.
  StageObservation observe(const StageController& stage);
  /// The closed loop from its command to what is recorded of it: the tachometer with the position
  /// loop open, else the encoder. `frequency`: rad/s, above 0, rising. Without feedforward.
  Eigen::ArrayXcd response(const StageController& stage, const Eigen::ArrayXd& frequency) const;

 private:
  struct Verdict {
    bool stable = false;
    double abscissa = 0.0, peak = 0.0;
  };
  Verdict verdict(const StageController& stage);
  Verdict verdict_by_command_loop(const StageController& stage) const;
  plant::StateSpace command_loop(const StageController& stage) const;
  plant::PlantResponse sensed_response(const Eigen::ArrayXd& frequency) const;
  void observe_step(const StageController& stage, StageObservation& seen) const;
  void observe_move(const StageController& stage, StageObservation& seen) const;
  void observe_recorder(const StageController& stage, StageObservation& seen) const;
  double crossover(const StageController& stage) const;

  TrackingProblem problem_;
  plant::AntennaPlant stated_;  // the problem's own plant
  CommandedMove move_;
  SignalFactors factors_;
  plant::StateSpace sensed_;  // the plant as its sensors show it
  control::LoopEvaluator evaluator_;
  plant::PlantResponse response_;  // on a grid of 60 points per decade
  Eigen::ArrayXd wind_spectrum_;   // on this grid, (N m)^2/Hz
};

}  // namespace boresight::design

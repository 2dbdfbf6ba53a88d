#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <boresight/control/loops/adaptive_panels.hpp>
#include <boresight/control/loops/panel_rule.hpp>
#include <boresight/design/ensembles/fixed_gain_evaluator.hpp>
#include <boresight/numerics/complex_packs.hpp>

namespace boresight::design {

/// The frequencies of a fixed-gain controller: panels of eight Gauss points in ln w, halved on
/// demand and kept from plant to plant. Each panel stores everything that is common to all plants:
/// weights of wind, climate and noise, and the controller's compensators times the dead time. The
/// class also evaluates the closed loop of one plant on the panels. Part of FixedGainEvaluator.
class FixedGainPanels {
 public:
  FixedGainPanels(const TrackingProblem& problem, const control::Controller& controller,
                  bool gusts);

  /// Integrates over the panels that cover the band for one plant, within the tolerance.
  /// @throws NumericalFailure for a response that is not finite.
  void sweep(const plant::AntennaPlant& plant, double tolerance);

  // Of the last sweep.
  struct Sums {
    double wind = 0.0, climate = 0.0, noise = 0.0, effort = 0.0, demand = 0.0, torque = 0.0;
  };
  const Sums& sums() const { return sums_; }
  /// True if neither loop has poles in the right half plane, by Nyquist encirclements.
  bool stable() const;
  std::size_t points() const { return leaves_.size() * numerics::pack_size; }
  double frequency(std::size_t point) const;
  double sensitivity_square(std::size_t loop_break, std::size_t point) const;

 private:
  struct Panel {
    bool weighted = false, noisy = false;
    numerics::RealPack frequency;
    numerics::RealPack wind, climate;  // (N m)^2 per point
    // (rad/s)^2 per point: noise-driven demand, open loop; the command's, and what the antenna
    // receives of it (control::sample_density).
    numerics::RealPack effort, noise;
    numerics::ComplexPack rate, pressure;     // times the dead time
    numerics::ComplexPack position, bending;  // R P, with the dead time; C
  };
  struct Values {
    numerics::ComplexPack rate_return, both_return;  // 1 + L, position loop open, closed
    std::array<numerics::RealPack, 3> sensitivity_square;
    numerics::RealPack wind, climate, noise, effort, demand, torque;
    // Last coefficients (panel_rule.hpp) of the variances' densities and of the return differences.
    control::TailCoefficients boresight_tail, effort_tail, climate_tail, demand_tail, torque_tail;
    control::TailCoefficients rate_tail_re, rate_tail_im, both_tail_re, both_tail_im;
    // Below 0 where the phase of a return difference changes by over 90 deg to the next point.
    numerics::RealPack turn;
  };
  void add_panel(double from, double to);
  struct Evaluation;
  void evaluate(const plant::AntennaPlant& plant, const std::uint32_t* panels, std::size_t count);
  struct Limits;
  bool close_enough(std::uint32_t i, const Limits& limits) const;

  control::FrequencyBand band_;
  control::SensorNoise noise_;
  double delay_;
  control::Controller controller_;
  bool gusts_;
  int rate_integrators_ = 0, position_integrators_ = 0;
  std::vector<WindTable> winds_;  // at the design's speed; of the climate where there is one
  bool climate_ = false;
  control::AdaptivePanels places_;
  std::vector<Panel> panels_;          // by place
  std::vector<Values> values_;         // likewise
  std::vector<std::uint32_t> leaves_;  // of the last plant, rising
  Sums sums_;
};

}  // namespace boresight::design

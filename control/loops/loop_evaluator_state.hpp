#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include <boresight/control/loops/adaptive_panels.hpp>
#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/control/loops/panel_rule.hpp>
#include <boresight/numerics/complex_packs.hpp>

namespace boresight::control {

/// Internal state of a LoopEvaluator; see the public functions for their meaning. Only the
/// evaluator's own sources include this header, so that a change of it recompiles nothing else.
class LoopEvaluator::State {
 public:
  State(LoopChannels channels, const GridConditions& conditions);
  State(std::function<plant::ResponsePoint(double)> channels, PanelConditions conditions);

  void look_at(std::array<bool, 3> breaks) { breaks_ = breaks; }
  void look_at_gusts(bool look) { gusts_ = look; }
  LoopEvaluation evaluate(const Controller& controller, bool with_gradients);
  std::size_t frequencies_used() const { return leaves_.size() * numerics::pack_size; }
  Eigen::ArrayXd wind_transmission(const Controller& controller) const;
  const plant::PlantResponse& response() const { return channels_.response; }
  double delay() const { return delay_; }
  const Eigen::ArrayXd& integration_weight() const { return weight_; }

 private:
  // Eight frequencies: responses to the command, including the dead time.
  struct GridPack {
    numerics::RealPack frequency, period, wind_weight, noise_weight;  // period: 1/frequency
    numerics::ComplexPack tachometer_command, torque_command, encoder_command, boresight_command;
    numerics::ComplexPack tachometer_wind, torque_wind, encoder_wind, boresight_wind;
    bool weighted = false, noisy = false;  // whether any weight is above 0

    void set(std::size_t lane, double frequency, const plant::ResponsePoint& response,
             double delay);
    void set_weights(std::size_t lane, double wind, double noise);
  };
  // Values of one controller at eight frequencies: weighted integrands, and their tails
  // (panel_rule.hpp).
  struct LoopValues {
    numerics::ComplexPack rate_return, both_return;  // 1 + L, position loop open, closed
    std::array<numerics::RealPack, 3> sensitivity_square;
    numerics::RealPack wind, noise, effort, wind_demand, wind_torque;
    TailCoefficients boresight_tail, effort_tail, demand_tail, torque_tail;
    // Below 0 where 1 + L turns by more than a right angle to the next point.
    numerics::RealPack turn;
  };
  struct PlacedBlock {
    BlockKind kind = BlockKind::gain;
    std::size_t first_gain = 0;
  };
  // Data of one controller for a sweep over the frequencies.
  struct Sweep {
    const Controller* controller = nullptr;
    bool state_space = false;                     // LoopStructure::state_space
    std::array<PlacedBlock, max_gains> blocks{};  // path by path
    std::array<std::size_t, 4> path_end{};
    std::array<std::size_t, max_gains> path_of_gain{};
    std::array<bool, 4> present{};
    double tachometer_density = 0.0, encoder_density = 0.0, torque_density = 0.0;
    bool noisy = false;
  };
  template <std::size_t width>
  struct LoopLanes;
  struct ValueSweep;
  struct GradientSums;
  struct GradientSweep;
  struct Limits;
  struct PointOnAxis {
    double place = 0.0, value = 0.0;  // ln w, ln|S|^2
  };

  // ln|S|^2 between points, the product of the distances from them, and the leaf that contains
  // them.
  struct Interpolation {
    double value = 0.0, product = 0.0;
    std::size_t leaf = 0;
  };

  void use_first_panels();
  void make_panels(const LoopQuadrature& quadrature);
  void add_resolved(double from, double to, const LoopQuadrature& quadrature);
  double panel_weight(const FrequencyPanel& panel, std::size_t lane) const;
  void add_panel(double from, double to);
  void choose_leaves(const Sweep& sweep);
  bool close_enough(std::uint32_t i, const Limits& limits) const;
  Sweep prepare(const Controller& controller) const;
  void sweep_values(const Sweep& sweep, const std::uint32_t* packs, std::size_t count);
  void sweep_gradients(const Sweep& sweep, LoopEvaluation& result) const;
  void count_unstable(const Controller& controller, LoopEvaluation& result) const;

  std::size_t points() const;
  double sensitivity_square(std::size_t loop_break, std::size_t i) const;
  PointOnAxis point_on_axis(LoopBreak loop_break, std::size_t i) const;
  Interpolation interpolate(LoopBreak loop_break, std::size_t near, double place) const;
  SensitivityPeak peak_at(const Controller& controller, LoopBreak loop_break,
                          double frequency) const;
  SensitivityPeak polish(const Controller& controller, LoopBreak loop_break, std::size_t i) const;
  void find_peaks(const Controller& controller, LoopBreak loop_break, PeakList& peaks) const;

  LoopChannels channels_;
  double delay_;
  SensorNoise noise_;
  std::array<bool, 3> breaks_{true, true, true};
  bool gusts_ = false;
  Eigen::ArrayXd weight_;
  std::vector<GridPack> packs_;
  std::vector<LoopValues> values_;     // by pack
  std::vector<std::uint32_t> leaves_;  // packs of the last evaluation, rising in frequency
  // Empty where the frequencies were given.
  AdaptivePanels panels_;  // by pack
  std::function<double(double)> wind_spectrum_;
  FrequencyBand band_;
  double tolerance_ = 0.0;
  double lowest_place_ = -std::numeric_limits<double>::infinity();
};

}  // namespace boresight::control

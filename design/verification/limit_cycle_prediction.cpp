#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <boresight/control/controllers/conditional_integral.hpp>
#include <boresight/design/verification/limit_cycle_prediction.hpp>
#include <boresight/design/verification/limit_cycle_search.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/parallel_loop.hpp>
#include <boresight/plant/antenna/friction.hpp>
#include <boresight/plant/antenna/point_response.hpp>
#include <boresight/plant/nonlinear/oscillating_drive.hpp>

namespace boresight::design {
namespace {

using Complex = std::complex<double>;
using Eigen::ArrayXd;
using Eigen::ArrayXXcd;
using Eigen::Index;

// Over the hydraulic mode's frequency.
constexpr double lowest_frequency = 2e-3, highest_slow_frequency = 1.5;
// Over the opening that gives the breakaway torque to a motor that is held, and in excess of it:
// little above 1 the amplitude rises from 0 to some encoder steps.
constexpr double min_opening = 0.9, min_excess = 0.1, max_excess = 60.0;
constexpr Index slow_frequencies = 40, fast_frequencies = 60, amplitudes = 48;
constexpr double middle = 0.0, edge = 0.5;  // positions within a code

ArrayXd logarithmic(double lowest, double highest, Index count) {
  return ArrayXd::LinSpaced(count, std::log(lowest), std::log(highest)).exp();
}

// Fundamental of an angle, at equal steps of a period, as an encoder reads it; a step of 0: exact.
Complex fundamental(const ArrayXd& angle, double step, double position) {
  Complex sum = 0.0;
  const auto count = static_cast<double>(angle.size());
  for (Index k = 0; k < angle.size(); ++k) {
    const double read = step > 0.0 ? step * std::round(angle[k] / step + position) : angle[k];
    sum += read * std::polar(1.0, -two_pi * static_cast<double>(k + 1) / count);
  }
  return Complex{0.0, 2.0} / count * sum;
}

// Describing function of rounding to steps of 1 in a sine about a position within a code.
double rounding_gain(double amplitude, double position) {
  double sum = 0.0;
  const auto last = static_cast<int>(std::ceil(amplitude + 1.0));
  for (int k = -last; k <= last; ++k) {
    const double part = (k + 0.5 - position) / amplitude;
    if (std::abs(part) < 1.0) sum += std::sqrt(1.0 - part * part);
  }
  return 2.0 * sum / (std::numbers::pi * amplitude);
}

plant::StructurePoint structure_at(const plant::StructureResponse& structure, Index i) {
  return {structure.inertial_stiffness[i], structure.gear_stiffness[i],
          structure.wind_at_bull_gear[i], structure.boresight_per_bull_gear[i],
          structure.boresight_per_wind[i]};
}

// The bull gear's angle per motor angle.
Complex bull_gear_per_motor(const plant::StructureResponse& structure, Index i) {
  return structure.gear_stiffness[i] /
         (structure.gear_stiffness[i] + structure.inertial_stiffness[i]);
}

// Of frequencies by amplitudes.
template <typename Answers>
void resize(Answers& answers, Index rows, Index columns) {
  answers.valve.resize(rows);
  answers.opening.resize(rows, columns);
  answers.amplitude.resize(rows, columns);
  for (auto* one :
       {&answers.tachometer, &answers.torque, &answers.middle_reading, &answers.edge_reading}) {
    one->resize(rows, columns);
  }
}

Complex dead_time(const SimulatedLoop& loop, double frequency) {
  return std::polar(1.0, -1.5 * loop.sample_time * frequency);
}

bool has_dry_friction(const SimulatedLoop& loop) {
  const plant::FrictionCurve& friction = loop.antenna.friction.curve;
  return std::max(friction.breakaway_torque, friction.coulomb_torque) > 0.0;
}

// Place of a zero in a cell of a grid, 0 to 1 along either side. At a stable one the linear loop
// has an unstable pair of poles less at the larger amplitude (J. Loeb's criterion).
struct Zero {
  double x, y;
  bool stable;
};

// By the winding number of the values at the corners, then on the plane that fits them.
std::optional<Zero> zero_in(const ArrayXXcd& values, Index i, Index j) {
  const Complex a = values(i, j), b = values(i + 1, j), c = values(i + 1, j + 1),
                d = values(i, j + 1);
  const auto turn = [](Complex from, Complex to) { return std::arg(to * std::conj(from)); };
  const double winding = turn(a, b) + turn(b, c) + turn(c, d) + turn(d, a);
  if (!(std::abs(winding) > std::numbers::pi)) return std::nullopt;
  const Complex by_x = 0.5 * (b - a + c - d), by_y = 0.5 * (d - a + c - b);
  const Complex centre = 0.25 * (a + b + c + d);
  const double area = (std::conj(by_x) * by_y).imag();
  if (area == 0.0) return Zero{0.5, 0.5, winding < 0.0};
  const double x = 0.5 - (std::conj(centre) * by_y).imag() / area;
  const double y = 0.5 + (std::conj(centre) * by_x).imag() / area;
  return Zero{std::clamp(x, 0.0, 1.0), std::clamp(y, 0.0, 1.0), winding < 0.0};
}

}  // namespace

LimitCyclePrediction::LimitCyclePrediction(const SimulatedLoop& loop, unsigned threads)
    : gear_ratio_(loop.gear_ratio) {
  if (!has_dry_friction(loop)) return;
  const double hydraulic =
      two_pi * plant::hydraulic_mode(plant::plant_modes(loop.linear)).frequency;
  const double nyquist = std::numbers::pi / loop.sample_time;
  const double between = std::min(highest_slow_frequency * hydraulic, nyquist);
  answers_.push_back(slow_answers(loop, between, threads));
  if (between < nyquist) answers_.push_back(fast_answers(loop, between, nyquist));
}

LimitCyclePrediction::Answers LimitCyclePrediction::slow_answers(const SimulatedLoop& loop,
                                                                 double highest,
                                                                 unsigned threads) const {
  const plant::Drive& linear = loop.linear.drive;
  plant::FrictionDrive drive;
  drive.oil_stiffness = linear.oil_stiffness;
  drive.leakage_rate = linear.leakage_rate;
  drive.inertia = plant::reflected_inertia(loop.linear);
  drive.friction = loop.antenna.friction.curve;
  drive.viscous_friction = loop.antenna.viscous_friction;
  const plant::OilCircuit& oil = loop.antenna.oil;
  if (oil.supply_torque > oil.return_torque) {
    drive.supply_torque = oil.supply_torque - oil.return_torque;
  }
  const double hold = std::max(drive.friction.breakaway_torque, drive.friction.coulomb_torque);
  const ArrayXd frequency =
      logarithmic(lowest_frequency / highest_slow_frequency * highest, highest, slow_frequencies);
  const ArrayXd openings = min_opening + logarithmic(min_excess, max_excess, amplitudes);

  Answers answers;
  answers.structure = plant::structure_response(loop.linear.structure, frequency);
  const Index rows = frequency.size(), columns = openings.size();
  resize(answers, rows, columns);
  numerics::for_each_index(static_cast<std::size_t>(rows), threads, [&](std::size_t row) {
    const auto i = static_cast<Index>(row);
    const Complex s{0.0, frequency[i]};
    const double corner = linear.valve_corner;
    answers.valve[i] = dead_time(loop, frequency[i]) * corner * corner /
                       (s * s + 2.0 * linear.valve_damping * corner * s + corner * corner);
    const Complex lag = linear.tachometer_corner / (s + linear.tachometer_corner);
    const Complex gear = bull_gear_per_motor(answers.structure, i);
    const double moving = hold * std::abs(s + drive.leakage_rate) / drive.oil_stiffness;
    plant::DriveOscillation motion;
    for (Index j = 0; j < columns; ++j) {
      const double opening = openings[j] * moving;
      motion = plant::oscillation_of(drive, frequency[i], opening, motion);
      answers.opening(i, j) = opening;
      answers.tachometer(i, j) = motion.rate * lag;
      answers.torque(i, j) = motion.torque;
      // The structure moves the bull gear by a factor, with little phase.
      const double size = std::abs(gear);
      const ArrayXd angle = size * motion.angle;
      answers.amplitude(i, j) = angle.maxCoeff();
      const double step = loop.encoder_resolution;
      answers.middle_reading(i, j) = gear / (size * opening) * fundamental(angle, step, middle);
      answers.edge_reading(i, j) = gear / (size * opening) * fundamental(angle, step, edge);
    }
  });
  return answers;
}

LimitCyclePrediction::Answers LimitCyclePrediction::fast_answers(const SimulatedLoop& loop,
                                                                 double lowest,
                                                                 double highest) const {
  const ArrayXd frequency = logarithmic(lowest, highest, fast_frequencies);
  const double step = loop.encoder_resolution;
  // Of what matters, half an encoder step.
  constexpr double smallest = 0.5, largest = 200.0;
  const double min_amplitude = min_limit_cycle_amplitude(loop) * loop.gear_ratio;
  const ArrayXd amplitude =
      logarithmic(smallest * min_amplitude, largest * min_amplitude, amplitudes);
  Answers answers;
  answers.structure = plant::structure_response(loop.linear.structure, frequency);
  const Index rows = frequency.size(), columns = amplitude.size();
  resize(answers, rows, columns);
  for (Index i = 0; i < rows; ++i) {
    answers.valve[i] = dead_time(loop, frequency[i]);
    const double gear = std::abs(bull_gear_per_motor(answers.structure, i));
    for (Index j = 0; j < columns; ++j) {
      plant::Drive drive = loop.linear.drive;
      drive.viscous_friction = loop.antenna.viscous_friction +
                               plant::equivalent_friction(loop.antenna.friction.curve,
                                                          frequency[i] * amplitude[j] / gear);
      const plant::ResponsePoint point =
          plant::drive_on_structure(drive, structure_at(answers.structure, i), frequency[i]);
      answers.amplitude(i, j) = amplitude[j];
      answers.opening(i, j) = amplitude[j] / std::abs(point.encoder_command);
      answers.tachometer(i, j) = point.tachometer_command;
      answers.torque(i, j) = point.torque_command;
      const auto reading = [&](double position) {
        const double gain = step > 0.0 ? rounding_gain(amplitude[j] / step, position) : 1.0;
        return gain * point.encoder_command;
      };
      answers.middle_reading(i, j) = reading(middle);
      answers.edge_reading(i, j) = reading(edge);
    }
  }
  return answers;
}

void LimitCyclePrediction::append(const control::Controller& controller, const Answers& answers,
                                  const ArrayXXcd& reading,
                                  std::vector<PredictedLimitCycle>& found) const {
  const ArrayXd& frequency = answers.structure.frequency;
  const bool conditional = controller.structure.has_conditional_integral();
  control::Controller equivalent = controller;
  ArrayXXcd returned(reading.rows(), reading.cols());
  for (Index i = 0; i < reading.rows(); ++i) {
    auto c = control::compensator_response(controller, frequency[i]);
    for (Index j = 0; j < reading.cols(); ++j) {
      // The corrected angle, which a conditional integral takes.
      const Complex angle = reading(i, j) - c.compliance * answers.torque(i, j);
      if (conditional) {
        control::set_linear_equivalent(controller, std::abs(angle) * answers.opening(i, j),
                                       equivalent);
        c = control::compensator_response(equivalent, frequency[i]);
      }
      returned(i, j) =
          1.0 + answers.valve[i] * (c.rate * (answers.tachometer(i, j) + c.position * angle) +
                                    c.pressure * answers.torque(i, j));
    }
  }
  const auto between = [](double from, double to, double part) {
    return from * std::pow(to / from, part);
  };
  for (Index i = 0; i + 1 < reading.rows(); ++i) {
    for (Index j = 0; j + 1 < reading.cols(); ++j) {
      const auto zero = zero_in(returned, i, j);
      if (!zero) continue;
      PredictedLimitCycle one;
      one.frequency = between(frequency[i], frequency[i + 1], zero->x) / two_pi;
      const auto amplitude = [&](Index row) {
        return std::lerp(answers.amplitude(row, j), answers.amplitude(row, j + 1), zero->y);
      };
      one.encoder_amplitude = std::lerp(amplitude(i), amplitude(i + 1), zero->x) / gear_ratio_;
      one.boresight_amplitude =
          one.encoder_amplitude * std::abs(answers.structure.boresight_per_bull_gear[i]);
      one.stable = zero->stable;
      found.push_back(one);
    }
  }
}

std::vector<PredictedLimitCycle> LimitCyclePrediction::of(
    const control::Controller& controller) const {
  std::vector<PredictedLimitCycle> found;
  for (const Answers& answers : answers_) {
    append(controller, answers, answers.middle_reading, found);
    append(controller, answers, answers.edge_reading, found);
  }
  std::ranges::stable_sort(found, {}, &PredictedLimitCycle::encoder_amplitude);
  return found;
}

std::optional<PredictedLimitCycle> largest_stable(const std::vector<PredictedLimitCycle>& predicted,
                                                  double amplitude) {
  std::optional<PredictedLimitCycle> largest;
  for (const PredictedLimitCycle& one : predicted) {
    const double limit = largest ? largest->encoder_amplitude : amplitude;
    if (one.stable && one.encoder_amplitude > limit) largest = one;
  }
  return largest;
}

std::optional<PredictedLimitCycle> predicted_limit_cycle(
    const SimulatedLoop& loop, const LimitCyclePrediction& harmonic_balance,
    const NonlinearVerificationOptions& options) {
  if (!has_dry_friction(loop)) return std::nullopt;
  std::optional<PredictedLimitCycle> largest;
  for (std::size_t start = 0; start < limit_cycle_starts; ++start) {
    const LimitCycleResult run = reduced_limit_cycle_run(loop, options, start);
    if (!run.limit_cycle) continue;
    if (largest && run.encoder_amplitude <= largest->encoder_amplitude) continue;
    largest = {.frequency = run.frequency.value_or(0.0),
               .encoder_amplitude = run.encoder_amplitude,
               .boresight_amplitude = run.boresight_amplitude,
               .stable = true,
               .confirmed = true};
  }
  if (largest) return largest;
  return largest_stable(harmonic_balance.of(loop.controller), min_limit_cycle_amplitude(loop));
}

}  // namespace boresight::design

#include <algorithm>
#include <cmath>

#include <boresight/control/loops/loop_encirclements.hpp>
#include <boresight/design/ensembles/fixed_gain_panels.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/vector_clones.hpp>

namespace boresight::design {
namespace {

using control::panel_rule;
using numerics::ComplexPack;
using numerics::pack_size;
using numerics::RealPack;

// In ln w: the widest panels that plants start from.
constexpr double widest_panel = 0.6;
// Of the largest value in a panel: how far a return may be from a polynomial of its points.
constexpr double return_tolerance = 0.1;

// As the rule's, for functions without the rule's weights in them.
using TailRule = std::array<control::TailCoefficients, pack_size>;

const TailRule& unweighted_tail() {
  static const TailRule rule = [] {
    TailRule made;
    for (std::size_t node = 0; node < pack_size; ++node) {
      made[node] = panel_rule().tail[node] * control::TailCoefficients(panel_rule().weight[node]);
    }
    return made;
  }();
  return rule;
}

template <std::size_t width>
[[gnu::always_inline]] inline numerics::ComplexLanes<width> inverse_of(
    const numerics::ComplexLanes<width>& x) {
  return numerics::conjugate(x) * numerics::RealLanes<width>(1.0 / numerics::square(x));
}

// The last two coefficients of a complex function, squared.
double last_coefficients(const control::TailCoefficients& re, const control::TailCoefficients& im) {
  return re[2] * re[2] + re[3] * re[3] + im[2] * im[2] + im[3] * im[3];
}

double largest(const RealPack& x) {
  double result = 0.0;
  for (std::size_t lane = 0; lane < pack_size; ++lane) result = std::max(result, x[lane]);
  return result;
}

}  // namespace

struct FixedGainPanels::Limits {
  double boresight = 0.0, effort = 0.0, climate = 0.0, demand = 0.0,
         torque = 0.0;  // squares of errors
};

FixedGainPanels::FixedGainPanels(const TrackingProblem& problem,
                                 const control::Controller& controller, bool gusts)
    : band_(problem.rms_band),
      noise_(problem.noise),
      delay_(problem.delay),
      controller_(controller),
      gusts_(gusts),
      climate_(!problem.climate.empty()) {
  for (const auto& block : controller.structure.blocks()) {
    if (block.kind != control::BlockKind::integral) continue;
    ++(block.path == control::LoopPath::rate ? rate_integrators_ : position_integrators_);
  }
  TrackingProblem at_speed = problem;
  at_speed.climate.clear();
  winds_.emplace_back(at_speed);
  if (climate_) winds_.emplace_back(problem);
  const auto [lowest, highest] = analysis_band(problem);
  const std::vector<double> edges = control::places_within(
      lowest, highest, {lowest, highest, band_.lowest, band_.highest, noise_.bandwidth});
  for (const auto& panel : control::panels_between(edges, widest_panel)) {
    add_panel(panel.from, panel.to);
    places_.start_from_last();
  }
}

void FixedGainPanels::add_panel(double from, double to) {
  const auto& rule = panel_rule();
  const double half_width = 0.5 * (to - from), centre = 0.5 * (from + to);
  const double per_band = 1.0 / noise_.bandwidth;
  Panel panel;
  const auto put = [](ComplexPack& place, std::size_t lane, std::complex<double> value) {
    place.re.set(lane, value.real());
    place.im.set(lane, value.imag());
  };
  for (std::size_t lane = 0; lane < pack_size; ++lane) {
    const double w = std::exp(centre + half_width * rule.node[lane]);
    const double hertz = w / two_pi;
    panel.frequency.set(lane, w);
    const auto controller = control::compensator_response(controller_, w);
    const auto dead_time = std::polar(1.0, -w * delay_);
    const auto position = controller.rate * controller.position;
    put(panel.rate, lane, controller.rate * dead_time);
    put(panel.pressure, lane, controller.pressure * dead_time);
    put(panel.position, lane, position * dead_time);
    put(panel.bending, lane, controller.compliance);
    // Edges of the bands are edges of panels.
    if (hertz <= band_.lowest || hertz >= band_.highest) continue;
    const double weight = half_width * rule.weight[lane] * hertz;
    panel.wind.set(lane, weight * winds_[0].spectrum(w));
    if (climate_) panel.climate.set(lane, weight * winds_[1].spectrum(w));
    panel.weighted = true;
    if (hertz >= noise_.bandwidth) continue;
    const double demand =
        noise_.tachometer_rms * noise_.tachometer_rms * std::norm(controller.rate) +
        noise_.encoder_rms * noise_.encoder_rms * std::norm(position) +
        noise_.torque_rms * noise_.torque_rms *
            std::norm(controller.pressure - position * controller.compliance);
    panel.noise.set(lane, weight * per_band * demand);
    panel.effort.set(lane, weight * per_band * demand * control::sample_density(controller_, w));
    panel.noisy = panel.noisy || demand > 0.0;
  }
  panels_.push_back(panel);
  values_.emplace_back();
  places_.add(from, to);
}

// The plant as plant::PointResponse and drive_on_structure have it at one frequency, then the loop
// as control::LoopEvaluator has it.
struct FixedGainPanels::Evaluation {
  template <std::size_t width>
  [[gnu::always_inline]] static inline void run(FixedGainPanels& held,
                                                const plant::AntennaPlant& plant,
                                                const std::uint32_t* panels, std::size_t count) {
    const auto& rule = panel_rule();
    const TailRule& plain = unweighted_tail();
    for (std::size_t n = 0; n < count; ++n) {
      Values& values = held.values_[panels[n]];
      for (std::size_t k = 0; k < pack_size / width; ++k) {
        set_values<width>(held, plant, held.panels_[panels[n]], k, values);
      }
      const auto tail = [&](control::TailCoefficients& place, const auto& by_node,
                            const RealPack& value) {
        control::set_tail<width>(place, by_node, value);
      };
      RealPack boresight = values.wind;
      boresight += values.noise;
      tail(values.boresight_tail, rule.tail, boresight);
      tail(values.effort_tail, rule.tail, values.effort);
      if (held.climate_) tail(values.climate_tail, rule.tail, values.climate);
      if (held.gusts_) {
        tail(values.demand_tail, rule.tail, values.demand);
        tail(values.torque_tail, rule.tail, values.torque);
      }
      tail(values.rate_tail_re, plain, values.rate_return.re);
      tail(values.rate_tail_im, plain, values.rate_return.im);
      tail(values.both_tail_re, plain, values.both_return.re);
      tail(values.both_tail_im, plain, values.both_return.im);
      control::set_turn<width>(values.turn, values.rate_return, values.both_return);
    }
  }

  // At the k-th part of a panel.
  template <std::size_t width>
  [[gnu::always_inline]] static inline void set_values(const FixedGainPanels& held,
                                                       const plant::AntennaPlant& plant,
                                                       const Panel& panel, std::size_t k,
                                                       Values& values) {
    using RealPart = numerics::RealLanes<width>;
    using ComplexPart = numerics::ComplexLanes<width>;
    using numerics::part;
    using numerics::set_part;
    const auto& [drive, structure] = plant;
    const double wv = drive.valve_corner, wt = drive.tachometer_corner;
    const RealPart w = part<width>(panel.frequency, k);
    const RealPart w2 = w * w;
    ComplexPart b{-structure.bull_gear_inertia * w2, 0.0};
    ComplexPart wind{structure.bull_gear_wind_fraction, 0.0};
    ComplexPart boresight{structure.bull_gear_beam_weight, 0.0};
    ComplexPart unseen{};
    for (const auto& mode : structure.modes) {
      const RealPart damping = mode.damping * w;
      const RealPart inertia = mode.inertia * w2;
      const ComplexPart inverse = inverse_of(ComplexPart{mode.stiffness - inertia, damping});
      const ComplexPart follow = ComplexPart{mode.stiffness, damping} * inverse;
      b = b - follow * inertia;
      wind = wind + follow * mode.wind_fraction;
      boresight = boresight + follow * mode.beam_weight;
      unseen = unseen + inverse * (mode.wind_fraction * mode.beam_weight);
    }
    const ComplexPart valve =
        inverse_of(ComplexPart{wv * wv - w2, 2.0 * drive.valve_damping * wv * w}) *
        RealPart(wv * wv);
    const ComplexPart oil =
        inverse_of(ComplexPart{drive.leakage_rate, w}) * RealPart(drive.oil_stiffness);
    const ComplexPart lag = inverse_of(ComplexPart{wt, w}) * RealPart(wt);
    const ComplexPart rate_lag{-w * lag.im, w * lag.re};  // s lag
    const ComplexPart oil_damper{-w * oil.im, w * oil.re};
    const ComplexPart own{-drive.motor_inertia * w2, drive.viscous_friction * w};
    const ComplexPart a = own + oil_damper;
    const ComplexPart g{structure.gear_stiffness, structure.gear_damping * w};
    // Determinant of [[g+a, -g], [-g, g+b]] without the cancelling g^2.
    const ComplexPart inverse = inverse_of(g * (a + b) + a * b);
    const ComplexPart push = oil * valve * inverse;
    const ComplexPart blown = wind * inverse;
    const ComplexPart free_gear = g + b;
    const ComplexPart encoder_command = g * push;
    const ComplexPart tachometer_command = rate_lag * free_gear * push;
    const ComplexPart torque_command = (own * free_gear + g * b) * push;
    const ComplexPart boresight_command = boresight * encoder_command;
    const ComplexPart gear_wind = g * blown;
    const ComplexPart tachometer_wind = rate_lag * gear_wind;
    const ComplexPart torque_wind = -(oil_damper * gear_wind);
    const ComplexPart encoder_wind = (g + a) * blown;
    const ComplexPart boresight_wind = boresight * encoder_wind + unseen;

    const ComplexPart rate = part<width>(panel.rate, k), pressure = part<width>(panel.pressure, k);
    const ComplexPart position = part<width>(panel.position, k);
    const ComplexPart bending = part<width>(panel.bending, k);
    const ComplexPart rate_return =
        ComplexPart{1.0, 0.0} + rate * tachometer_command + pressure * torque_command;
    const ComplexPart both_return =
        rate_return + position * (encoder_command - bending * torque_command);
    const RealPart rate_square = numerics::square(rate_return);
    const RealPart inverse_square = 1.0 / numerics::square(both_return);
    const ComplexPart both_inverse = numerics::conjugate(both_return) * inverse_square;
    set_part(values.rate_return, k, rate_return);
    set_part(values.both_return, k, both_return);
    set_part(values.sensitivity_square[0], k, 1.0 / rate_square);
    set_part(values.sensitivity_square[1], k, inverse_square);
    set_part(values.sensitivity_square[2], k, rate_square * inverse_square);
    // What the wind makes the controller demand, with the dead time.
    const ComplexPart demand = -(rate * tachometer_wind + pressure * torque_wind +
                                 position * (encoder_wind - bending * torque_wind)) *
                               both_inverse;
    const RealPart boresight_square = numerics::square(boresight_wind + boresight_command * demand);
    const RealPart wind_weight = part<width>(panel.wind, k);
    set_part(values.wind, k, wind_weight * boresight_square);
    set_part(values.effort, k, part<width>(panel.effort, k) * inverse_square);
    set_part(values.noise, k,
             part<width>(panel.noise, k) * inverse_square * numerics::square(boresight_command));
    if (held.climate_)
      set_part(values.climate, k, part<width>(panel.climate, k) * boresight_square);
    if (held.gusts_) {
      set_part(values.demand, k, wind_weight * numerics::square(demand));
      set_part(values.torque, k,
               wind_weight * numerics::square(torque_wind + torque_command * demand));
    }
  }
};

void FixedGainPanels::evaluate(const plant::AntennaPlant& plant, const std::uint32_t* panels,
                               std::size_t count) {
  numerics::run_on_widest_lanes<Evaluation>(*this, plant, panels, count);
}

bool FixedGainPanels::close_enough(std::uint32_t i, const Limits& limits) const {
  const Panel& panel = panels_[i];
  const double half_width = places_[i].half_width();
  if (half_width < control::AdaptivePanels::narrowest) return true;
  const Values& values = values_[i];
  const auto within = [&](const control::TailCoefficients& tail, double limit) {
    return control::PanelTail(tail).error_square() <= half_width * limit;
  };
  if (panel.weighted) {
    if (!within(values.boresight_tail, limits.boresight)) return false;
    if (panel.noisy && !within(values.effort_tail, limits.effort)) return false;
    if (climate_ && !within(values.climate_tail, limits.climate)) return false;
    if (gusts_ && (!within(values.demand_tail, limits.demand) ||
                   !within(values.torque_tail, limits.torque))) {
      return false;
    }
  }
  const auto resolved = [](double last, const ComplexPack& values_here) {
    return last <= return_tolerance * return_tolerance * largest(numerics::square(values_here));
  };
  return !control::any_negative(values.turn) &&
         resolved(last_coefficients(values.rate_tail_re, values.rate_tail_im),
                  values.rate_return) &&
         resolved(last_coefficients(values.both_tail_re, values.both_tail_im), values.both_return);
}

void FixedGainPanels::sweep(const plant::AntennaPlant& plant, double tolerance) {
  const std::vector<std::uint32_t>& first = places_.first();
  if (places_.drop_halves_if_too_many()) {
    panels_.resize(first.size());
    values_.resize(first.size());
  }
  evaluate(plant, first.data(), first.size());
  const auto add = [&](Sums& sums, std::uint32_t i) {
    const Values& values = values_[i];
    if (!panels_[i].weighted) return;
    sums.wind += numerics::sum(values.wind);
    sums.noise += numerics::sum(values.noise);
    sums.effort += numerics::sum(values.effort);
    if (climate_) sums.climate += numerics::sum(values.climate);
    if (gusts_) {
      sums.demand += numerics::sum(values.demand);
      sums.torque += numerics::sum(values.torque);
    }
  };
  Sums rough;
  for (const std::uint32_t i : first) add(rough, i);
  const auto limit = [&](double total) { return (tolerance * total) * (tolerance * total); };
  const Limits limits{limit(rough.wind + rough.noise), limit(rough.effort), limit(rough.climate),
                      limit(rough.demand), limit(rough.torque)};
  places_.choose(
      leaves_, [&](double from, double to) { add_panel(from, to); },
      [&](const std::uint32_t* panels, std::size_t count) { evaluate(plant, panels, count); },
      [&](std::uint32_t i) { return close_enough(i, limits); });
  sums_ = {};
  for (const std::uint32_t i : leaves_) add(sums_, i);
  if (!std::isfinite(sums_.wind + sums_.noise + sums_.effort + sums_.climate)) {
    throw NumericalFailure("FixedGainEvaluator: the plant's response is not finite");
  }
}

bool FixedGainPanels::stable() const {
  control::EncirclementCount rate(rate_integrators_);
  // The position loop has the antenna's own integration besides.
  control::EncirclementCount both(rate_integrators_ + position_integrators_ + 1);
  for (const std::uint32_t i : leaves_) {
    rate.add(values_[i].rate_return, pack_size);
    both.add(values_[i].both_return, pack_size);
  }
  const bool rate_loop = control::has_break(controller_, control::LoopBreak::rate_loop_alone);
  return (!rate_loop || rate.unstable() == 0) && both.unstable() == 0;
}

double FixedGainPanels::frequency(std::size_t point) const {
  return panels_[leaves_[point / pack_size]].frequency[point % pack_size];
}

double FixedGainPanels::sensitivity_square(std::size_t loop_break, std::size_t point) const {
  return values_[leaves_[point / pack_size]].sensitivity_square[loop_break][point % pack_size];
}

}  // namespace boresight::design

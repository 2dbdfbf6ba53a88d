#include <algorithm>
#include <cmath>

#include <boresight/control/loops/loop_winding.hpp>
#include <boresight/design/ensembles/held_panels.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/vector_clones.hpp>

namespace boresight::design {
namespace {

using control::panel_rule;
using numerics::ComplexPack;
using numerics::pack_size;
using numerics::RealPack;

// In ln w: the panels that every plant starts from, and the narrowest.
constexpr double widest_panel = 0.6;
constexpr double narrowest_panel = 1e-7;
// Of the largest value in a panel: how far a return may be from a polynomial of its points.
constexpr double return_tolerance = 0.1;
// Panels kept from plant to plant, some 3 kB each, and those of one plant.
constexpr std::size_t most_panels = 4000;
constexpr std::size_t most_leaves = 4000;

// Weights that take eight values to the last four coefficients of their Legendre series: of one
// function in the first four lanes, of another in the last four. Variances have the rule's weights
// in them already.
struct TailRule {
  std::array<RealPack, pack_size> first, second;
};

const TailRule& tail_rule() {
  static const TailRule rule = [] {
    TailRule made;
    for (std::size_t lane = 0; lane < pack_size; ++lane) {
      const RealPack weight = panel_rule().weight[lane];
      made.first[lane] = panel_rule().first_tail[lane] * weight;
      made.second[lane] = panel_rule().second_tail[lane] * weight;
    }
    return made;
  }();
  return rule;
}

[[gnu::always_inline]] inline ComplexPack inverse_of(const ComplexPack& x) {
  return numerics::conjugate(x) * RealPack(1.0 / numerics::square(x));
}

[[gnu::always_inline]] inline RealPack tails(const std::array<RealPack, pack_size>& first,
                                             const RealPack& x,
                                             const std::array<RealPack, pack_size>& second,
                                             const RealPack& y) {
  RealPack sum{};
#pragma GCC unroll 8
  for (std::size_t lane = 0; lane < pack_size; ++lane) {
    sum += first[lane] * x[lane] + second[lane] * y[lane];
  }
  return sum;
}

[[gnu::always_inline]] inline RealPack onward(const ComplexPack& x) {
  const RealPack::Lanes re =
      __builtin_shufflevector(x.re.lanes, x.re.lanes, 1, 2, 3, 4, 5, 6, 7, 7);
  const RealPack::Lanes im =
      __builtin_shufflevector(x.im.lanes, x.im.lanes, 1, 2, 3, 4, 5, 6, 7, 7);
  RealPack product;
  product.lanes = x.re.lanes * re + x.im.lanes * im;
  return product;
}

control::PanelTail tail(const RealPack& coefficients, std::size_t first) {
  const auto square = [&](std::size_t k) {
    return coefficients[first + k] * coefficients[first + k];
  };
  return {square(0) + square(1), square(2) + square(3)};
}

// The last two coefficients of a complex function, squared.
double last_coefficients(const RealPack& coefficients) {
  double sum = 0.0;
  for (const unsigned k : {2U, 3U, 6U, 7U}) sum += coefficients[k] * coefficients[k];
  return sum;
}

double largest(const RealPack& x) {
  double result = 0.0;
  for (std::size_t lane = 0; lane < pack_size; ++lane) result = std::max(result, x[lane]);
  return result;
}

}  // namespace

struct HeldPanels::Limits {
  double beam = 0.0, effort = 0.0, climate = 0.0, demand = 0.0, torque = 0.0;  // squares of errors
};

HeldPanels::HeldPanels(const TrackingProblem& problem, const control::ControlLaw& law, bool gusts)
    : band_(problem.rms_band),
      noise_(problem.noise),
      delay_(problem.delay),
      law_(law),
      gusts_(gusts),
      climate_(!problem.climate.empty()) {
  for (const auto& block : law.structure.blocks()) {
    if (block.kind != control::BlockKind::integral) continue;
    ++(block.path == control::LoopPath::rate ? rate_integrators_ : position_integrators_);
  }
  TrackingProblem at_speed = problem;
  at_speed.climate.clear();
  winds_.emplace_back(at_speed);
  if (climate_) winds_.emplace_back(problem);
  const auto [lowest, highest] = analysis_band(problem);
  std::vector<double> edges;
  for (const double edge : {lowest, highest, band_.lowest, band_.highest, noise_.bandwidth}) {
    if (edge >= lowest && edge <= highest) edges.push_back(std::log(two_pi * edge));
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
    const double width = edges[e + 1] - edges[e];
    if (width < narrowest_panel) continue;
    const double parts = std::ceil(width / widest_panel);
    for (double k = 0.0; k < parts; ++k) {
      first_.push_back(
          add_panel(edges[e] + width * k / parts, edges[e] + width * (k + 1.0) / parts));
    }
  }
}

std::uint32_t HeldPanels::add_panel(double from, double to) {
  const auto& rule = panel_rule();
  const double half_width = 0.5 * (to - from), centre = 0.5 * (from + to);
  const double per_band = 1.0 / noise_.bandwidth;
  Panel panel;
  panel.from = from;
  panel.to = to;
  const auto put = [](ComplexPack& place, std::size_t lane, std::complex<double> value) {
    place.re.set(lane, value.real());
    place.im.set(lane, value.imag());
  };
  for (std::size_t lane = 0; lane < pack_size; ++lane) {
    const double w = std::exp(centre + half_width * rule.node[lane]);
    const double hertz = w / two_pi;
    panel.frequency.set(lane, w);
    const auto law = control::compensator_response(law_, w);
    const auto dead_time = std::polar(1.0, -w * delay_);
    const auto position = law.rate * law.position;
    put(panel.rate, lane, law.rate * dead_time);
    put(panel.pressure, lane, law.pressure * dead_time);
    put(panel.position, lane, position * dead_time);
    put(panel.bending, lane, law.compliance);
    // Edges of the bands are edges of panels.
    if (hertz <= band_.lowest || hertz >= band_.highest) continue;
    const double weight = half_width * rule.weight[lane] * hertz;
    panel.wind.set(lane, weight * winds_[0].spectrum(w));
    if (climate_) panel.climate.set(lane, weight * winds_[1].spectrum(w));
    panel.weighted = true;
    if (hertz >= noise_.bandwidth) continue;
    const double demand =
        noise_.tachometer_rms * noise_.tachometer_rms * std::norm(law.rate) +
        noise_.encoder_rms * noise_.encoder_rms * std::norm(position) +
        noise_.torque_rms * noise_.torque_rms * std::norm(law.pressure - position * law.compliance);
    panel.effort.set(lane, weight * per_band * demand);
    panel.noisy = panel.noisy || demand > 0.0;
  }
  panels_.push_back(panel);
  values_.emplace_back();
  return static_cast<std::uint32_t>(panels_.size() - 1);
}

// The plant at eight frequencies as plant::PointResponse and drive_on_structure have it at one,
// then the loop as control::LoopEvaluator has it.
BORESIGHT_VECTOR_CLONES
void HeldPanels::evaluate(const plant::AntennaPlant& plant, const std::uint32_t* panels,
                          std::size_t count) {
  const TailRule& plain = tail_rule();
  const auto& rule = panel_rule();
  const auto& [drive, structure] = plant;
  const double wv = drive.valve_corner, wt = drive.tachometer_corner;
  for (std::size_t n = 0; n < count; ++n) {
    const Panel& panel = panels_[panels[n]];
    Values& values = values_[panels[n]];
    const RealPack w = panel.frequency;
    const RealPack w2 = w * w;
    ComplexPack b{-structure.bull_gear_inertia * w2, 0.0};
    ComplexPack wind{structure.bull_gear_wind_fraction, 0.0};
    ComplexPack beam{structure.bull_gear_beam_weight, 0.0};
    ComplexPack unseen{};
    for (const auto& mode : structure.modes) {
      const RealPack damping = mode.damping * w;
      const RealPack inertia = mode.inertia * w2;
      const ComplexPack inverse = inverse_of({mode.stiffness - inertia, damping});
      const ComplexPack follow = ComplexPack{mode.stiffness, damping} * inverse;
      b = b - follow * inertia;
      wind = wind + follow * mode.wind_fraction;
      beam = beam + follow * mode.beam_weight;
      unseen = unseen + inverse * (mode.wind_fraction * mode.beam_weight);
    }
    const ComplexPack valve =
        inverse_of({wv * wv - w2, 2.0 * drive.valve_damping * wv * w}) * RealPack(wv * wv);
    const ComplexPack oil = inverse_of({drive.leakage_rate, w}) * RealPack(drive.oil_stiffness);
    const ComplexPack lag = inverse_of({wt, w}) * RealPack(wt);
    const ComplexPack rate_lag{-w * lag.im, w * lag.re};  // s lag
    const ComplexPack oil_damper{-w * oil.im, w * oil.re};
    const ComplexPack own{-drive.motor_inertia * w2, drive.viscous_friction * w};
    const ComplexPack a = own + oil_damper;
    const ComplexPack g{structure.gear_stiffness, structure.gear_damping * w};
    // Determinant of [[g+a, -g], [-g, g+b]] without the cancelling g^2.
    const ComplexPack inverse = inverse_of(g * (a + b) + a * b);
    const ComplexPack push = oil * valve * inverse;
    const ComplexPack blown = wind * inverse;
    const ComplexPack free_gear = g + b;
    const ComplexPack encoder_command = g * push;
    const ComplexPack tachometer_command = rate_lag * free_gear * push;
    const ComplexPack torque_command = (own * free_gear + g * b) * push;
    const ComplexPack beam_command = beam * encoder_command;
    const ComplexPack gear_wind = g * blown;
    const ComplexPack tachometer_wind = rate_lag * gear_wind;
    const ComplexPack torque_wind = -(oil_damper * gear_wind);
    const ComplexPack encoder_wind = (g + a) * blown;
    const ComplexPack beam_wind = beam * encoder_wind + unseen;

    values.rate_return =
        ComplexPack{1.0, 0.0} + panel.rate * tachometer_command + panel.pressure * torque_command;
    values.both_return =
        values.rate_return + panel.position * (encoder_command - panel.bending * torque_command);
    const RealPack rate_square = numerics::square(values.rate_return);
    const RealPack inverse_square = 1.0 / numerics::square(values.both_return);
    const ComplexPack both_inverse = numerics::conjugate(values.both_return) * inverse_square;
    values.sensitivity_square[0] = 1.0 / rate_square;
    values.sensitivity_square[1] = inverse_square;
    values.sensitivity_square[2] = rate_square * inverse_square;
    // What the wind makes the law demand, with the dead time.
    const ComplexPack demand = -(panel.rate * tachometer_wind + panel.pressure * torque_wind +
                                 panel.position * (encoder_wind - panel.bending * torque_wind)) *
                               both_inverse;
    const RealPack beam_square = numerics::square(beam_wind + beam_command * demand);
    values.wind = panel.wind * beam_square;
    values.effort = panel.effort * inverse_square;
    values.noise = values.effort * numerics::square(beam_command);
    values.tail =
        tails(rule.first_tail, values.wind + values.noise, rule.second_tail, values.effort);
    if (climate_) {
      values.climate = panel.climate * beam_square;
      values.climate_tail =
          tails(rule.first_tail, values.climate, rule.second_tail, values.climate);
    }
    if (gusts_) {
      values.demand = panel.wind * numerics::square(demand);
      values.torque = panel.wind * numerics::square(torque_wind + torque_command * demand);
      values.gust_tail = tails(rule.first_tail, values.demand, rule.second_tail, values.torque);
    }
    values.rate_tail =
        tails(plain.first, values.rate_return.re, plain.second, values.rate_return.im);
    values.both_tail =
        tails(plain.first, values.both_return.re, plain.second, values.both_return.im);
    const RealPack rate_turn = onward(values.rate_return), both_turn = onward(values.both_return);
    bool turns = false;
    for (std::size_t lane = 0; lane < pack_size; ++lane) {
      turns |= rate_turn[lane] < 0.0 || both_turn[lane] < 0.0;
    }
    values.turns = turns;
  }
}

bool HeldPanels::close_enough(std::uint32_t i, const Limits& limits) const {
  const Panel& panel = panels_[i];
  const double half_width = 0.5 * (panel.to - panel.from);
  if (half_width < narrowest_panel) return true;
  const Values& values = values_[i];
  const auto within = [&](const RealPack& coefficients, std::size_t first, double limit) {
    return tail(coefficients, first).error_square() <= half_width * limit;
  };
  if (panel.weighted) {
    if (!within(values.tail, 0, limits.beam)) return false;
    if (panel.noisy && !within(values.tail, 4, limits.effort)) return false;
    if (climate_ && !within(values.climate_tail, 0, limits.climate)) return false;
    if (gusts_ && (!within(values.gust_tail, 0, limits.demand) ||
                   !within(values.gust_tail, 4, limits.torque))) {
      return false;
    }
  }
  const auto resolved = [](const RealPack& coefficients, const ComplexPack& values_here) {
    return last_coefficients(coefficients) <=
           return_tolerance * return_tolerance * largest(numerics::square(values_here));
  };
  return !values.turns && resolved(values.rate_tail, values.rate_return) &&
         resolved(values.both_tail, values.both_return);
}

void HeldPanels::sweep(const plant::AntennaPlant& plant, double tolerance) {
  if (panels_.size() > most_panels) {
    panels_.resize(first_.size());
    values_.resize(first_.size());
    for (Panel& panel : panels_) panel.first_half = 0;
  }
  evaluate(plant, first_.data(), first_.size());
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
  for (const std::uint32_t i : first_) add(rough, i);
  const auto limit = [&](double total) { return (tolerance * total) * (tolerance * total); };
  const Limits limits{limit(rough.wind + rough.noise), limit(rough.effort), limit(rough.climate),
                      limit(rough.demand), limit(rough.torque)};
  leaves_.clear();
  sums_ = {};
  // Each halving leaves one more to come back to.
  std::array<std::uint32_t, 64> waiting{};
  for (const std::uint32_t first : first_) {
    std::size_t count = 1;
    waiting[0] = first;
    while (count > 0) {
      const std::uint32_t i = waiting[--count];
      if (count + 2 > waiting.size() || leaves_.size() > most_leaves || close_enough(i, limits)) {
        leaves_.push_back(i);
        add(sums_, i);
        continue;
      }
      if (panels_[i].first_half == 0) {
        const double from = panels_[i].from, to = panels_[i].to, middle = 0.5 * (from + to);
        const std::uint32_t half = add_panel(from, middle);
        add_panel(middle, to);
        panels_[i].first_half = half;
      }
      const std::uint32_t half = panels_[i].first_half;
      const std::array<std::uint32_t, 2> halves{half, half + 1};
      evaluate(plant, halves.data(), halves.size());
      waiting[count++] = half + 1;
      waiting[count++] = half;
    }
  }
  if (!std::isfinite(sums_.wind + sums_.noise + sums_.effort + sums_.climate)) {
    throw NumericalFailure("HeldGainsEvaluator: the plant's response is not finite");
  }
}

bool HeldPanels::stable() const {
  control::Winding rate(rate_integrators_);
  // The position loop has the antenna's own integration besides.
  control::Winding both(rate_integrators_ + position_integrators_ + 1);
  for (const std::uint32_t i : leaves_) {
    rate.add(values_[i].rate_return, pack_size);
    both.add(values_[i].both_return, pack_size);
  }
  return rate.unstable() == 0 && both.unstable() == 0;
}

double HeldPanels::frequency(std::size_t point) const {
  return panels_[leaves_[point / pack_size]].frequency[point % pack_size];
}

double HeldPanels::sensitivity_square(std::size_t loop_break, std::size_t point) const {
  return values_[leaves_[point / pack_size]].sensitivity_square[loop_break][point % pack_size];
}

}  // namespace boresight::design

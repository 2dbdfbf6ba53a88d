#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/identification/lines/slosh_lines.hpp>
#include <boresight/identification/signals/damped_cosine.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/fourier_transform.hpp>
#include <boresight/numerics/statistics/pooled_mean.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

struct Port {
  std::size_t motor;
  LineSide side;
  const Signal* pressure;
  std::string name() const {
    return fmt::format("{} of motor {}", side == LineSide::inlet ? "inlet" : "outlet", motor + 1);
  }
};

std::vector<Port> ports_of(const DriveRecord& record) {
  std::vector<Port> ports;
  for (std::size_t motor = 0;
       motor < std::max(record.inlet_pressure.size(), record.outlet_pressure.size()); ++motor) {
    if (motor < record.inlet_pressure.size()) {
      ports.push_back({motor, LineSide::inlet, &record.inlet_pressure[motor]});
    }
    if (motor < record.outlet_pressure.size()) {
      ports.push_back({motor, LineSide::outlet, &record.outlet_pressure[motor]});
    }
  }
  return ports;
}

struct Band {
  double lowest, highest;
  double centre() const { return std::sqrt(lowest * highest); }
};

Band search_band(const DriveRecord& record, const DriveKnowledge& knowledge,
                 const SloshOptions& options) {
  Band band{options.lowest_frequency, options.highest_frequency};
  if (!knowledge.line_lengths.empty() && knowledge.oil_density.value > 0.0) {
    const auto [shortest, longest] =
        std::minmax_element(knowledge.line_lengths.begin(), knowledge.line_lengths.end(),
                            [](const numerics::Uncertain& a, const numerics::Uncertain& b) {
                              return a.value < b.value;
                            });
    band.lowest = plant::slosh_frequency(longest->value, options.lowest_bulk_modulus,
                                         knowledge.oil_density.value);
    band.highest = plant::slosh_frequency(shortest->value, options.highest_bulk_modulus,
                                          knowledge.oil_density.value);
  }
  band.highest = std::min(band.highest, 0.45 / record.sample_time);
  if (!(band.lowest < 0.25 / record.sample_time)) {
    throw InvalidInput(fmt::format(
        "identify_slosh: record '{}' has {:.0f} samples/s; lines whose slosh frequency may be as "
        "low as {:.1f} Hz need more than {:.0f}",
        record.name, 1.0 / record.sample_time, band.lowest, 4.0 * band.lowest));
  }
  return band;
}

// What one port's ringing after one event is.
struct PortFit {
  bool usable = false;
  RingFit fit;
  Index first = 0;
};

double invalid_fraction(const Signal& signal, Index first, Index samples) {
  if (signal.valid.empty()) return 0.0;
  const auto begin = signal.valid.begin() + first;
  return static_cast<double>(std::count(begin, begin + samples, false)) /
         static_cast<double>(samples);
}

struct EventWindow {
  Index first = 0;
  Index samples = 0;
};

struct PortPole {
  bool usable = false;
  RingPole pole;
};

// Other ports' poles that are neither this one's nor one another's.
std::vector<RingPole> cross_talk(const std::vector<PortPole>& fits, std::size_t own, double apart) {
  std::vector<RingPole> poles;
  const auto separate = [apart](const RingPole& a, const RingPole& b) {
    return std::abs(a.damped_frequency - b.damped_frequency) > apart;
  };
  for (std::size_t other = 0; other < fits.size(); ++other) {
    if (other == own || !fits[other].usable || !separate(fits[other].pole, fits[own].pole)) {
      continue;
    }
    const auto& pole = fits[other].pole;
    if (std::all_of(poles.begin(), poles.end(),
                    [&](const RingPole& taken) { return separate(taken, pole); })) {
      poles.push_back(pole);
    }
  }
  return poles;
}

bool credible(const PortFit& fit, const Band& band) {
  const auto& mode = fit.fit.modes.front();
  return mode.natural_frequency.standard_uncertainty < 0.005 * mode.natural_frequency.value &&
         mode.pole.damped_frequency > 1.001 * band.lowest &&
         mode.pole.damped_frequency < 0.999 * band.highest &&
         std::abs(mode.amplitude(0)) > 2.0 * fit.fit.residual_rms(0);
}

std::vector<PortFit> fit_event(const DriveRecord& record, const std::vector<Port>& ports,
                               const EventWindow& window, const Band& band,
                               const SloshOptions& options) {
  const double dt = record.sample_time;
  RingFitOptions ring;
  ring.low_frequency_limit = 0.5 * band.lowest;
  ring.largest_damping_ratio = options.largest_damping_ratio;
  std::vector<PortFit> fits(ports.size());
  std::vector<PortPole> poles(ports.size());
  const auto fit_port = [&](std::size_t k, Index samples, const RingPole& start) {
    if (!can_fit_rings(samples, dt, 1, ring)) {
      fits[k].usable = poles[k].usable = false;
      return;
    }
    const Eigen::MatrixXd pressure = ports[k].pressure->values.segment(window.first, samples);
    fits[k].fit = fit_damped_cosines(pressure, dt, {start}, ring);
    fits[k].usable = credible(fits[k], band);
    poles[k] = {fits[k].usable, fits[k].fit.modes.front().pole};
    fits[k].first = window.first;
  };
  // Alone over the longest window, to see how long each rings.
  for (std::size_t k = 0; k < ports.size(); ++k) {
    if (invalid_fraction(*ports[k].pressure, window.first, window.samples) >
        options.invalid_fraction) {
      continue;
    }
    const Eigen::MatrixXd pressure =
        ports[k].pressure->values.segment(window.first, window.samples);
    const auto starts = ring_starts(pressure, dt, 1, band.lowest, band.highest, ring);
    if (!starts.empty()) fit_port(k, window.samples, starts.front());
  }
  // Then beside the others' cross-talk, for as long as it rings.
  for (int pass = 0; pass < 2; ++pass) {
    const std::vector<PortPole> before(poles.begin(), poles.end());
    for (std::size_t k = 0; k < ports.size(); ++k) {
      if (!before[k].usable) continue;
      const double length =
          std::max(options.time_constants / before[k].pole.decay_rate, 10.0 / band.lowest);
      const Index samples = std::min(window.samples, static_cast<Index>(std::llround(length / dt)));
      ring.fixed_poles = cross_talk(before, k, 0.6 / (static_cast<double>(samples) * dt));
      fit_port(k, samples, before[k].pole);
    }
  }
  return fits;
}

RingingPlot plot_of(const Port& port, const PortFit& fit, double sample_time) {
  RingingPlot plot;
  plot.motor = port.motor;
  plot.side = port.side;
  plot.start = static_cast<double>(fit.first) * sample_time;
  plot.fitted = fit.fit.oscillation.col(0);
  plot.pressure = plot.fitted + fit.fit.residual.col(0);
  const Index samples = plot.pressure.size();
  const Index padded = numerics::fast_transform_length(4 * samples);
  const auto amplitude = [&](const VectorXd& signal) {
    VectorXd longer = VectorXd::Zero(padded);
    longer.head(samples) = signal;
    return VectorXd(numerics::fourier_transform(longer).cwiseAbs() * 2.0 /
                    static_cast<double>(samples));
  };
  plot.amplitude = amplitude(plot.pressure);
  plot.fitted_amplitude = amplitude(plot.fitted);
  plot.frequency = VectorXd::LinSpaced(
      plot.amplitude.size(), 0.0,
      static_cast<double>(plot.amplitude.size() - 1) / (static_cast<double>(padded) * sample_time));
  return plot;
}

}  // namespace

SloshResult identify_slosh(const DriveRecord& record, const DriveKnowledge& knowledge,
                           const SloshOptions& options) {
  const auto ports = ports_of(record);
  if (ports.empty() || record.samples() < 2 || !(record.sample_time > 0.0)) {
    throw InvalidInput(fmt::format(
        "identify_slosh: expected a record with port pressures, found {} ports and {} samples in "
        "'{}'",
        ports.size(), record.samples(), record.name));
  }
  const Band band = search_band(record, knowledge, options);
  SloshResult result;
  result.events = slosh_events(record, band.lowest, band.highest, options);
  const double dt = record.sample_time;

  std::vector<std::vector<PortFit>> fits;
  std::size_t strongest = 0;
  double strongest_amplitude = 0.0;
  for (std::size_t k = 0; k < result.events.size(); ++k) {
    const auto settled = static_cast<Index>(
        std::llround((result.events[k].time + options.settling_periods / band.centre()) / dt));
    Index end = record.samples();
    if (k + 1 < result.events.size()) {
      end = static_cast<Index>(std::llround(result.events[k + 1].time / dt)) - 2;
    }
    EventWindow window{
        settled,
        std::min(end - settled, static_cast<Index>(std::llround(options.longest_window / dt)))};
    if (static_cast<double>(window.samples) * dt < 8.0 / band.lowest) {
      result.notes.push_back(fmt::format(
          "the ringing from {:.3f} s is left out: only {:.3f} s until the next event or the end",
          result.events[k].time, static_cast<double>(std::max<Index>(window.samples, 0)) * dt));
      fits.emplace_back(ports.size());
      continue;
    }
    fits.push_back(fit_event(record, ports, window, band, options));
    double amplitude = 0.0;
    for (const auto& fit : fits.back()) {
      if (fit.usable) amplitude += std::abs(fit.fit.modes.front().amplitude(0));
    }
    if (amplitude > strongest_amplitude) {
      strongest_amplitude = amplitude;
      strongest = k;
    }
  }

  for (std::size_t port = 0; port < ports.size(); ++port) {
    std::vector<numerics::Uncertain> frequencies, dampings;
    for (const auto& event : fits) {
      if (!event[port].usable) continue;
      const auto& mode = event[port].fit.modes.front();
      frequencies.push_back(
          {mode.natural_frequency.value, std::max(mode.natural_frequency.standard_uncertainty,
                                                  1e-6 * mode.natural_frequency.value)});
      dampings.push_back(
          {mode.damping_ratio.value, std::max(mode.damping_ratio.standard_uncertainty, 1e-6)});
    }
    if (frequencies.empty()) {
      result.notes.push_back(
          fmt::format("the {}: no ringing between {:.1f} and {:.1f} Hz stands out; not used",
                      ports[port].name(), band.lowest, band.highest));
      continue;
    }
    const auto frequency = numerics::pooled_mean(frequencies);
    const auto damping = numerics::pooled_mean(dampings);
    LineRinging line;
    line.motor = ports[port].motor;
    line.side = ports[port].side;
    line.frequency =
        numerics::normal_interval(frequency.mean.value, frequency.mean.standard_uncertainty);
    line.damping_ratio =
        numerics::normal_interval(damping.mean.value, damping.mean.standard_uncertainty);
    line.damping_ratio.lower = std::max(0.0, line.damping_ratio.lower);
    line.events = frequencies.size();
    line.between_events = frequency.between;
    result.lines.push_back(line);
    if (fits[strongest][port].usable) {
      result.plots.push_back(plot_of(ports[port], fits[strongest][port], dt));
    }
  }
  if (result.lines.empty()) {
    throw NumericalFailure(fmt::format(
        "identify_slosh: no line of record '{}' rings between {:.1f} and {:.1f} Hz after any of {} "
        "events; expected the valve opened or closed suddenly with the rate loop open",
        record.name, band.lowest, band.highest, result.events.size()));
  }

  const auto motors = std::max(record.inlet_pressure.size(), record.outlet_pressure.size());
  add_bulk_moduli(result, knowledge, motors);
  return result;
}

}  // namespace boresight::identification

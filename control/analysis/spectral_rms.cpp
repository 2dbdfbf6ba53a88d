#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include <boresight/control/analysis/spectral_rms.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

// Kronrod's 15 points and weights on (-1, 1), non-negative half from the outside in, and Gauss's
// weights for every second of them (R. Piessens et al., QUADPACK, Springer 1983, qk15).
constexpr std::array<double, 8> node{
    0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
    0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
    0.586087235467691130294144691693013, 0.405845151377397166906606412076961,
    0.207784955007898467600689403773245, 0.0};
constexpr std::array<double, 8> kronrod{
    0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
    0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
    0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
    0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
constexpr std::array<double, 4> gauss{
    0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
    0.381830050505118944950369775488975, 0.417959183673469387755102040816327};
constexpr Eigen::Index points = 15;

// Part of the axis of ln w.
struct Panel {
  double low, high;
  double integral = 0.0;
  double error = 0.0;
};

class Integrand {
 public:
  Integrand(const plant::ModalResponse& response, const SpectralRmsOptions& options)
      : response_(response), options_(options) {}

  // |H|^2 S w/(2 pi) at each ln w.
  const Eigen::ArrayXd& at(const Eigen::ArrayXd& log_frequency) {
    const Eigen::ArrayXd frequency = log_frequency.exp();
    response_.evaluate(frequency, values_);
    evaluations_ += static_cast<std::size_t>(frequency.size());
    density_ = values_.abs2() * frequency / std::numbers::pi;
    if (options_.spectrum) {
      for (Eigen::Index i = 0; i < density_.size(); ++i) {
        density_[i] *= 0.5 * options_.spectrum(0.5 * frequency[i] / std::numbers::pi);
      }
    }
    for (Eigen::Index i = 0; i < density_.size(); ++i) {
      if (std::isfinite(density_[i]) && density_[i] >= 0.0) continue;
      throw NumericalFailure(fmt::format(
          "spectral_rms: expected a finite response and spectrum, found {} at {} rad/s; "
          "remove the pole on the axis, or see that the system is stable",
          density_[i], frequency[i]));
    }
    return density_;
  }
  double at(double log_frequency) { return at(Eigen::ArrayXd::Constant(1, log_frequency))[0]; }
  std::size_t evaluations() const { return evaluations_; }

 private:
  const plant::ModalResponse& response_;
  const SpectralRmsOptions& options_;
  Eigen::ArrayXcd values_;
  Eigen::ArrayXd density_;
  std::size_t evaluations_ = 0;
};

// Kronrod's integral of panels from `first` on, and the estimate of its error.
void integrate(Integrand& integrand, std::vector<Panel>& panels, std::size_t first) {
  const auto count = static_cast<Eigen::Index>(panels.size() - first);
  Eigen::ArrayXd x(count * points);
  for (Eigen::Index p = 0; p < count; ++p) {
    const Panel& panel = panels[first + static_cast<std::size_t>(p)];
    const double centre = 0.5 * (panel.low + panel.high), half = 0.5 * (panel.high - panel.low);
    for (Eigen::Index k = 0; k < points; ++k) {
      const auto mirrored = static_cast<std::size_t>(k < 8 ? k : points - 1 - k);
      x[p * points + k] = centre + (k < 8 ? -half : half) * node[mirrored];
    }
  }
  const Eigen::ArrayXd& f = integrand.at(x);
  for (Eigen::Index p = 0; p < count; ++p) {
    Panel& panel = panels[first + static_cast<std::size_t>(p)];
    const double half = 0.5 * (panel.high - panel.low);
    double fine = 0.0, coarse = 0.0;
    for (Eigen::Index k = 0; k < points; ++k) {
      const auto mirrored = static_cast<std::size_t>(k < 8 ? k : points - 1 - k);
      fine += kronrod[mirrored] * f[p * points + k];
      if (mirrored % 2 == 1) coarse += gauss[mirrored / 2] * f[p * points + k];
    }
    double spread = 0.0;  // integral of |f - mean|
    for (Eigen::Index k = 0; k < points; ++k) {
      const auto mirrored = static_cast<std::size_t>(k < 8 ? k : points - 1 - k);
      spread += kronrod[mirrored] * std::abs(f[p * points + k] - 0.5 * fine);
    }
    panel.integral = half * fine;
    // QUADPACK's reading of the difference of the two rules.
    const double difference = std::abs(fine - coarse);
    panel.error = half * difference;
    if (spread > 0.0 && difference > 0.0) {
      panel.error = half * spread * std::min(1.0, std::pow(200.0 * difference / spread, 1.5));
    }
  }
}

struct Resonance {
  double log_frequency;
  double damping_ratio;
};

std::vector<Resonance> resonances(const plant::ModalResponse& response) {
  std::vector<Resonance> found;
  const auto& reduction = response.reduction();
  for (Eigen::Index i = 0; i < reduction.mode_frequency.size(); ++i) {
    const double w = reduction.mode_frequency[i];
    if (w > 0.0 && reduction.mode_damping_ratio[i] < 0.3) {
      found.push_back({std::log(w), reduction.mode_damping_ratio[i]});
    }
  }
  for (const auto& pole : response.core().poles) {
    const double size = std::abs(pole);
    if (pole.imag() > 0.0 && std::abs(pole.real()) < 0.3 * size) {
      found.push_back({std::log(size), std::abs(pole.real()) / size});
    }
  }
  return found;
}

// ln of the lowest and highest magnitude of a pole, a decade beyond.
std::pair<double, double> pole_range(const plant::ModalResponse& response) {
  std::vector<double> sizes;
  for (const auto& pole : response.core().poles) {
    if (std::abs(pole) > 0.0) sizes.push_back(std::abs(pole));
  }
  const auto& reduction = response.reduction();
  for (const double w : reduction.mode_frequency) {
    if (w > 0.0) sizes.push_back(w);
  }
  for (const auto& back : reduction.returns) {
    if (back.is_dead_time && back.delay > 0.0) sizes.push_back(1.0 / back.delay);
  }
  if (!response.core_by_modes()) sizes.push_back(std::max(1.0, reduction.core.a.norm()));
  if (sizes.empty()) sizes.push_back(1.0);
  const auto [lowest, highest] = std::minmax_element(sizes.begin(), sizes.end());
  return {std::log(*lowest) - std::numbers::ln10, std::log(*highest) + std::numbers::ln10};
}

}  // namespace

SpectralRms spectral_rms(const plant::ModalResponse& response, const SpectralRmsOptions& options) {
  if (!(options.relative_tolerance >= 1e-13) || options.relative_tolerance > 0.1) {
    throw InvalidInput(
        fmt::format("spectral_rms: expected a relative tolerance of 1e-13 to 0.1, found {}",
                    options.relative_tolerance));
  }
  Integrand integrand(response, options);
  auto [low, high] = pole_range(response);
  // Panels of half an e-fold to begin with; one with a border at each resonance of weight.
  std::vector<double> borders;
  const auto steps = static_cast<int>(std::ceil(2.0 * (high - low)));
  for (int i = 0; i <= steps; ++i) borders.push_back(low + (high - low) * i / steps);
  const auto lightly_damped = resonances(response);
  if (!lightly_damped.empty()) {
    Eigen::ArrayXd x(static_cast<Eigen::Index>(lightly_damped.size()));
    for (std::size_t i = 0; i < lightly_damped.size(); ++i) {
      x[static_cast<Eigen::Index>(i)] = lightly_damped[i].log_frequency;
    }
    const Eigen::ArrayXd weight = integrand.at(x);
    const Eigen::ArrayXd plain =
        integrand.at(Eigen::Map<const Eigen::ArrayXd>(borders.data(), steps + 1).eval());
    const double rough = plain.sum() * (high - low) / steps;
    for (std::size_t i = 0; i < lightly_damped.size(); ++i) {
      const double zeta = lightly_damped[i].damping_ratio;
      if (weight[static_cast<Eigen::Index>(i)] * zeta < options.relative_tolerance * rough)
        continue;
      for (const double beside : {-4.0 * zeta, 0.0, 4.0 * zeta}) {
        borders.push_back(lightly_damped[i].log_frequency + beside);
      }
    }
    std::sort(borders.begin(), borders.end());
  }
  std::vector<Panel> panels;
  for (std::size_t i = 1; i < borders.size(); ++i) {
    if (borders[i] - borders[i - 1] > 1e-9) panels.push_back({borders[i - 1], borders[i]});
  }
  low = panels.front().low;
  high = panels.back().high;
  integrate(integrand, panels, 0);
  const auto total = [&] {
    double sum = 0.0;
    for (const Panel& panel : panels) sum += panel.integral;
    return sum;
  };

  // Decade by decade outwards until what lies beyond does not count: below, a flat density in w;
  // above, a falling power of w.
  constexpr int max_decades = 40;
  const double fraction = 0.01 * options.relative_tolerance;
  double tails = integrand.at(low);
  for (int decade = 0; decade < max_decades && tails > fraction * total(); ++decade) {
    panels.push_back({low - std::numbers::ln10, low});
    low -= std::numbers::ln10;
    integrate(integrand, panels, panels.size() - 1);
    tails = integrand.at(low);
  }
  double above = integrand.at(high), falling = 0.0;
  for (int decade = 0; decade < max_decades; ++decade) {
    falling = std::log(integrand.at(high - 1.0) / above);
    if (above <= fraction * total() && (falling > 0.5 || above == 0.0)) break;
    panels.push_back({high, high + std::numbers::ln10});
    high += std::numbers::ln10;
    integrate(integrand, panels, panels.size() - 1);
    above = integrand.at(high);
    if (decade + 1 == max_decades || !(above <= total() * 1e6)) {
      throw NumericalFailure(
          fmt::format("spectral_rms: expected a response that falls off with frequency, found a "
                      "density of {:.3g} of the total per e-fold at {:.3g} rad/s; white noise "
                      "through a feedthrough has no finite rms",
                      above / total(), std::exp(high)));
    }
  }
  if (above > 0.0) tails += above / falling;

  // Halve what is not exact enough, a generation at a time.
  SpectralRms result;
  while (true) {
    const double integral = total() + tails;
    double error = tails;
    for (const Panel& panel : panels) error += panel.error;
    result.rms = std::sqrt(integral);
    result.evaluations = integrand.evaluations();
    result.relative_error = integral > 0.0 ? 0.5 * error / integral : 0.0;
    result.converged = result.relative_error <= options.relative_tolerance;
    if (result.converged) break;
    const double allowed =
        options.relative_tolerance * integral / static_cast<double>(panels.size());
    std::vector<Panel> halves;
    for (Panel& panel : panels) {
      if (panel.error <= allowed || panel.high - panel.low < 1e-12) continue;
      const double centre = 0.5 * (panel.low + panel.high);
      halves.push_back({centre, panel.high});
      halves.push_back({panel.low, centre});
      panel.high = panel.low;  // to be left out
    }
    std::erase_if(panels, [](const Panel& panel) { return panel.high <= panel.low; });
    const auto more = static_cast<std::size_t>(points) * halves.size();
    if (halves.empty() || result.evaluations + more > options.max_evaluations) break;
    const std::size_t first = panels.size();
    panels.insert(panels.end(), halves.begin(), halves.end());
    integrate(integrand, panels, first);
  }
  return result;
}

}  // namespace boresight::control

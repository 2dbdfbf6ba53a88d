#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <boresight/identification/grey_box/grey_box_hydraulics.hpp>
#include <boresight/identification/grey_box/grey_box_information_gain.hpp>
#include <boresight/identification/grey_box/grey_box_mechanics.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/numerics/semidefinite_factor.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Between -1 and 1, from 0 upwards.
double triangle(double time, double period) {
  const double place = time / period - std::floor(time / period);
  if (place < 0.25) return 4.0 * place;
  return place < 0.75 ? 2.0 - 4.0 * place : 4.0 * place - 4.0;
}

GreyBoxManoeuvre manoeuvre(const std::string& name, TestKind kind, double sample_time,
                           double length, bool closed,
                           const std::function<double(double)>& command) {
  GreyBoxManoeuvre m;
  m.name = name;
  m.test = kind;
  m.sample_time = sample_time;
  m.rate_loop_closed = closed;
  m.command.resize(static_cast<Index>(length / sample_time));
  for (Index k = 0; k < m.command.size(); ++k) {
    m.command(k) = command(static_cast<double>(k) * sample_time);
  }
  return m;
}

// Derivatives of every quantity by the point, central differences: quantities x parameters.
MatrixXd quantities_by_point(const GreyBoxParameters& parameters, const VectorXd& point) {
  const auto& quantities = drive_quantities();
  MatrixXd by(static_cast<Index>(quantities.size()), point.size());
  constexpr double step = 1e-4;
  for (Index i = 0; i < point.size(); ++i) {
    VectorXd moved = point;
    moved(i) += step;
    const auto more = drive_estimate(parameters, moved);
    moved(i) -= 2.0 * step;
    const auto less = drive_estimate(parameters, moved);
    for (Index q = 0; q < by.rows(); ++q) {
      const auto member = quantities[static_cast<std::size_t>(q)].member;
      by(q, i) = (more.*member - less.*member) / (2.0 * step);
    }
  }
  return by;
}

// Fisher information of a simulated record, errors of both halves in units of the given scales.
MatrixXd information(const GreyBoxParameters& parameters, const VectorXd& point,
                     const GreyBoxRecord& record, double rate_scale, double pressure_scale) {
  VectorXd errors;
  MatrixXd by;
  const auto c = parameters.mechanical(point);
  predict_rate(record, c.values, errors, &by);
  for (Index k = 0; k < errors.size(); ++k) {
    if (!record.rate_counts[static_cast<std::size_t>(k)]) by.col(k).setZero();
  }
  MatrixXd sum =
      c.by_point.transpose() * (by * by.transpose()) * c.by_point / (rate_scale * rate_scale);
  if (pressure_scale > 0.0) {
    const auto hc = parameters.hydraulic(point, true);
    predict_pressures(record, parameters.units(), hc.values, errors, &by);
    for (Index k = 0; k < errors.size(); ++k) {
      if (!record.pressure_counts[static_cast<std::size_t>(k / 2)]) by.col(k).setZero();
    }
    sum += hc.by_point.transpose() * (by * by.transpose()) * hc.by_point /
           (pressure_scale * pressure_scale);
  }
  return sum;
}

}  // namespace

std::vector<GreyBoxManoeuvre> campaign_tests(const GreyBoxResult& result, double largest_rate) {
  const double h = result.sample_time;
  const double w = largest_rate;
  const auto square = [](double time) {
    if (time < 2.0) return 0.0;
    return std::fmod(time - 2.0, 18.0) < 9.0 ? 1.0 : -1.0;
  };
  std::vector<GreyBoxManoeuvre> tests;
  tests.push_back(manoeuvre("slosh", TestKind::slosh, h, 10.0, false,
                            [=](double t) { return t > 1.0 && t < 2.0 ? 0.8 * w : 0.0; }));
  tests.push_back(manoeuvre("fast ramp", TestKind::fast_ramp, h, 64.0, false,
                            [=](double t) { return w * triangle(t, 16.0); }));
  tests.push_back(manoeuvre("slow ramp", TestKind::slow_ramp, h, 120.0, true,
                            [=](double t) { return 0.03 * w * triangle(t, 60.0); }));
  for (const auto& [name, level] :
       {std::pair{"constant speed, slow", 0.03}, std::pair{"constant speed, middle", 0.1},
        std::pair{"constant speed, fast", 0.4}}) {
    tests.push_back(manoeuvre(name, TestKind::constant_speed, h, 56.0, true,
                              [=](double t) { return level * w * square(t); }));
  }
  tests.push_back(manoeuvre("valve steps", TestKind::valve_steps, h, 80.0, false, [=](double t) {
    // Dwell of 2 to 5 s by the golden section: irregular, but always the same.
    double step = 0.05, until = 2.0;
    for (int k = 1; until < t; ++k) {
      until += 2.0 + 3.0 * std::fmod(k * std::numbers::phi, 1.0);
      step = -step;
    }
    return t < 1.0 ? 0.0 : w * (0.2 + step);
  }));
  tests.push_back(manoeuvre("valve sweep", TestKind::valve_chirp, h, 100.0, false, [=](double t) {
    const double growth = std::log(80.0) / 100.0;  // 0.1 to 8 Hz
    const double phase = two_pi * 0.1 / growth * (std::exp(growth * t) - 1.0);
    return w * (0.2 + 0.1 * std::sin(phase));
  }));
  return tests;
}

std::vector<GreyBoxInformationGain> rank_tests(const GreyBoxResult& result,
                                               const Campaign& campaign,
                                               const std::string& quantity) {
  const GreyBoxParameters& parameters = result.model.at(0);
  const GreyBoxPosterior& posterior = result.posterior;
  const Index n = posterior.point.size();
  const MatrixXd identity = MatrixXd::Identity(n, n);
  static_cast<void>(result.quantity(quantity));
  const auto& quantities = result.quantities;
  const auto wanted = static_cast<std::size_t>(
      std::find_if(quantities.begin(), quantities.end(),
                   [&](const GreyBoxQuantity& q) { return q.name == quantity; }) -
      quantities.begin());

  double largest_rate = 0.0;
  for (const auto& record : campaign.records) {
    if (record.samples() > 0) {
      largest_rate = std::max(largest_rate, record.motor_rate.values.cwiseAbs().maxCoeff());
    }
  }
  const MatrixXd by = quantities_by_point(parameters, posterior.point);
  const MatrixXd removable = posterior.covariance - posterior.misfit;
  const VectorXd before = (by * removable * by.transpose()).diagonal();
  const MatrixXd precision =
      numerics::positive_definite_solve(removable, identity, "posterior covariance");
  // Pressures count in a test to come even where no valve command was recorded before: by the
  // fraction of the torque that the rate's errors stand for.
  const double pressure_scale =
      result.pressure_scale > 0.0 ? result.pressure_scale : 0.01 * result.estimate.coulomb_level;
  std::vector<GreyBoxInformationGain> gains;
  for (const auto& test : campaign_tests(result, largest_rate)) {
    const GreyBoxRecord record = simulate_drive(parameters, posterior.point, test);
    const MatrixXd gained =
        information(parameters, posterior.point, record, result.rate_scale, pressure_scale) /
        posterior.inflation;
    MatrixXd more = precision + gained;
    more = (0.5 * (more + more.transpose())).eval();
    const VectorXd after =
        (by * numerics::positive_definite_solve(more, identity, "precision after a test") *
         by.transpose())
            .diagonal();
    GreyBoxInformationGain gain;
    gain.test = test.name;
    gain.kind = test.test;
    gain.done_before = std::any_of(campaign.records.begin(), campaign.records.end(),
                                   [&](const DriveRecord& r) { return r.test == test.test; });
    for (Index q = 0; q < by.rows(); ++q) {
      // Misfit and discrepancies stay: what the interval has beyond the removable part.
      const double all =
          std::pow(quantities[static_cast<std::size_t>(q)].posterior.standard_uncertainty, 2);
      const double kept = std::max(0.0, all - before(q));
      const double first = before(q) + kept;
      gain.remaining.push_back(first > 0.0 ? std::sqrt((std::max(0.0, after(q)) + kept) / first)
                                           : 1.0);
    }
    gains.push_back(gain);
  }
  std::stable_sort(gains.begin(), gains.end(), [&](const auto& a, const auto& b) {
    return a.remaining[wanted] < b.remaining[wanted];
  });
  return gains;
}

}  // namespace boresight::identification

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <boresight/identification/signals/local_polynomial_response.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/fourier_transform.hpp>
#include <boresight/numerics/linear_solve.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;

struct Bins {
  Index first = 0;  // of the band
  Index count = 0;
};

Bins bins_of(Index samples, double sample_time, const LocalPolynomialOptions& options) {
  const double bin = 1.0 / (sample_time * static_cast<double>(samples));
  const Index highest_bin = (samples - 1) / 2;
  // Bin 0 holds what was taken out.
  const Index first =
      std::max(static_cast<Index>(std::ceil(options.lowest_frequency / bin - 1e-9)), Index{1});
  const Index last =
      std::min(static_cast<Index>(std::floor(options.highest_frequency / bin + 1e-9)), highest_bin);
  return {first, last - first + 1};
}

void check(Index samples, const Eigen::MatrixXd& outputs, double sample_time,
           const LocalPolynomialOptions& options) {
  if (outputs.rows() != samples || outputs.cols() < 1) {
    throw InvalidInput(fmt::format(
        "local_polynomial_response: expected outputs as long as the input ({} samples), found {} x "
        "{}",
        samples, outputs.rows(), outputs.cols()));
  }
  const bool in_range = sample_time > 0.0 && options.lowest_frequency > 0.0 &&
                        options.highest_frequency > options.lowest_frequency &&
                        std::isfinite(options.highest_frequency) && options.degree >= 0 &&
                        options.degree <= 6 && options.half_width > options.degree + 1;
  if (!in_range) {
    throw InvalidInput(fmt::format(
        "local_polynomial_response: expected a positive sample time, 0 < lowest < highest "
        "frequency, a degree of 0 to 6 and a half width of two more at least, found {} s, {} and "
        "{} Hz, {} and {}",
        sample_time, options.lowest_frequency, options.highest_frequency, options.degree,
        options.half_width));
  }
  const Index bins = bins_of(samples, sample_time, options).count;
  if (bins < 1 || samples / 2 < 2 * options.half_width + 2) {
    throw InvalidInput(fmt::format(
        "local_polynomial_response: expected a record that resolves {:g} to {:g} Hz, found {:g} s "
        "at {:g} Hz: use a longer record or a wider band",
        options.lowest_frequency, options.highest_frequency,
        sample_time * static_cast<double>(samples), 1.0 / sample_time));
  }
}

Eigen::VectorXd without_line(const Eigen::Ref<const Eigen::VectorXd>& series) {
  const Eigen::VectorXd place = Eigen::VectorXd::LinSpaced(series.size(), -1.0, 1.0);
  const double slope = place.dot(series) / place.squaredNorm();
  return (series.array() - series.mean() - slope * place.array()).matrix();
}

}  // namespace

MultipleResponseEstimate local_polynomial_response(const Eigen::VectorXd& input,
                                                   const Eigen::MatrixXd& outputs,
                                                   double sample_time,
                                                   const LocalPolynomialOptions& options) {
  const Index samples = input.size(), channels = outputs.cols();
  check(samples, outputs, sample_time, options);
  const Eigen::VectorXcd u = numerics::fourier_transform(without_line(input));
  Eigen::MatrixXcd y(u.size(), channels);
  for (Index c = 0; c < channels; ++c) {
    y.col(c) = numerics::fourier_transform(without_line(outputs.col(c)));
  }

  const Bins bins = bins_of(samples, sample_time, options);
  const Index half = options.half_width, rows = 2 * half + 1;
  const Index terms = options.degree + 1;
  MultipleResponseEstimate estimate;
  estimate.degrees_of_freedom = rows - 2 * terms;
  estimate.frequency.resize(bins.count);
  estimate.response.resize(bins.count, channels);
  estimate.coherence.resize(bins.count, channels);
  estimate.covariance.reserve(static_cast<std::size_t>(bins.count));
  const auto freedom = static_cast<double>(estimate.degrees_of_freedom);
  const double bin = 1.0 / (sample_time * static_cast<double>(samples));
  Eigen::MatrixXcd columns(rows, 2 * terms);
  Eigen::MatrixXcd unit = Eigen::MatrixXcd::Zero(2 * terms, 1);
  unit(0, 0) = 1.0;
  for (Index i = 0; i < bins.count; ++i) {
    // At the spectrum's ends the window of bins stands to one side of its frequency.
    const Index centre = bins.first + i;
    const Index first = std::clamp<Index>(centre - half, 1, u.size() - 1 - rows);
    const double scale = u.segment(first, rows).norm() / std::sqrt(static_cast<double>(rows));
    for (Index r = 0; r < rows; ++r) {
      const double place = static_cast<double>(first + r - centre) / static_cast<double>(half);
      double power = 1.0;
      for (Index t = 0; t < terms; ++t, power *= place) {
        columns(r, t) = power * u[first + r] / scale;
        columns(r, terms + t) = power;
      }
    }
    const auto measured = y.middleRows(first, rows);
    const Eigen::MatrixXcd normal = columns.adjoint() * columns;
    Eigen::MatrixXcd right(2 * terms, channels + 1);
    right << columns.adjoint() * measured, unit;
    const Eigen::MatrixXcd solved = numerics::complex_solve(normal, right);
    const double spread = solved(0, channels).real();  // of G times scale, over the noise's
    // Normal equations of condition 1e12 leave 4 digits.
    if (!solved.allFinite() || !(spread > 0.0) || !(spread < 1e12)) {
      throw NumericalFailure(
          fmt::format("local_polynomial_response: at {:.4g} Hz the input does not tell response "
                      "and transient apart: no power there, or an impulse",
                      bin * static_cast<double>(centre)));
    }
    const Eigen::MatrixXcd rest = measured - columns * solved.leftCols(channels);
    // Rows of `rest` are bins: E[v v^H] of the outputs is the sum of v v^H over them.
    const Eigen::MatrixXcd noise = rest.transpose() * rest.conjugate() / freedom;
    estimate.frequency[i] = bin * static_cast<double>(centre);
    estimate.response.row(i) = solved.row(0).head(channels) / scale;
    estimate.covariance.emplace_back(noise * (spread / (scale * scale)));
    for (Index c = 0; c < channels; ++c) {
      const double power = std::norm(estimate.response(i, c));
      const double error = estimate.covariance.back()(c, c).real();
      estimate.coherence(i, c) = power > 0.0 ? power / (power + freedom * error) : 0.0;
    }
  }
  return estimate;
}

}  // namespace boresight::identification

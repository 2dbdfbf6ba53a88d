#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/identification/grey_box/grey_box_hydraulics.hpp>
#include <boresight/identification/grey_box/grey_box_mechanics.hpp>
#include <boresight/identification/grey_box/grey_box_objective.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double outlier = 8.0;  // in rms

}  // namespace

GreyBoxObjective::GreyBoxObjective(const std::vector<GreyBoxRecord>& records,
                                   const GreyBoxParameters& parameters, unsigned threads)
    : records_(records), parameters_(parameters), threads_(threads) {
  for (std::size_t i = 0; i < records.size(); ++i) {
    const auto& record = records[i];
    GreyBoxChannel channel;
    channel.record = i;
    channel.counts = record.rate_counts;
    channels_.push_back(channel);
    if (record.valve.size() == 0) continue;
    channel.pressures = true;
    channel.counts.resize(2 * record.pressure_counts.size());
    for (std::size_t k = 0; k < channel.counts.size(); ++k) {
      channel.counts[k] = record.pressure_counts[k / 2];
    }
    channels_.push_back(channel);
  }
  std::erase_if(channels_, [](const GreyBoxChannel& c) {
    return std::find(c.counts.begin(), c.counts.end(), true) == c.counts.end();
  });
}

GreyBoxObjective::Derivatives GreyBoxObjective::predict(const VectorXd& point,
                                                        const GreyBoxChannel& channel,
                                                        bool derivatives) const {
  const auto& record = records_[channel.record];
  Derivatives out;
  MatrixXd* by = derivatives ? &out.by_coefficient : nullptr;
  if (channel.pressures) {
    auto c = parameters_.hydraulic(point, record.valve_calibrated);
    predict_pressures(record, parameters_.units(), c.values, out.errors, by);
    out.by_point = std::move(c.by_point);
  } else {
    auto c = parameters_.mechanical(point);
    predict_rate(record, c.values, out.errors, by);
    out.by_point = std::move(c.by_point);
  }
  return out;
}

double GreyBoxObjective::reweigh(const VectorXd& point) {
  std::vector<GreyBoxChannel> found = channels_;
  numerics::for_each_index(channels_.size(), threads_, [&](std::size_t i) {
    auto& channel = found[i];
    const auto& record = records_[channel.record];
    const VectorXd errors = predict(point, channel, false).errors;
    if (!errors.allFinite()) {
      throw NumericalFailure(fmt::format(
          "grey box: the model has no prediction of record '{}' at the start", record.name));
    }
    double limit = std::numeric_limits<double>::infinity();
    // The rms without outliers, which are those beyond a multiple of it.
    for (int pass = 0; pass < 3; ++pass) {
      double sum = 0.0;
      channel.counted = channel.outliers = 0;
      for (Index k = 0; k < errors.size(); ++k) {
        const auto at = static_cast<std::size_t>(k);
        const bool known = channel.pressures ? record.pressure_counts[at / 2]
                                             : static_cast<bool>(record.rate_counts[at]);
        channel.counts[at] = known && std::abs(errors(k)) <= limit;
        if (channel.counts[at]) {
          sum += errors(k) * errors(k);
          ++channel.counted;
        } else if (known) {
          ++channel.outliers;
        }
      }
      channel.scale = std::sqrt(sum / static_cast<double>(std::max<Index>(1, channel.counted)));
      limit = outlier * channel.scale;
    }
    // Records without noise would have unbounded weight.
    const double size =
        channel.pressures ? record.torque.cwiseAbs().maxCoeff() : record.rate.cwiseAbs().maxCoeff();
    channel.scale = std::max(channel.scale, 1e-9 * size + std::numeric_limits<double>::min());
  });
  double change = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    change = std::max(change, std::abs(found[i].scale / channels_[i].scale - 1.0));
  }
  channels_ = std::move(found);
  return change;
}

VectorXd GreyBoxObjective::errors(const VectorXd& point, std::size_t index) const {
  const auto& channel = channels_[index];
  VectorXd errors = predict(point, channel, false).errors / channel.scale;
  for (Index k = 0; k < errors.size(); ++k) {
    if (!channel.counts[static_cast<std::size_t>(k)]) errors(k) = 0.0;
  }
  return errors;
}

double GreyBoxObjective::sum_of_squares(const VectorXd& point) const {
  std::vector<double> sums(channels_.size());
  numerics::for_each_index(channels_.size(), threads_,
                           [&](std::size_t i) { sums[i] = errors(point, i).squaredNorm(); });
  double sum = 0.0;
  for (const double part : sums) sum += part;
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

MatrixXd GreyBoxObjective::products(const VectorXd& point, std::size_t index) const {
  const auto& channel = channels_[index];
  Derivatives d = predict(point, channel, true);
  const Index coefficients = d.by_coefficient.rows();
  const double unit = 1.0 / channel.scale;
  // In stretches, so that what is multiplied stays in the cache.
  constexpr Index stretch = 256;
  MatrixXd rows(coefficients + 1, stretch);
  MatrixXd sum = MatrixXd::Zero(coefficients + 1, coefficients + 1);
  for (Index from = 0; from < d.errors.size(); from += stretch) {
    const Index count = std::min(stretch, d.errors.size() - from);
    for (Index k = 0; k < count; ++k) {
      const bool counts = channel.counts[static_cast<std::size_t>(from + k)];
      if (counts) {
        rows.col(k).head(coefficients) = unit * d.by_coefficient.col(from + k);
        rows(coefficients, k) = unit * d.errors(from + k);
      } else {
        rows.col(k).setZero();
      }
    }
    sum.selfadjointView<Eigen::Lower>().rankUpdate(rows.leftCols(count));
  }
  sum.triangularView<Eigen::StrictlyUpper>() = sum.transpose();
  const Index size = d.by_point.cols();
  MatrixXd out(size + 1, size + 1);
  out.topLeftCorner(size, size) =
      d.by_point.transpose() * sum.topLeftCorner(coefficients, coefficients) * d.by_point;
  out.topRightCorner(size, 1) = d.by_point.transpose() * sum.topRightCorner(coefficients, 1);
  out.bottomLeftCorner(1, size) = out.topRightCorner(size, 1).transpose();
  out(size, size) = sum(coefficients, coefficients);
  return out;
}

MatrixXd GreyBoxObjective::products(const VectorXd& point) const {
  std::vector<MatrixXd> parts(channels_.size());
  numerics::for_each_index(channels_.size(), threads_,
                           [&](std::size_t i) { parts[i] = products(point, i); });
  MatrixXd sum = MatrixXd::Zero(point.size() + 1, point.size() + 1);
  for (const auto& part : parts) sum += part;
  return sum;
}

MatrixXd GreyBoxObjective::scores(const VectorXd& point, double length) const {
  std::vector<MatrixXd> parts(channels_.size());
  numerics::for_each_index(channels_.size(), threads_, [&](std::size_t i) {
    const auto& channel = channels_[i];
    const Derivatives d = predict(point, channel, true);
    const Index per_sample = channel.pressures ? 2 : 1;
    const auto stretch = std::max<Index>(
        1, static_cast<Index>(length / records_[channel.record].sample_time) * per_sample);
    const Index count = (d.errors.size() + stretch - 1) / stretch;
    MatrixXd sums = MatrixXd::Zero(d.by_coefficient.rows(), count);
    const double unit = 1.0 / (channel.scale * channel.scale);
    for (Index k = 0; k < d.errors.size(); ++k) {
      if (channel.counts[static_cast<std::size_t>(k)]) {
        sums.col(k / stretch) += unit * d.errors(k) * d.by_coefficient.col(k);
      }
    }
    parts[i] = d.by_point.transpose() * sums;
  });
  Index columns = 0;
  for (const auto& part : parts) columns += part.cols();
  MatrixXd all(point.size(), columns);
  Index at = 0;
  for (const auto& part : parts) {
    all.middleCols(at, part.cols()) = part;
    at += part.cols();
  }
  return all;
}

}  // namespace boresight::identification

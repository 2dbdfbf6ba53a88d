#pragma once

#include <vector>

#include <Eigen/Core>

#include <boresight/identification/grey_box/grey_box_parameters.hpp>
#include <boresight/identification/grey_box/grey_box_record.hpp>

namespace boresight::identification {

/// Which prediction of which record: of the rate from the torque, or of the pressures from the rate
/// and the valve's command.
struct GreyBoxChannel {
  std::size_t record = 0;
  bool pressures = false;
  double scale = 1.0;         // rms of the prediction errors that count, in their unit
  Eigen::Index counted = 0;   // prediction errors
  Eigen::Index outliers = 0;  // left out for their size
  std::vector<bool> counts;   // by prediction error
};

/// Prediction errors of all records, each channel in units of its own rms: what the grey box makes
/// small.
class GreyBoxObjective {
 public:
  /// `threads`: at most so many at a time; the result does not depend on it.
  GreyBoxObjective(const std::vector<GreyBoxRecord>& records, const GreyBoxParameters& parameters,
                   unsigned threads);

  const std::vector<GreyBoxChannel>& channels() const { return channels_; }

  /// Sets every channel's scale to the rms of its prediction errors at this point, those above
  /// eight times it left out. Returns the largest relative change of a scale.
  /// @throws NumericalFailure if the model has no prediction there.
  double reweigh(const Eigen::VectorXd& point);

  /// Sum of squares over all channels, without priors; infinite where the model has no prediction.
  double sum_of_squares(const Eigen::VectorXd& point) const;

  /// Products of the derivatives and errors of a channel, or of all: of [J r], J by the point
  /// ((parameters + 1) square).
  Eigen::MatrixXd products(const Eigen::VectorXd& point) const;
  Eigen::MatrixXd products(const Eigen::VectorXd& point, std::size_t channel) const;

  /// Sums of J'r over stretches of the given length (s): parameters x stretches.
  Eigen::MatrixXd scores(const Eigen::VectorXd& point, double length) const;

  /// Prediction errors of a channel in units of its scale, 0 where they do not count.
  Eigen::VectorXd errors(const Eigen::VectorXd& point, std::size_t channel) const;

 private:
  struct Derivatives {
    Eigen::VectorXd errors;
    Eigen::MatrixXd by_coefficient;  // coefficients x errors
    Eigen::MatrixXd by_point;        // of the coefficients
  };
  Derivatives predict(const Eigen::VectorXd& point, const GreyBoxChannel& channel,
                      bool derivatives) const;

  const std::vector<GreyBoxRecord>& records_;
  const GreyBoxParameters& parameters_;
  unsigned threads_;
  std::vector<GreyBoxChannel> channels_;
};

}  // namespace boresight::identification

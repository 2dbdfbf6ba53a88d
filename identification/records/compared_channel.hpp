#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <boresight/identification/records/channel_consistency.hpp>
#include <boresight/numerics/statistics/grouped_regression.hpp>

namespace boresight::identification {

/// An estimate with its standard error and the degrees of freedom of that.
struct ComparedQuantity {
  ChannelQuantity quantity = ChannelQuantity::gain;
  std::string unit;
  double value = 0.0;
  double standard_error = 0.0;  // infinite: not determined
  double degrees_of_freedom = 1.0;
  /// Standard uncertainty by the instruments' stated accuracy, own and the reference's together,
  /// and the own alone.
  double stated = 0.0;
  double own_stated = 0.0;
  double widest = 0.0;  // half width from which it is not determined
  bool is_determined() const;
  /// Standard error that a normal estimate would need to be `sigmas` of it off as seldom as this
  /// one, which has Student's t distribution, is off by that much.
  double normal_error(double sigmas) const;
  /// Distance from what it should be, in standard uncertainties of estimate and accuracy, for
  /// comparison with a limit of `sigmas`.
  double departure(double sigmas) const;
};

/// A channel by a selection of records (their places): its gain first, then the others. Empty:
/// nothing can be compared.
using ComparedFit =
    std::function<std::vector<ComparedQuantity>(const std::vector<std::size_t>& records)>;

/// Rows of all records but those that are unlike most of the others, and of each of those alone.
/// `row`: filled in but for what is estimated. See channel_consistency.
std::vector<ChannelCheck> checked_channel(const ChannelCheck& row,
                                          const std::vector<EvaluatedRecord>& records,
                                          const ComparedFit& fit,
                                          const ChannelConsistencyOptions& options);

/// Groups of rows for grouped_regression: neighbours, about as many in each. Empty where the rows
/// are too few for it.
std::vector<Eigen::Index> row_groups(Eigen::Index rows);

}  // namespace boresight::identification

#pragma once

#include <string>
#include <vector>

#include <boresight/identification/records/record_defects.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::identification {

/// An even grid of times for samples that were recorded at any.
struct EvenTimeBase {
  double sample_time = 0.0;  // s
  Eigen::Index samples = 0;
  /// Samples of the file that are used, rising, and their times from the grid's first.
  std::vector<Eigen::Index> rows;
  std::vector<double> times;
  /// The grid sample of each row; empty if the grid is interpolated.
  std::vector<Eigen::Index> places;
  /// s: rows further apart leave the grid between them empty.
  double longest_step = 0.0;
  /// Grid samples without a row, at most three in a row, are filled from their neighbours.
  bool fills_short_gaps = false;
};

/// Times that cannot be used, and of which kind their defect is.
class UnusableTimes : public InvalidInput {
 public:
  UnusableTimes(DefectKind kind_, const std::string& message)
      : InvalidInput(message), kind(kind_) {}
  DefectKind kind;
};

/// As described at clean_record. Defects found are added to `defects`.
/// @throws UnusableTimes with the reason if the times cannot be used
EvenTimeBase even_time_base(const Eigen::VectorXd& time, const DefectOptions& options,
                            std::vector<RecordDefect>& defects);

/// A channel on the grid; NaN among the values (one a sample of the file) is not valid. Samples
/// that were filled (fills_short_gaps) are. All invalid: zeros.
Signal on_time_base(const EvenTimeBase& base, const Eigen::VectorXd& values);

}  // namespace boresight::identification

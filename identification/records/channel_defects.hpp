#pragma once

#include <vector>

#include <boresight/identification/records/record_defects.hpp>

namespace boresight::identification {

/// Marks a channel's clipped samples by NaN (see clean_record); gives the defects found.
/// `limit` is lowered to the plateau found in a channel that reaches the same extreme again and
/// again (absolute value, both signs).
std::vector<RecordDefect> mask_clipped(RawChannel& channel, const Eigen::VectorXd& time,
                                       const DefectOptions& options, double* limit = nullptr);
/// Same, spikes.
std::vector<RecordDefect> mask_spikes(RawChannel& channel, const Eigen::VectorXd& time);
/// Same, stuck stretches, if one of the others moves meanwhile.
std::vector<RecordDefect> mask_stuck(RawChannel& channel,
                                     const std::vector<const RawChannel*>& others,
                                     const Eigen::VectorXd& time);
/// Fills the samples from `begin` to before `end`, which are NaN, by the polynomial through up to
/// two present ones on either side (a cubic). False, and nothing is filled, for more than three and
/// at either end.
bool fill_from_neighbours(Eigen::VectorXd& values, Eigen::Index begin, Eigen::Index end);

/// Missing samples, which are NaN already. With `bridge`, at most three in a row are filled from
/// their neighbours.
std::vector<RecordDefect> missing_samples(RawChannel& channel, const Eigen::VectorXd& time,
                                          bool bridge);

/// Largest less smallest finite value; 0 if there is none.
double spread(const Eigen::VectorXd& values);
/// Median of the finite values; 0 if there is none.
double finite_median(const Eigen::VectorXd& values);
/// Correlation coefficient over the samples at which both are finite; 0 if one is constant.
double correlation(const Eigen::VectorXd& one, const Eigen::VectorXd& other);

}  // namespace boresight::identification

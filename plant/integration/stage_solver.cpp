#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <boresight/plant/integration/stage_solver.hpp>

namespace boresight::plant {
namespace {

constexpr Eigen::Index stages = collocation_stages;
constexpr int max_iterations = 10;
// What Newton's method may leave of the tolerance.
constexpr double newton_fraction = 0.01;

// A slope that jumps by 1 between two nodes has a third difference of 3.3 to 10; by where it jumps,
// the rule errs by up to 0.024, 0.024 and 0.012 of the jump.
constexpr double kink_fraction = 0.005;

// The third divided difference of values at 0 and at the stages, as their weights.
std::array<double, stages + 1> third_difference() {
  std::array<double, stages + 1> nodes{0.0}, weights{};
  std::copy(collocation_points.begin(), collocation_points.end(), nodes.begin() + 1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    weights[i] = 1.0;
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      if (j != i) weights[i] /= nodes[i] - nodes[j];
    }
  }
  return weights;
}

// Which channel is not finite, in value or slope, at any of the times that stand stacked; or -1.
Eigen::Index not_finite(const Eigen::VectorXd& n, const Eigen::MatrixXd& slope) {
  if (std::isfinite(n.sum()) && std::isfinite(slope.sum())) return -1;
  for (Eigen::Index i = 0; i < n.size(); ++i) {
    if (!std::isfinite(n[i]) || !slope.row(i % slope.rows()).allFinite()) return i % slope.rows();
  }
  return -1;
}

}  // namespace

StageSolver::StageSolver(std::shared_ptr<const NonlinearChannels> channels,
                         Eigen::Index channel_inputs, Eigen::Index channel_outputs)
    : channels_(std::move(channels)),
      p_(channel_inputs),
      q_(channel_outputs),
      size_(stages * std::min(p_, q_)) {
  for (auto* vector : {&z_, &change_}) vector->setZero(stages * p_);
  error_.setZero((stages + 2) * p_);
  defects_.setZero(2 * q_);
  for (auto* vector : {&f_, &spread_}) vector->setZero(stages * q_);
  slope_.setZero(q_, stages * p_);
  matrix_.setZero(size_, size_);
  reduced_.setZero(size_);
  pivots_.resize(static_cast<std::size_t>(size_));
  rows_.reserve(static_cast<std::size_t>(stages * q_));
  entries_.reserve(static_cast<std::size_t>(stages * p_ * q_));
}

Eigen::Index StageSolver::evaluate(StageValues& values) const {
  if (q_ == 0) return -1;
  channels_->evaluate(values.z, values.n, values.slope);
  return not_finite(values.n, values.slope);
}

void StageSolver::end(const Eigen::VectorXd& n, StageValues& values) const {
  values.z = z_.tail(p_);
  values.n = n.tail(q_);
  values.slope = slope_.rightCols(p_);
}

bool StageSolver::evaluate_stages() {
  for (Eigen::Index j = 0; j < stages; ++j) {
    channels_->evaluate(z_.segment(j * p_, p_), f_.segment(j * q_, q_),
                        slope_.middleCols(j * p_, p_));
  }
  const Eigen::Index found = not_finite(f_, slope_);
  if (found >= 0) worst_channel_ = found;
  return found < 0;
}

// The slopes that are not zero, row by row, of the rows that have any. In the other rows of I - F W
// (a gear in contact, a spool below its slew limit) there is the one of the diagonal only.
void StageSolver::find_rows() {
  rows_.clear();
  entries_.clear();
  for (Eigen::Index stage = 0; stage < stages; ++stage) {
    const double* const slope = slope_.data() + stage * p_ * q_;
    for (Eigen::Index i = 0; i < q_; ++i) {
      const std::size_t first = entries_.size();
      for (Eigen::Index j = 0; j < p_; ++j) {
        if (slope[j * q_ + i] != 0.0) entries_.push_back({stage * p_ + j, slope[j * q_ + i]});
      }
      if (entries_.size() > first) rows_.push_back({stage * q_ + i, first, entries_.size()});
    }
  }
  size_ = static_cast<Eigen::Index>(rows_.size());
}

double StageSolver::apply_row(const Row& row, const double* z) const {
  double sum = 0.0;
  for (std::size_t k = row.begin; k < row.end; ++k) sum += entries_[k].slope * z[entries_[k].input];
  return sum;
}

// I - F W of the rows with slopes (unknowns n) or I - W F (unknowns z), F the slopes as a block
// diagonal. Plain loops: the matrices are too small for anything else to pay.
void StageSolver::form_matrix(const Eigen::MatrixXd& channels_to_stages) {
  const Eigen::Index all_z = stages * p_;
  const double* const w = channels_to_stages.data();
  double* to = matrix_.data();
  if (q_ <= p_) {
    find_rows();
    for (const Row& column : rows_) {
      for (const Row& row : rows_) *to++ = -apply_row(row, w + column.output * all_z);
    }
  } else {
    const double* factor = slope_.data();
    for (Eigen::Index stage = 0; stage < stages; ++stage) {
      const double* const from = w + stage * q_ * all_z;
      for (Eigen::Index column = 0; column < p_; ++column, factor += q_) {
        for (Eigen::Index j = 0; j < all_z; ++j, ++to) {
          double sum = 0.0;
          for (Eigen::Index i = 0; i < q_; ++i) sum += from[i * all_z + j] * factor[i];
          *to = -sum;
        }
      }
    }
  }
  for (Eigen::Index i = 0; i < size_; ++i) matrix_.data()[i * size_ + i] += 1.0;
}

// LU with partial pivoting, in place; the diagonal is left inverted.
bool StageSolver::factorise() {
  double* const matrix = matrix_.data();
  for (Eigen::Index k = 0; k < size_; ++k) {
    double* const column = matrix + k * size_;
    Eigen::Index pivot = k;
    for (Eigen::Index i = k + 1; i < size_; ++i) {
      if (std::abs(column[i]) > std::abs(column[pivot])) pivot = i;
    }
    pivots_[static_cast<std::size_t>(k)] = pivot;
    if (pivot != k) {
      for (Eigen::Index j = 0; j < size_; ++j) {
        std::swap(matrix[j * size_ + k], matrix[j * size_ + pivot]);
      }
    }
    const double inverse = 1.0 / column[k];
    if (!std::isfinite(inverse)) return false;
    column[k] = inverse;
    for (Eigen::Index i = k + 1; i < size_; ++i) column[i] *= inverse;
    for (Eigen::Index j = k + 1; j < size_; ++j) {
      double* const other = matrix + j * size_;
      const double factor = other[k];
      for (Eigen::Index i = k + 1; i < size_; ++i) other[i] -= factor * column[i];
    }
  }
  return true;
}

void StageSolver::back_substitute(Eigen::VectorXd& values) const {
  const double* const matrix = matrix_.data();
  double* const right = values.data();
  for (Eigen::Index k = 0; k < size_; ++k) {
    std::swap(right[k], right[pivots_[static_cast<std::size_t>(k)]]);
  }
  for (Eigen::Index k = 0; k < size_; ++k) {
    const double* const column = matrix + k * size_;
    for (Eigen::Index i = k + 1; i < size_; ++i) right[i] -= right[k] * column[i];
  }
  for (Eigen::Index k = size_ - 1; k >= 0; --k) {
    const double* const column = matrix + k * size_;
    right[k] *= column[k];
    for (Eigen::Index i = 0; i < k; ++i) right[i] -= right[k] * column[i];
  }
}

// n <- (I - F W)^-1 n: rows without slopes keep their values, which the others see through W.
void StageSolver::solve_for_outputs(const Eigen::MatrixXd& channels_to_stages, Eigen::VectorXd& n) {
  for (Eigen::Index k = 0; k < size_; ++k) {
    double& place = n[rows_[static_cast<std::size_t>(k)].output];
    reduced_[k] = place;
    place = 0.0;
  }
  if ((n.array() != 0.0).any()) {
    change_.noalias() = channels_to_stages * n;
    for (Eigen::Index k = 0; k < size_; ++k) {
      reduced_[k] += apply_row(rows_[static_cast<std::size_t>(k)], change_.data());
    }
  }
  back_substitute(reduced_);
  for (Eigen::Index k = 0; k < size_; ++k) {
    n[rows_[static_cast<std::size_t>(k)].output] = reduced_[k];
  }
}

// to = (block diagonal of the slopes) z
void StageSolver::apply_slopes(const Eigen::VectorXd& z, Eigen::VectorXd& to) const {
  const double* slope = slope_.data();
  const double* from = z.data();
  double* place = to.data();
  to.setZero();
  for (Eigen::Index stage = 0; stage < stages; ++stage, place += q_) {
    for (Eigen::Index j = 0; j < p_; ++j, slope += q_, ++from) {
      for (Eigen::Index i = 0; i < q_; ++i) place[i] += slope[i] * *from;
    }
  }
}

StageSolver::Outcome StageSolver::solve(const CollocationStep& step, const Eigen::VectorXd& free,
                                        const Eigen::VectorXd& scale, Eigen::VectorXd& n) {
  iterations_ = 0;
  z_ = free;
  if (q_ == 0) return Outcome::converged;
  z_.noalias() += step.channels_to_stages * n;
  double last = 0.0;
  double rate = std::pow(rate_, 0.8);
  while (iterations_ < max_iterations) {
    ++iterations_;
    if (!evaluate_stages()) return Outcome::not_finite;
    spread_ = f_ - n;
    form_matrix(step.channels_to_stages);
    if (!factorise()) break;
    if (q_ <= p_) {
      solve_for_outputs(step.channels_to_stages, spread_);
      n += spread_;
      change_.noalias() = step.channels_to_stages * spread_;
    } else {
      change_.noalias() = step.channels_to_stages * spread_;
      back_substitute(change_);
      apply_slopes(change_, n);
      n += f_;
    }
    if (!std::isfinite(change_.sum())) break;
    z_ += change_;
    double size = 0.0;
    for (Eigen::Index stage = 0; stage < stages; ++stage) {
      for (Eigen::Index i = 0; i < p_; ++i) {
        size = std::max(size, std::abs(change_[stage * p_ + i]) / scale[i]);
      }
    }
    if (iterations_ > 1) {
      const double ratio = size / last;
      if (!(ratio < 2.0) || (iterations_ > 2 && ratio >= 1.0)) break;
      rate = ratio;
    }
    if (size * rate <= newton_fraction * (1.0 - std::min(rate, 0.99))) {
      rate_ = std::max(rate, 1e-10);
      return Outcome::converged;
    }
    last = size;
  }
  spread_ = f_ - n;
  Eigen::Index worst = 0;
  spread_.cwiseAbs().maxCoeff(&worst);
  worst_channel_ = worst % q_;
  return Outcome::diverged;
}

// Of each channel, first how far n at the start is from the polynomial of the stages: the next term
// of a smooth n. Then what a kink between the nodes may add on average over the step: the third
// difference of the slopes at 0 and the stages, which none escapes, whereas the first defect and
// the rule's own error vanish together for some places of a kink only.
void StageSolver::find_defects(const StageValues& start, const Eigen::VectorXd& n) {
  static const Eigen::Matrix4d polynomials = collocation_polynomials();
  static const std::array<double, stages + 1> difference = third_difference();
  const double* const z = z_.data();
  for (Eigen::Index i = 0; i < q_; ++i) {
    double defect = start.n[i];
    for (Eigen::Index stage = 0; stage < stages; ++stage) {
      defect -= polynomials(stage, 0) * n[stage * q_ + i];
    }
    double kink = 0.0;
    for (Eigen::Index j = 0; j < p_; ++j) {
      double third = difference[0] * start.slope.data()[j * q_ + i];
      double path = std::abs(z[j] - start.z[j]);
      for (Eigen::Index stage = 0; stage < stages; ++stage) {
        const Eigen::Index place = stage * p_ + j;
        third += difference[static_cast<std::size_t>(stage) + 1] * slope_.data()[place * q_ + i];
        if (stage > 0) path += std::abs(z[place] - z[place - p_]);
      }
      kink += std::abs(third) * path;
    }
    defects_[i] = defect;
    defects_[q_ + i] = std::copysign(kink_fraction * kink, defect);
  }
}

const Eigen::VectorXd& StageSolver::error(const CollocationStep& step, const StageValues& start,
                                          const Eigen::VectorXd& n) {
  find_defects(start, n);
  auto at_stages = error_.head(stages * p_), later = error_.tail(2 * p_);
  change_.noalias() = step.error_to_stages * defects_;
  if (q_ > p_) {
    back_substitute(change_);
    apply_slopes(change_, spread_);
    at_stages = change_;
  } else {
    apply_slopes(change_, spread_);
    at_stages = change_;
    solve_for_outputs(step.channels_to_stages, spread_);
    at_stages.noalias() += step.channels_to_stages * spread_;
  }
  later.noalias() = step.error_to_later * defects_;
  later.noalias() += step.channels_to_later * spread_;
  return error_;
}

}  // namespace boresight::plant

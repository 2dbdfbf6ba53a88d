#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/integration/exponential_collocation.hpp>
#include <boresight/plant/integration/nonlinear_channels.hpp>

namespace boresight::plant {

/// The channels at one time.
struct StageValues {
  Eigen::VectorXd z;      // p
  Eigen::VectorXd n;      // q
  Eigen::MatrixXd slope;  // q x p, dn/dz
};

/// Solves z = free + W n, n = n(z) for the stages of a collocation step by Newton's method, in the
/// unknowns z or n, whichever are fewer. Everything is stacked stage by stage: z is 3 p long, n 3
/// q.
class StageSolver {
 public:
  enum class Outcome { converged, diverged, not_finite };

  /// `channels` may be null if there are none (p = q = 0).
  StageSolver(std::shared_ptr<const NonlinearChannels> channels, Eigen::Index channel_inputs,
              Eigen::Index channel_outputs);

  /// n comes as a guess and leaves as the solution, to an error that makes some 1 % of `scale` (p)
  /// in z.
  Outcome solve(const CollocationStep& step, const Eigen::VectorXd& free,
                const Eigen::VectorXd& scale, Eigen::VectorXd& n);

  /// After convergence: what the step may have got wrong of z at the stages and, in the linear part
  /// alone, at the two times later, to first order (5 p).
  const Eigen::VectorXd& error(const CollocationStep& step, const StageValues& start,
                               const Eigen::VectorXd& n);

  /// n and slope at values.z, outside a step. Returns the first n that is not finite, or -1.
  Eigen::Index evaluate(StageValues& values) const;

  /// After convergence: the values at the end of the step.
  void end(const Eigen::VectorXd& n, StageValues& values) const;

  const Eigen::VectorXd& z() const { return z_; }
  int iterations() const { return iterations_; }
  /// Why it did not converge: which output of the channels (0..q-1).
  Eigen::Index worst_channel() const { return worst_channel_; }
  /// The next step has nothing to do with the last one.
  void forget() { rate_ = 1.0; }

 private:
  struct Entry {
    Eigen::Index input;  // of the stacked z
    double slope;
  };
  // Entries of one of the stacked n.
  struct Row {
    Eigen::Index output;
    std::size_t begin, end;
  };

  bool evaluate_stages();
  void find_rows();
  double apply_row(const Row& row, const double* z) const;
  void form_matrix(const Eigen::MatrixXd& channels_to_stages);
  bool factorise();
  void back_substitute(Eigen::VectorXd& values) const;
  void solve_for_outputs(const Eigen::MatrixXd& channels_to_stages, Eigen::VectorXd& n);
  void find_defects(const StageValues& start, const Eigen::VectorXd& n);
  void apply_slopes(const Eigen::VectorXd& z, Eigen::VectorXd& to) const;

  std::shared_ptr<const NonlinearChannels> channels_;
  Eigen::Index p_, q_;
  Eigen::Index size_;  // of the matrix in use: 3 p, or the rows with slopes
  Eigen::VectorXd z_, change_, f_, defects_, error_, spread_;
  Eigen::MatrixXd slope_;  // q x 3 p: dn/dz of each stage
  std::vector<Row> rows_;
  std::vector<Entry> entries_;
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd reduced_;  // the unknowns of those rows
  std::vector<Eigen::Index> pivots_;
  double rate_ = 1.0;  // how much an iteration leaves of the error, as last seen
  int iterations_ = 0;
  Eigen::Index worst_channel_ = 0;
};

}  // namespace boresight::plant

#pragma once

#include <complex>
#include <vector>

#include <Eigen/Core>

namespace boresight::plant {

/// How many modes one operation of the processor takes. The results are the same to the last bit.
enum class LaneWidth { two, four };

/// Whether this processor has operations that wide; two is always there.
bool available(LaneWidth width);
LaneWidth widest_lanes();

/// Uncoupled modes, advanced sample by sample:
///   z[k+1] = factor z[k] + input u[k],   y[k] = feedthrough u[k] + Re(output z[k]).
/// A real mode has real numbers throughout; a pair appears once, with twice its output. O(modes)
/// per sample, without allocation: modes are processed in groups of eight. The outputs are summed
/// in an order that does not depend on the processor.
class ModalRecursion {
 public:
  /// factor: k; input: k x inputs; output: outputs x k; feedthrough: outputs x inputs. At rest.
  ModalRecursion(const Eigen::VectorXcd& factor, const Eigen::MatrixXcd& input,
                 const Eigen::MatrixXcd& output, Eigen::MatrixXd feedthrough);

  void set_state(const Eigen::VectorXcd& state);
  Eigen::VectorXcd state() const;
  bool has_finite_state() const;

  /// input: samples x inputs, output: samples x outputs (not checked); from the present state on,
  /// which becomes that after the last sample.
  void run(const Eigen::Ref<const Eigen::MatrixXd>& input, Eigen::Ref<Eigen::MatrixXd> output,
           LaneWidth width = widest_lanes());

 private:
  Eigen::Index modes_;
  Eigen::Index inputs_;
  Eigen::Index outputs_;
  Eigen::MatrixXd feedthrough_;
  // Group after group of eight lanes: factor, then each input's, then each output's elements, of
  // each the eight real parts, then the eight imaginary ones.
  std::vector<double> coefficients_;
  std::vector<double> state_;    // a group: eight real parts, eight imaginary ones
  std::vector<double> partial_;  // eight partial sums a sample and output of one block
};

}  // namespace boresight::plant

#pragma once

#include <complex>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/linear/dense_response.hpp>
#include <boresight/plant/linear/frequency_kernels.hpp>
#include <boresight/plant/modal/modal_reduction.hpp>

namespace boresight::plant {

/// The response H(j w) of a modal system from one input to one output, dead times exact, prepared
/// once and then O(modes) a frequency. The core enters through its poles and residues (through its
/// Hessenberg form where its eigenvectors are too dependent for that: one object a thread then),
/// the modes through their sums, and only the few forces that feed back are solved for.
class ModalResponse {
 public:
  /// @throws as reduce().
  ModalResponse(const ModalSystem& system, std::string_view input, std::string_view output);

  /// H(j w) at one angular frequency w >= 0 (rad/s). Not finite exactly at a pole.
  std::complex<double> at(double angular_frequency) const;

  /// H at each angular frequency (rad/s); allocates nothing if `response` has their size.
  void evaluate(const Eigen::ArrayXd& angular_frequency, Eigen::ArrayXcd& response) const;

  const ModalReduction& reduction() const { return reduction_; }
  /// Poles and residues of the reduced core; without poles where it is not taken by them.
  const ModalForm& core() const { return core_; }
  bool core_by_modes() const { return !dense_.has_value(); }

 private:
  struct Entry {
    Eigen::Index row, column;
  };
  void evaluate_block(const double* angular_frequency, std::size_t count,
                      std::complex<double>* result) const;
  void dense_entries(DenseResponse& dense, const double* angular_frequency, std::size_t count,
                     FrequencyLanes* entries) const;

  ModalReduction reduction_;
  mutable std::optional<DenseResponse> dense_;  // of the core, where it is not taken by its modes
  mutable Eigen::MatrixXcd dense_values_;
  ModalForm core_;
  std::vector<Entry> entries_;
  std::vector<PoleSection> sections_;
  std::vector<double> feedthrough_;             // of each entry
  std::vector<std::vector<int>> entry_number_;  // [row][column], -1 where there is none
  std::vector<std::vector<int>> path_number_;   // [return][drive], -1 where there is none
  std::vector<double> mode_gain_;               // [mode][path of modes]
  std::vector<std::size_t> mode_path_;          // paths through modes, in the order of mode_gain_
};

}  // namespace boresight::plant

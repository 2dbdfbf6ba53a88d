#include <vector>

#include <boresight/io/description/state_space_description.hpp>
#include <boresight/io/exchange/state_space_formats.hpp>

namespace boresight::io {
namespace {

constexpr std::string_view names = "In order.";
constexpr std::string_view units = "In the same order; empty where a state has no unit of its own.";

void describe_matrix(Visitor& v, std::string_view key, const Eigen::MatrixXd& matrix) {
  std::vector<std::vector<double>> rows;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const Eigen::RowVectorXd row = matrix.row(i);
    rows.emplace_back(row.begin(), row.end());
  }
  v.number_rows(key, rows, key_units::none, "Rows of numbers.", {.finite = true});
}

}  // namespace

void describe(Visitor& v, const plant::StateSpace& system) {
  v.defined_as("state_space",
               "dx/dt = A x + B u, y = C x + D u; with a sample time x[k+1] instead of dx/dt. "
               "In the form that boresight benchmark --controller reads "
               "(docs/benchmark-protocol.md).");
  v.texts("inputs", system.inputs, names);
  v.texts("input_units", signal_units(system.inputs), units);
  v.texts("outputs", system.outputs, names);
  v.texts("output_units", signal_units(system.outputs), units);
  v.texts("states", system.states, names);
  v.texts("state_units", signal_units(system.states), units);
  v.constant("angles", "motor", "The shaft that the angles are of.");
  v.number("sample_time", system.sample_time, key_units::none, "In s; 0: continuous.",
           {.minimum = 0.0, .finite = true});
  describe_matrix(v, "A", system.a);
  describe_matrix(v, "B", system.b);
  describe_matrix(v, "C", system.c);
  describe_matrix(v, "D", system.d);
}

}  // namespace boresight::io

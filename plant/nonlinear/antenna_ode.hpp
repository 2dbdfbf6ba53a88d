#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/integration/feedback_ode.hpp>
#include <boresight/plant/integration/ode_system.hpp>
#include <boresight/plant/nonlinear/antenna_channels.hpp>
#include <boresight/plant/nonlinear/antenna_parameters.hpp>
#include <boresight/plant/nonlinear/nonlinear_antenna.hpp>

namespace boresight::plant {

/// The nonlinear antenna for OdeIntegrator: the system of to_feedback_system, with events at the
/// kinks of its equations and with derivatives by its parameters. At an event the owner restarts
/// the integrator with the same state, as all equations are continuous. Not thread-safe.
class AntennaOde final : public OdeSystem {
 public:
  /// `parameters`: those to differentiate by; none: no sensitivities.
  /// @throws InvalidInput as to_feedback_system, and for parameters given twice.
  explicit AntennaOde(const NonlinearAntenna& antenna,
                      std::vector<AntennaParameter> parameters = {});

  /// Inputs as FeedbackOde::drive.
  void drive(const FeedbackOde::Input& input);
  void drive(double t0, const Eigen::VectorXd& u0, double t1, const Eigen::VectorXd& u1);

  /// What happens where event function i changes its sign, in words.
  static std::string_view event_name(Eigen::Index i);

  /// Observed outputs at t.
  Eigen::VectorXd outputs(double t, const Eigen::Ref<const Eigen::VectorXd>& x) const;

  Eigen::Index states() const override { return ode_.states(); }
  void rate(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
            Eigen::Ref<Eigen::VectorXd> dx) const override;
  void jacobian(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                Eigen::Ref<Eigen::MatrixXd> j) const override;
  Eigen::Index events() const override { return AntennaChannels::event_count; }
  void event_values(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                    Eigen::Ref<Eigen::VectorXd> g) const override;
  Eigen::Index parameters() const override { return static_cast<Eigen::Index>(varied_.size()); }
  /// By central differences over a 1e-5th of each parameter: right to some 1e-9 of the largest
  /// terms of the rate, which grow with the angle turned where a spring is the parameter. By
  /// coulomb_torque and breakaway_torque where they are equal (the first cannot be more, the second
  /// not less) to one side, over a 1e-7th: right to some 1e-7.
  void rate_by_parameters(double t, const Eigen::Ref<const Eigen::VectorXd>& x,
                          Eigen::Ref<Eigen::MatrixXd> df_dp) const override;

 private:
  struct Varied {
    FeedbackOde more, less;
    double difference;  // of the parameter, between the two
  };

  FeedbackOde ode_;
  FeedbackMatrices matrices_;
  AntennaChannels channels_;
  std::vector<Varied> varied_;
  mutable Eigen::VectorXd more_, less_, z_;
};

}  // namespace boresight::plant

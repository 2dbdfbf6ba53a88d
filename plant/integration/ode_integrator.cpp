#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <cvodes/cvodes.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.hpp>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/integration/guarded_ode.hpp>
#include <boresight/plant/integration/ode_integrator.hpp>

namespace boresight::plant {
namespace {

// Owners of what SUNDIALS makes.
struct Destroy {
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
  void operator()(SUNMatrix matrix) const { SUNMatDestroy(matrix); }
  void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
  void operator()(SUNNonlinearSolver solver) const { SUNNonlinSolFree(solver); }
  void operator()(void* memory) const { CVodeFree(&memory); }
};
template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Destroy>;

using ConstVector = Eigen::Map<const Eigen::VectorXd>;
using MappedVector = Eigen::Map<Eigen::VectorXd>;

ConstVector elements(N_Vector vector) {
  return {N_VGetArrayPointer(vector), N_VGetLength(vector)};
}
MappedVector writable(N_Vector vector) {
  return {N_VGetArrayPointer(vector), N_VGetLength(vector)};
}

// What to do about a reason for which CVODES gives up.
const char* remedy(int flag) {
  switch (flag) {
    case CV_TOO_MUCH_WORK:
      return "raise max_steps or the tolerances, solve a stiff system by Newton's iteration, or "
             "make a jump of the rate an event";
    case CV_TOO_MUCH_ACC:
      return "raise relative_tolerance or absolute_tolerance: rounding is above them";
    case CV_ERR_FAILURE:
    case CV_CONV_FAILURE:
      return "look for a singularity of the rate, a jump that is not an event, or a Jacobian that "
             "is not its derivative";
    case CV_LSETUP_FAIL:
    case CV_LSOLVE_FAIL:
      return "compare the Jacobian with differences of the rate";
    default:
      return "look at the system at this time, and whether two of its events stand within rounding";
  }
}

// One Newton iteration for states and sensitivities together: half the rate evaluations of the
// staggered corrector for the same steps and errors.
constexpr int corrector = CV_SIMULTANEOUS;

void check_state(const char* function, const Eigen::VectorXd& x, Eigen::Index states) {
  if (x.size() != states) {
    throw InvalidInput(
        fmt::format("{}: expected a state of length {}, found {}", function, states, x.size()));
  }
  if (!x.allFinite()) {
    throw InvalidInput(fmt::format("{}: the state has elements that are not finite", function));
  }
}

}  // namespace

// The C library calls back with a pointer to this, so it stays where it is.
struct OdeIntegrator::Solver {
  Solver(const OdeSystem& system, double t0, const Eigen::VectorXd& x0, const OdeOptions& options);

  static int rate(double t, N_Vector x, N_Vector dx, void* self);
  static int jacobian(double t, N_Vector x, N_Vector dx, SUNMatrix j, void* self, N_Vector,
                      N_Vector, N_Vector);
  static int event_values(double t, N_Vector x, double* g, void* self);
  static int sensitivity_rate(int count, double t, N_Vector x, N_Vector dx, N_Vector* s,
                              N_Vector* ds, void* self, N_Vector, N_Vector);
  static void note(int flag, const char* module, const char* function, char* text, void* self);

  void configure(const OdeOptions& options);
  void configure_sensitivities(const OdeOptions& options);
  void start();
  void limit(double t, Approach approach);
  void expect(int flag) const;
  [[noreturn]] void fail(int flag, double t);
  long steps_since_start() const;

  GuardedOde ode;
  double time;
  Eigen::VectorXd state;
  Eigen::MatrixXd sensitivities;
  // Where CVODES reads a start and writes its result, which is taken over when it is a good one.
  Eigen::VectorXd exchange;
  Eigen::MatrixXd sensitivity_exchange;
  bool fresh = false;       // to start anew from `state` before the next step
  bool limited = false;     // CVODES has a stop time
  Eigen::VectorXi crossed;  // directions of the last event
  double crossing_time = std::numeric_limits<double>::quiet_NaN();
  // df/dx and df/dp where the sensitivities are being solved for.
  Eigen::MatrixXd by_state;
  Eigen::MatrixXd by_parameters;
  std::string message;  // of CVODES
  OdeStatistics done;   // steps: those before the last start

  sundials::Context context;
  Owned<N_Vector> vector;
  std::vector<Owned<N_Vector>> sensitivity_vectors;
  std::vector<N_Vector> sensitivity_handles;
  Owned<SUNMatrix> matrix;
  Owned<SUNLinearSolver> linear_solver;
  Owned<SUNNonlinearSolver> nonlinear_solver;  // none: Newton's, which CVODES makes itself
  Owned<void*> memory;
};

OdeIntegrator::Solver::Solver(const OdeSystem& system, double t0, const Eigen::VectorXd& x0,
                              const OdeOptions& options)
    : ode(system), time(t0), state(x0), exchange(x0) {
  validate(options, system);
  if (!std::isfinite(t0)) {
    throw InvalidInput(fmt::format("OdeIntegrator: expected a finite start time, found {} s", t0));
  }
  check_state("OdeIntegrator", x0, system.states());
  ode.start(t0);
  configure(options);
  if (options.sensitivities) configure_sensitivities(options);
}

void OdeIntegrator::Solver::configure(const OdeOptions& options) {
  vector.reset(N_VMake_Serial(state.size(), exchange.data(), context));
  const bool bdf = options.method == OdeMethod::bdf;
  memory.reset(CVodeCreate(bdf ? CV_BDF : CV_ADAMS, context));
  expect(CVodeSetErrHandlerFn(memory.get(), note, this));
  expect(CVodeInit(memory.get(), rate, time, vector.get()));
  expect(CVodeSetUserData(memory.get(), this));
  const Eigen::VectorXd& absolute = options.absolute_tolerance;
  if (absolute.size() == 1) {
    expect(CVodeSStolerances(memory.get(), options.relative_tolerance, absolute(0)));
  } else {
    const Owned<N_Vector> tolerances(N_VClone(vector.get()));
    writable(tolerances.get()) = absolute;
    expect(CVodeSVtolerances(memory.get(), options.relative_tolerance, tolerances.get()));
  }
  expect(CVodeSetMaxOrd(memory.get(), std::min(options.highest_order, bdf ? 5 : 12)));
  expect(CVodeSetMaxNumSteps(memory.get(), options.max_steps));
  if (std::isfinite(options.longest_step)) {
    expect(CVodeSetMaxStep(memory.get(), options.longest_step));
  }
  if (const auto events = static_cast<int>(ode.system().events()); events > 0) {
    expect(CVodeRootInit(memory.get(), events, event_values));
  }
  if (options.iteration == OdeIteration::fixed_point) {
    constexpr int accelerated = 0;  // iterates remembered by Anderson's acceleration
    nonlinear_solver.reset(SUNNonlinSol_FixedPoint(vector.get(), accelerated, context));
    expect(CVodeSetNonlinearSolver(memory.get(), nonlinear_solver.get()));
    return;
  }
  matrix.reset(SUNDenseMatrix(state.size(), state.size(), context));
  linear_solver.reset(SUNLinSol_Dense(vector.get(), matrix.get(), context));
  expect(CVodeSetLinearSolver(memory.get(), linear_solver.get(), matrix.get()));
  expect(CVodeSetJacFn(memory.get(), jacobian));
}

void OdeIntegrator::Solver::configure_sensitivities(const OdeOptions& options) {
  const Eigen::Index n = state.size(), count = ode.system().parameters();
  const Eigen::MatrixXd& initial = options.initial_sensitivities;
  Eigen::VectorXd scale = options.parameter_scale;
  if (scale.size() == 0) scale = Eigen::VectorXd::Ones(count);

  sensitivities = initial.size() == 0 ? Eigen::MatrixXd::Zero(n, count) : initial;
  sensitivity_exchange = sensitivities;
  by_state.resize(n, n);
  by_parameters.resize(n, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    sensitivity_vectors.emplace_back(
        N_VMake_Serial(n, sensitivity_exchange.col(k).data(), context));
    sensitivity_handles.push_back(sensitivity_vectors.back().get());
  }
  expect(CVodeSensInit(memory.get(), static_cast<int>(count), corrector, sensitivity_rate,
                       sensitivity_handles.data()));
  expect(CVodeSetSensParams(memory.get(), nullptr, scale.data(), nullptr));
  expect(CVodeSensEEtolerances(memory.get()));
  expect(CVodeSetSensErrCon(memory.get(), SUNTRUE));
}

int OdeIntegrator::Solver::rate(double t, N_Vector x, N_Vector dx, void* self) {
  Solver& solver = *static_cast<Solver*>(self);
  ++solver.done.rate_evaluations;
  return solver.ode.rate(t, elements(x), writable(dx), solver.steps_since_start());
}

int OdeIntegrator::Solver::jacobian(double t, N_Vector x, N_Vector /*dx*/, SUNMatrix j, void* self,
                                    N_Vector, N_Vector, N_Vector) {
  Solver& solver = *static_cast<Solver*>(self);
  ++solver.done.jacobians;
  // Column after column, and zero: CVODES sees to that.
  Eigen::Map<Eigen::MatrixXd> result(SUNDenseMatrix_Data(j), SUNDenseMatrix_Rows(j),
                                     SUNDenseMatrix_Columns(j));
  return solver.ode.jacobian(t, elements(x), result);
}

// Where a function was found to cross zero it counts as across, also if it is zero to the last bit:
// should it go back, it crosses again.
int OdeIntegrator::Solver::event_values(double t, N_Vector x, double* g, void* self) {
  Solver& solver = *static_cast<Solver*>(self);
  MappedVector values(g, solver.ode.system().events());
  const int verdict = solver.ode.event_values(t, elements(x), values);
  if (t != solver.crossing_time) return verdict;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (values(i) == 0.0) values(i) = solver.crossed(i) * std::numeric_limits<double>::min();
  }
  return verdict;
}

int OdeIntegrator::Solver::sensitivity_rate(int count, double t, N_Vector x, N_Vector /*dx*/,
                                            N_Vector* s, N_Vector* ds, void* self, N_Vector,
                                            N_Vector) {
  Solver& solver = *static_cast<Solver*>(self);
  ++solver.done.sensitivity_evaluations;
  solver.by_state.setZero();
  int verdict = solver.ode.jacobian(t, elements(x), solver.by_state);
  if (verdict != 0) return verdict;
  solver.by_parameters.setZero();
  verdict = solver.ode.rate_by_parameters(t, elements(x), solver.by_parameters);
  if (verdict != 0) return verdict;
  for (int k = 0; k < count; ++k) {
    MappedVector result = writable(ds[k]);
    result = solver.by_parameters.col(k);
    result.noalias() += solver.by_state * elements(s[k]);
  }
  return 0;
}

// In place of printing to the terminal.
void OdeIntegrator::Solver::note(int flag, const char* /*module*/, const char* function, char* text,
                                 void* self) {
  if (flag < 0) static_cast<Solver*>(self)->message = fmt::format("{}: {}", function, text);
}

// Starts CVODES where it has to be, and tells it how far its steps may go.
void OdeIntegrator::Solver::limit(double t, Approach approach) {
  const bool exactly = approach == Approach::stop_exactly;
  double reached = 0.0;
  expect(CVodeGetCurrentTime(memory.get(), &reached));
  // A step past t taken before for interpolation does not count any more.
  if (fresh || (exactly && reached > t)) start();
  if (exactly || limited) {
    // There is no call to take a stop time back.
    const double stop = exactly ? t : std::numeric_limits<double>::max();
    expect(CVodeSetStopTime(memory.get(), stop));
  }
  limited = exactly;
}

void OdeIntegrator::Solver::start() {
  done.steps += steps_since_start();
  ode.start(time);
  exchange = state;
  expect(CVodeReInit(memory.get(), time, vector.get()));
  if (!sensitivity_handles.empty()) {
    sensitivity_exchange = sensitivities;
    expect(CVodeSensReInit(memory.get(), corrector, sensitivity_handles.data()));
  }
  fresh = false;
}

void OdeIntegrator::Solver::fail(int flag, double t) {
  fresh = true;
  ode.rethrow();
  double reached = time;
  CVodeGetCurrentTime(memory.get(), &reached);
  const std::string& complaint = ode.complaint();
  throw NumericalFailure(fmt::format(
      "OdeIntegrator: no way from {} s to {} s, given up at {} s: {} ({})", time, t, reached,
      complaint.empty() ? message : complaint,
      complaint.empty()
          ? remedy(flag)
          : "look there for a singularity, or make the edge of what is defined an event"));
}

void OdeIntegrator::Solver::expect(int flag) const {
  if (flag < 0) throw NumericalFailure(fmt::format("OdeIntegrator: {} ({})", message, flag));
}

long OdeIntegrator::Solver::steps_since_start() const {
  long steps = 0;
  CVodeGetNumSteps(memory.get(), &steps);
  return steps;
}

OdeIntegrator::OdeIntegrator(const OdeSystem& system, double t0, const Eigen::VectorXd& x0,
                             const OdeOptions& options)
    : solver_(std::make_unique<Solver>(system, t0, x0, options)) {}
OdeIntegrator::~OdeIntegrator() = default;
OdeIntegrator::OdeIntegrator(OdeIntegrator&&) noexcept = default;
OdeIntegrator& OdeIntegrator::operator=(OdeIntegrator&&) noexcept = default;

OdeStop OdeIntegrator::advance(double t, Approach approach) {
  Solver& solver = *solver_;
  if (!std::isfinite(t) || t < solver.time) {
    throw InvalidInput(
        fmt::format("OdeIntegrator::advance: expected a time from the present {} s on, found {} s",
                    solver.time, t));
  }
  OdeStop stop{t, false, Eigen::VectorXi::Zero(solver.ode.system().events())};
  // CVODES cannot start for less than two roundings.
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  if (t - solver.time <= 4.0 * rounding * std::max(std::abs(t), std::abs(solver.time))) {
    if (solver.crossing_time == solver.time) solver.crossing_time = t;
    solver.time = t;
    return stop;
  }
  solver.limit(t, approach);
  void* const memory = solver.memory.get();
  const int flag = CVode(memory, t, solver.vector.get(), &stop.time, CV_NORMAL);
  if (flag < 0) solver.fail(flag, t);
  if (!solver.sensitivity_handles.empty()) {
    double found = 0.0;
    solver.expect(CVodeGetSens(memory, &found, solver.sensitivity_handles.data()));
    solver.sensitivities = solver.sensitivity_exchange;
  }
  if (flag == CV_ROOT_RETURN) {
    stop.event = true;
    solver.expect(CVodeGetRootInfo(memory, stop.directions.data()));
    solver.crossed = stop.directions;
    solver.crossing_time = stop.time;
  }
  solver.time = stop.time;
  solver.state = solver.exchange;
  return stop;
}

double OdeIntegrator::time() const {
  return solver_->time;
}
const Eigen::VectorXd& OdeIntegrator::state() const {
  return solver_->state;
}
const Eigen::MatrixXd& OdeIntegrator::sensitivities() const {
  return solver_->sensitivities;
}

void OdeIntegrator::restart() {
  solver_->fresh = true;
}

void OdeIntegrator::restart(const Eigen::VectorXd& x) {
  check_state("OdeIntegrator::restart", x, state().size());
  solver_->state = x;
  solver_->crossing_time = std::numeric_limits<double>::quiet_NaN();
  restart();
}

void OdeIntegrator::restart(const Eigen::VectorXd& x, const Eigen::MatrixXd& sensitivities) {
  Eigen::MatrixXd& present = solver_->sensitivities;
  if (sensitivities.rows() != present.rows() || sensitivities.cols() != present.cols() ||
      !sensitivities.allFinite()) {
    throw InvalidInput(fmt::format(
        "OdeIntegrator::restart: expected finite sensitivities of {} x {}, found {} x {}",
        present.rows(), present.cols(), sensitivities.rows(), sensitivities.cols()));
  }
  restart(x);
  present = sensitivities;
}

OdeStatistics OdeIntegrator::statistics() const {
  OdeStatistics all = solver_->done;
  all.steps += solver_->steps_since_start();
  return all;
}

}  // namespace boresight::plant

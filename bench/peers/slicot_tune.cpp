// The peers' tuning as done with NLopt's SLSQP on SLICOT's norms, gradients by central differences:
// slicot_tune FOLDER MODES ITEM (the folder is not needed). One JSON line: CPU time of one thread
// (s), rms, Ms, the four gains.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <limits>
#include <string>
#include <vector>

#include <nlopt.hpp>

#include "../../tests/peer_family.hpp"

using Complex = std::complex<double>;
using Length = std::size_t;  // of each character argument, behind the others

extern "C" {
double ab13bd_(const char* dico, const char* jobn, const int* n, const int* m, const int* p,
               double* a, const int* lda, double* b, const int* ldb, double* c, const int* ldc,
               double* d, const int* ldd, int* nq, const double* tol, double* dwork,
               const int* ldwork, int* iwarn, int* info, Length, Length);
void ab13dd_(const char* dico, const char* jobe, const char* equil, const char* jobd, const int* n,
             const int* m, const int* p, double* fpeak, double* a, const int* lda, double* e,
             const int* lde, double* b, const int* ldb, double* c, const int* ldc, double* d,
             const int* ldd, double* gpeak, const double* tol, int* iwork, double* dwork,
             const int* ldwork, Complex* cwork, const int* lcwork, int* info, Length, Length,
             Length, Length);
}

namespace {

using boresight::reference::PeerGains;

struct Norms {
  double rms = 0.0, peak = 0.0;
};

PeerGains gains_of(const std::vector<double>& x) {
  return {std::exp(x[0]), std::exp(x[1]), std::exp(x[2]), std::exp(x[3])};
}

Norms norms(int modes, const std::vector<double>& x) {
  constexpr Norms far_away{100.0, 10.0};  // for an unstable loop
  const auto closed = boresight::reference::peer_closed_loop(modes, gains_of(x));
  const int n = static_cast<int>(closed.a.rows()), one = 1;
  int info = 0, warning = 0, kept = 0;
  double tolerance = 0.0, none = 0.0;
  Norms found;
  // From n to y.
  Eigen::MatrixXd a = closed.a, b = closed.b.col(0), c = closed.c.row(0);
  const int work_size = n * (n + 20) + 200;
  std::vector<double> work(static_cast<std::size_t>(work_size));
  found.rms = ab13bd_("C", "H", &n, &one, &one, a.data(), &n, b.data(), &n, c.data(), &one, &none,
                      &one, &kept, &tolerance, work.data(), &work_size, &warning, &info, 1, 1);
  if (info != 0) return far_away;
  a = closed.a;
  b = closed.b.col(2);  // from d to u
  c = closed.c.row(1);
  double feedthrough = 1.0, unit = 0.0;
  std::array<double, 2> guess{0.0, 1.0}, peak{};
  tolerance = 1e-7;
  const int real_size = 20 * n * n + 200 * n + 2000, complex_size = 2 * (n + 1) * (n + 1) + 10;
  std::vector<double> real_work(static_cast<std::size_t>(real_size));
  std::vector<Complex> complex_work(static_cast<std::size_t>(complex_size));
  std::vector<int> places(static_cast<std::size_t>(n) + 10);
  ab13dd_("C", "I", "N", "D", &n, &one, &one, guess.data(), a.data(), &n, &unit, &n, b.data(), &n,
          c.data(), &one, &feedthrough, &one, peak.data(), &tolerance, places.data(),
          real_work.data(), &real_size, complex_work.data(), &complex_size, &info, 1, 1, 1, 1);
  if (info != 0) return far_away;
  found.peak = peak[0] / peak[1];
  return found;
}

struct Problem {
  int modes = 0;
  std::vector<double> last;
  Norms values;
  int evaluations = 0;

  const Norms& at(const std::vector<double>& x) {
    if (x != last) {
      last = x;
      values = norms(modes, x);
      ++evaluations;
    }
    return values;
  }
};

template <double Norms::*member>
double value(const std::vector<double>& x, std::vector<double>& gradient, void* data) {
  auto& problem = *static_cast<Problem*>(data);
  const double here = problem.at(x).*member;
  constexpr double step = 1e-6;
  for (std::size_t k = 0; k < gradient.size(); ++k) {
    std::vector<double> up = x, down = x;
    up[k] += step;
    down[k] -= step;
    const double above = problem.at(up).*member;
    gradient[k] = (above - problem.at(down).*member) / (2.0 * step);
  }
  return member == &Norms::peak ? here - 2.0 : here;
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void tune(int modes) {
  std::vector<double> times, x;
  Problem problem;
  for (int repetition = 0; repetition < 3; ++repetition) {
    const double begin = cpu_seconds();
    problem = {modes, {}, {}, 0};
    nlopt::opt optimiser(nlopt::LD_SLSQP, 4);
    optimiser.set_min_objective(value<&Norms::rms>, &problem);
    optimiser.add_inequality_constraint(value<&Norms::peak>, &problem, 1e-7);
    optimiser.set_lower_bounds(std::log(1e-3));
    optimiser.set_upper_bounds(std::log(1e2));
    optimiser.set_xtol_rel(1e-6);
    optimiser.set_ftol_rel(1e-9);
    optimiser.set_maxeval(5000);
    optimiser.set_initial_step(0.2);
    x = {std::log(0.2), std::log(1.2), std::log(0.3), std::log(0.03)};
    double minimum = 0.0;
    optimiser.optimize(x, minimum);
    times.push_back(cpu_seconds() - begin);
  }
  std::sort(times.begin(), times.end());
  const Norms found = norms(modes, x);
  std::printf(
      "{\"peer\": \"NLopt SLSQP on SLICOT norms\", \"med\": %.6g, \"val\": [%.12g, %.12g, %.12g, "
      "%.12g, %.12g, %.12g]}\n",
      times[1], found.rms, found.peak, std::exp(x[0]), std::exp(x[1]), std::exp(x[2]),
      std::exp(x[3]));
}

}  // namespace

int main(int count, char** arguments) try {
  if (count != 4) {
    std::fprintf(stderr, "usage: slicot_tune FOLDER MODES ITEM\n");
    return 1;
  }
  const int modes = std::atoi(arguments[2]);
  // Beyond some twenty modes it takes minutes.
  if (std::string(arguments[3]) == "tune" && modes <= 20) tune(modes);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "slicot_tune: %s\n", error.what());
  return 1;
}

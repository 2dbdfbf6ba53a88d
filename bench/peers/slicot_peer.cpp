// SLICOT on the peers' antenna family: slicot_peer FOLDER MODES ITEM, FOLDER being what
// write_systems wrote. One JSON line a routine: CPU time of one thread (s) and the values found.
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using Complex = std::complex<double>;
using Length = std::size_t;  // of each character argument, behind the others

extern "C" {
void tb05ad_(const char* baleig, const char* inita, const int* n, const int* m, const int* p,
             const Complex* freq, double* a, const int* lda, double* b, const int* ldb, double* c,
             const int* ldc, double* rcond, Complex* g, const int* ldg, double* evre, double* evim,
             Complex* hinvb, const int* ldhinv, int* iwork, double* dwork, const int* ldwork,
             Complex* zwork, const int* lzwork, int* info, Length, Length);
void sb03md_(const char* dico, const char* job, const char* fact, const char* trana, const int* n,
             double* a, const int* lda, double* u, const int* ldu, double* c, const int* ldc,
             double* scale, double* sep, double* ferr, double* wr, double* wi, int* iwork,
             double* dwork, const int* ldwork, int* info, Length, Length, Length, Length);
void sb03od_(const char* dico, const char* fact, const char* trans, const int* n, const int* m,
             double* a, const int* lda, double* q, const int* ldq, double* b, const int* ldb,
             double* scale, double* wr, double* wi, double* dwork, const int* ldwork, int* info,
             Length, Length, Length);
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
void mb05nd_(const int* n, const double* delta, const double* a, const int* lda, double* ex,
             const int* ldex, double* exint, const int* ldexin, const double* tol, int* iwork,
             double* dwork, const int* ldwork, int* info);
void sb02md_(const char* dico, const char* hinv, const char* uplo, const char* scal,
             const char* sort, const int* n, double* a, const int* lda, double* g, const int* ldg,
             double* q, const int* ldq, double* rcond, double* wr, double* wi, double* s,
             const int* lds, double* u, const int* ldu, int* iwork, double* dwork,
             const int* ldwork, int* bwork, int* info, Length, Length, Length, Length, Length);
void sb02od_(const char* dico, const char* jobb, const char* fact, const char* uplo,
             const char* jobl, const char* sort, const int* n, const int* m, const int* p,
             double* a, const int* lda, double* b, const int* ldb, double* q, const int* ldq,
             double* r, const int* ldr, double* l, const int* ldl, double* rcond, double* x,
             const int* ldx, double* alfar, double* alfai, double* beta, double* s, const int* lds,
             double* t, const int* ldt, double* u, const int* ldu, const double* tol, int* iwork,
             double* dwork, const int* ldwork, int* bwork, int* info, Length, Length, Length,
             Length, Length, Length);
}

namespace {

using Values = std::vector<double>;

/// Column by column.
struct Matrix {
  int rows = 0, columns = 0;
  Values elements;

  double at(int i, int j) const {
    return elements[static_cast<std::size_t>(i) + static_cast<std::size_t>(j) * rows];
  }
};

Matrix zeros(int rows, int columns) {
  return {rows, columns, Values(static_cast<std::size_t>(rows) * columns)};
}

Matrix read(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::vector<Values> rows;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    rows.emplace_back();
    for (double value = 0.0; words >> value;) rows.back().push_back(value);
  }
  Matrix matrix =
      zeros(static_cast<int>(rows.size()), rows.empty() ? 0 : static_cast<int>(rows[0].size()));
  for (int j = 0; j < matrix.columns; ++j) {
    for (int i = 0; i < matrix.rows; ++i) {
      matrix.elements[static_cast<std::size_t>(i) + static_cast<std::size_t>(j) * matrix.rows] =
          rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
  }
  return matrix;
}

/// factor * left * right, with the left one transposed if asked.
Matrix outer(const Matrix& column, double factor) {
  Matrix result = zeros(column.rows, column.rows);
  for (int j = 0; j < column.rows; ++j) {
    for (int i = 0; i < column.rows; ++i) {
      result.elements[static_cast<std::size_t>(i) + static_cast<std::size_t>(j) * column.rows] =
          factor * column.at(i, 0) * column.at(j, 0);
    }
  }
  return result;
}

Matrix transposed(const Matrix& row) {
  return {row.columns, row.rows, row.elements};
}

struct System {
  Matrix a, b, c, d;
  int n = 0;
};

System read_system(const std::string& folder, const std::string& name) {
  const std::string stem = folder + "/" + name;
  System system{read(stem + "_a"), read(stem + "_b"), read(stem + "_c"), read(stem + "_d"), 0};
  system.n = system.a.rows;
  return system;
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void report(const std::string& item, const std::string& peer, int modes,
            const std::function<Values()>& work) {
  Values times, values;
  for (double spent = 0.0; times.empty() || (spent < 0.3 && times.size() < 1001);) {
    const double start = cpu_seconds();
    values = work();
    times.push_back(cpu_seconds() - start);
    spent += times.back();
  }
  std::sort(times.begin(), times.end());
  std::printf("{\"item\": \"%s\", \"peer\": \"SLICOT %s\", \"m\": %d, \"min\": %.9g, ",
              item.c_str(), peer.c_str(), modes, times.front());
  std::printf("\"med\": %.9g, \"val\": [", times[times.size() / 2]);
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::printf("%s%.17g", i > 0 ? ", " : "", values[i]);
  }
  std::printf("]}\n");
}

void expect_done(const char* routine, int info) {
  if (info != 0) throw std::runtime_error(std::string(routine) + " info " + std::to_string(info));
}

constexpr int one = 1;

Values response(const System& system, const Matrix& frequencies) {
  const int n = system.n, lwork = n * n + 20 * n + 20;
  Matrix a = system.a, b = system.b, c = system.c;
  Values evre(n), evim(n), dwork(lwork);
  std::vector<Complex> hinvb(n), zwork(lwork);
  std::vector<int> iwork(n);
  double highest = 0.0;
  Complex sum = 0.0;
  for (int k = 0; k < frequencies.rows; ++k) {
    const Complex s(0.0, frequencies.at(k, 0));
    Complex gain;
    double rcond = 0.0;
    int info = 0;
    tb05ad_("N", k == 0 ? "G" : "H", &n, &one, &one, &s, a.elements.data(), &n, b.elements.data(),
            &n, c.elements.data(), &one, &rcond, &gain, &one, evre.data(), evim.data(),
            hinvb.data(), &n, iwork.data(), dwork.data(), &lwork, zwork.data(), &lwork, &info, 1,
            1);
    expect_done("TB05AD", info);
    highest = std::max(highest, std::abs(gain));
    sum += gain;
  }
  return {highest, sum.real(), sum.imag()};
}

/// A P + P A' + B B' = 0 by the full solution.
Matrix covariance(const System& system) {
  const int n = system.n, lwork = 2 * n * n + 6 * n + 6;
  Matrix a = system.a, p = outer(system.b, -1.0), u = zeros(n, n);
  Values wr(n), wi(n), dwork(lwork);
  std::vector<int> iwork(static_cast<std::size_t>(n) * n);
  double scale = 1.0, sep = 0.0, ferr = 0.0;
  int info = 0;
  sb03md_("C", "X", "N", "T", &n, a.elements.data(), &n, u.elements.data(), &n, p.elements.data(),
          &n, &scale, &sep, &ferr, wr.data(), wi.data(), iwork.data(), dwork.data(), &lwork, &info,
          1, 1, 1, 1);
  expect_done("SB03MD", info);
  return p;
}

/// The same by its Cholesky factor, P = U U'.
Matrix covariance_factor(const System& system) {
  const int n = system.n, lwork = n * n + 8 * n + 8;
  Matrix a = system.a, u = zeros(n, n), q = zeros(n, n);
  std::copy(system.b.elements.begin(), system.b.elements.end(), u.elements.begin());
  Values wr(n), wi(n), dwork(lwork);
  double scale = 1.0;
  int info = 0;
  sb03od_("C", "N", "T", &n, &one, a.elements.data(), &n, q.elements.data(), &n, u.elements.data(),
          &n, &scale, wr.data(), wi.data(), dwork.data(), &lwork, &info, 1, 1, 1);
  expect_done("SB03OD", info);
  return u;
}

Values rms_of_covariance(const System& system) {
  const Matrix p = covariance(system);
  double variance = 0.0;
  for (int j = 0; j < system.n; ++j) {
    for (int i = 0; i < system.n; ++i)
      variance += system.c.at(0, i) * p.at(i, j) * system.c.at(0, j);
  }
  return {std::sqrt(variance)};
}

Values rms_of_factor(const System& system) {
  const Matrix u = covariance_factor(system);
  double variance = 0.0;
  for (int j = 0; j < system.n; ++j) {
    double sum = 0.0;
    for (int i = 0; i <= j; ++i) sum += system.c.at(0, i) * u.at(i, j);
    variance += sum * sum;
  }
  return {std::sqrt(variance)};
}

Values h2_norm(const System& system) {
  const int n = system.n, lwork = 4 * (n + 2) * (n + 6);
  Matrix a = system.a, b = system.b, c = system.c, d = system.d;
  Values dwork(lwork);
  const double tolerance = 0.0;
  int order = 0, warning = 0, info = 0;
  const double norm = ab13bd_("C", "H", &n, &one, &one, a.elements.data(), &n, b.elements.data(),
                              &n, c.elements.data(), &one, d.elements.data(), &one, &order,
                              &tolerance, dwork.data(), &lwork, &warning, &info, 1, 1);
  expect_done("AB13BD", info);
  return {norm};
}

Values peak(const System& system) {
  const int n = system.n, lwork = 40 * n * n + 200 * n + 200, lcwork = (n + 2) * (n + 2) + 10;
  Matrix a = system.a, b = system.b, c = system.c, d = system.d;
  Values dwork(lwork), e(1);
  std::vector<Complex> cwork(lcwork);
  std::vector<int> iwork(n);
  double frequency[2] = {0.0, 1.0}, gain[2] = {0.0, 0.0};
  const double tolerance = 1e-9;
  int info = 0;
  ab13dd_("C", "I", "S", "D", &n, &one, &one, frequency, a.elements.data(), &n, e.data(), &one,
          b.elements.data(), &n, c.elements.data(), &one, d.elements.data(), &one, gain, &tolerance,
          iwork.data(), dwork.data(), &lwork, cwork.data(), &lcwork, &info, 1, 1, 1, 1);
  expect_done("AB13DD", info);
  return {gain[0] / gain[1], frequency[0] / frequency[1]};
}

double norm(const Matrix& matrix) {
  double sum = 0.0;
  for (const double element : matrix.elements) sum += element * element;
  return std::sqrt(sum);
}

/// exp(A T) and its integral; the held input is the integral times B.
Values sampling(const System& system) {
  const int n = system.n, lwork = 2 * n * n + 10;
  Matrix ex = zeros(n, n), integral = zeros(n, n);
  Values dwork(lwork);
  std::vector<int> iwork(n);
  const double period = 1e-3, tolerance = 1e-15;
  int info = 0;
  mb05nd_(&n, &period, system.a.elements.data(), &n, ex.elements.data(), &n,
          integral.elements.data(), &n, &tolerance, iwork.data(), dwork.data(), &lwork, &info);
  expect_done("MB05ND", info);
  Matrix held = zeros(n, 1);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) held.elements[i] += integral.at(i, j) * system.b.at(j, 0);
  }
  return {norm(ex), norm(held)};
}

Values trace(const Matrix& x) {
  double sum = 0.0;
  for (int i = 0; i < x.rows; ++i) sum += x.at(i, i);
  return {sum};
}

/// X with Q = C'C and R = 1; `sampled` for the discrete equation.
Values riccati_by_schur(const System& system, bool sampled) {
  const int n = system.n, n2 = 2 * n, lwork = 8 * n2 + 3;
  Matrix a = system.a, g = outer(system.b, 1.0), x = outer(transposed(system.c), 1.0);
  Matrix s = zeros(n2, n2), u = zeros(n2, n2);
  Values wr(n2), wi(n2), dwork(lwork);
  std::vector<int> iwork(n2), bwork(n2);
  double rcond = 0.0;
  int info = 0;
  sb02md_(sampled ? "D" : "C", "I", "U", "G", "S", &n, a.elements.data(), &n, g.elements.data(), &n,
          x.elements.data(), &n, &rcond, wr.data(), wi.data(), s.elements.data(), &n2,
          u.elements.data(), &n2, iwork.data(), dwork.data(), &lwork, bwork.data(), &info, 1, 1, 1,
          1, 1);
  expect_done("SB02MD", info);
  return trace(x);
}

Values riccati_by_pencil(const System& system, bool sampled) {
  const int n = system.n, n2 = 2 * n, n3 = n2 + 1, lwork = 40 * n2 + 100;
  Matrix a = system.a, b = system.b, q = outer(transposed(system.c), 1.0), x = zeros(n, n);
  Matrix s = zeros(n3, n3), t = zeros(n3, n2), u = zeros(n2, n2);
  Values r{1.0}, l(n), alfar(n2), alfai(n2), beta(n2), dwork(lwork);
  std::vector<int> iwork(n3), bwork(n2);
  double rcond = 0.0;
  const double tolerance = 0.0;
  int info = 0;
  sb02od_(sampled ? "D" : "C", "B", "N", "U", "Z", "S", &n, &one, &one, a.elements.data(), &n,
          b.elements.data(), &n, q.elements.data(), &n, r.data(), &one, l.data(), &n, &rcond,
          x.elements.data(), &n, alfar.data(), alfai.data(), beta.data(), s.elements.data(), &n3,
          t.elements.data(), &n3, u.elements.data(), &n2, &tolerance, iwork.data(), dwork.data(),
          &lwork, bwork.data(), &info, 1, 1, 1, 1, 1, 1);
  expect_done("SB02OD", info);
  return trace(x);
}

void run(const std::string& folder, const std::string& modes, const std::string& item) {
  const int m = std::stoi(modes);
  const std::string place = folder + "/" + modes;
  if (item == "response") {
    const System wind = read_system(place, "wind");
    const Matrix frequencies = read(folder + "/frequencies");
    report(item, "TB05AD", m, [&] { return response(wind, frequencies); });
  } else if (item == "rms") {
    const System noise = read_system(place, "rms");
    report(item, "AB13BD", m, [&] { return h2_norm(noise); });
    report(item, "SB03OD", m, [&] { return rms_of_factor(noise); });
    report(item, "SB03MD", m, [&] { return rms_of_covariance(noise); });
  } else if (item == "sensitivity_peak" || item == "wind_peak") {
    const System system = read_system(place, item == "wind_peak" ? "wind" : "sensitivity");
    report(item, "AB13DD", m, [&] { return peak(system); });
  } else if (item == "sampling") {
    const System noise = read_system(place, "rms");
    report(item, "MB05ND", m, [&] { return sampling(noise); });
  } else if (item == "lyapunov") {
    const System noise = read_system(place, "rms");
    report(item, "SB03MD", m, [&] { return trace(covariance(noise)); });
    report(item, "SB03OD", m, [&] {
      const Matrix u = covariance_factor(noise);
      const double length = norm(u);
      return Values{length * length};
    });
  } else if (item == "riccati" || item == "discrete_riccati") {
    const bool sampled = item == "discrete_riccati";
    const System system = read_system(place, sampled ? "sampled" : "regulator");
    report(item, "SB02MD", m, [&] { return riccati_by_schur(system, sampled); });
    report(item, "SB02OD", m, [&] { return riccati_by_pencil(system, sampled); });
  }
}

}  // namespace

int main(int count, char** arguments) try {
  if (count != 4) throw std::runtime_error("usage: slicot_peer FOLDER MODES ITEM");
  run(arguments[1], arguments[2], arguments[3]);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "slicot_peer: %s\n", error.what());
  return 1;
}

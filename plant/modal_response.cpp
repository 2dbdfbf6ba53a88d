#include <array>
#include <cmath>
#include <cstddef>
#include <memory_resource>

#include <boresight/plant/error.hpp>
#include <boresight/plant/linear_solve.hpp>
#include <boresight/plant/modal_response.hpp>
#include <boresight/plant/vector_clones.hpp>

namespace boresight::plant {
namespace {

using Complex = std::complex<double>;

// As many frequencies as are worked on at a time: whole registers, and all sums stay in cache.
constexpr int block = 64;

// Complex numbers of a block, real and imaginary parts apart.
struct Lanes {
  std::array<double, block> re;
  std::array<double, block> im;
};

[[gnu::always_inline]] inline void set(Lanes& out, double value, int n) {
  for (int i = 0; i < n; ++i) {
    out.re[i] = value;
    out.im[i] = 0.0;
  }
}

// out += factor other
[[gnu::always_inline]] inline void add_product(Lanes& out, const Lanes& factor, const Lanes& other,
                                               int n) {
  for (int i = 0; i < n; ++i) {
    out.re[i] += factor.re[i] * other.re[i] - factor.im[i] * other.im[i];
    out.im[i] += factor.re[i] * other.im[i] + factor.im[i] * other.re[i];
  }
}

// out = numerator/denominator
[[gnu::always_inline]] inline void divide(Lanes& out, const Lanes& numerator,
                                          const Lanes& denominator, int n) {
  for (int i = 0; i < n; ++i) {
    const double dr = denominator.re[i], di = denominator.im[i];
    const double scale = 1.0 / (dr * dr + di * di);
    const double nr = numerator.re[i], ni = numerator.im[i];
    out.re[i] = (nr * dr + ni * di) * scale;
    out.im[i] = (ni * dr - nr * di) * scale;
  }
}

// 1/(w0^2 - w^2 + 2 j damping w), the difference of squares as a product so that it is exact near
// the resonance; `damping` is the distance of the pole from the axis, `rest` its square where w0 is
// the pole's imaginary part.
[[gnu::always_inline]] inline void resonance(Lanes& out, const double* w, double w0, double damping,
                                             double rest, int n) {
  for (int i = 0; i < n; ++i) {
    const double re = (w0 - w[i]) * (w0 + w[i]) + rest;
    const double im = 2.0 * damping * w[i];
    const double scale = 1.0 / (re * re + im * im);
    out.re[i] = re * scale;
    out.im[i] = -im * scale;
  }
}

}  // namespace

// What the kernels need of a ModalResponse, and their results for one block.
struct ModalBlock {
  // Sums of the core's entries over its sections, `stride` arrays apart.
  BORESIGHT_VECTOR_CLONES static void core_entries(const ModalResponse& response, const double* w,
                                                   int n, Lanes* entries) {
    const std::size_t count = response.entries_.size();
    for (std::size_t e = 0; e < count; ++e) set(entries[e], response.feedthrough_[e], n);
    Lanes inverse, slope;
    for (const auto& section : response.sections_) {
      const bool pair = section.pole.imag() > 0.0;
      const double decay = -section.pole.real();
      if (pair) {
        resonance(inverse, w, section.pole.imag(), decay, decay * decay, n);
        for (int i = 0; i < n; ++i) {
          slope.re[i] = -w[i] * inverse.im[i];
          slope.im[i] = w[i] * inverse.re[i];
        }
      } else {
        for (int i = 0; i < n; ++i) {
          const double scale = 1.0 / (decay * decay + w[i] * w[i]);
          inverse.re[i] = decay * scale;
          inverse.im[i] = -w[i] * scale;
        }
      }
      for (std::size_t e = 0; e < count; ++e) {
        const double level = section.level[e];
        const double rise = section.slope[e];
        if (level == 0.0 && rise == 0.0) continue;
        double* re = entries[e].re.data();
        double* im = entries[e].im.data();
        if (pair) {
          for (int i = 0; i < n; ++i) {
            re[i] += level * inverse.re[i] + rise * slope.re[i];
            im[i] += level * inverse.im[i] + rise * slope.im[i];
          }
        } else {
          for (int i = 0; i < n; ++i) {
            re[i] += level * inverse.re[i];
            im[i] += level * inverse.im[i];
          }
        }
      }
    }
  }

  // Sums over the modes, four at a time so that a sum is loaded and stored less often.
  BORESIGHT_VECTOR_CLONES static void mode_sums(const double* frequency, const double* damping,
                                                const double* gain, std::size_t modes,
                                                std::size_t paths, const double* w, int n,
                                                Lanes* sums) {
    for (std::size_t p = 0; p < paths; ++p) set(sums[p], 0.0, n);
    std::array<Lanes, 4> term;
    std::size_t k = 0;
    for (; k + 4 <= modes; k += 4) {
      for (std::size_t q = 0; q < 4; ++q) {
        resonance(term[q], w, frequency[k + q], damping[k + q] * frequency[k + q], 0.0, n);
      }
      for (std::size_t p = 0; p < paths; ++p) {
        const double g0 = gain[k * paths + p], g1 = gain[(k + 1) * paths + p];
        const double g2 = gain[(k + 2) * paths + p], g3 = gain[(k + 3) * paths + p];
        double* re = sums[p].re.data();
        double* im = sums[p].im.data();
        for (int i = 0; i < n; ++i) {
          re[i] +=
              (g0 * term[0].re[i] + g1 * term[1].re[i]) + (g2 * term[2].re[i] + g3 * term[3].re[i]);
          im[i] +=
              (g0 * term[0].im[i] + g1 * term[1].im[i]) + (g2 * term[2].im[i] + g3 * term[3].im[i]);
        }
      }
    }
    for (; k < modes; ++k) {
      resonance(term[0], w, frequency[k], damping[k] * frequency[k], 0.0, n);
      for (std::size_t p = 0; p < paths; ++p) {
        const double g = gain[k * paths + p];
        for (int i = 0; i < n; ++i) {
          sums[p].re[i] += g * term[0].re[i];
          sums[p].im[i] += g * term[0].im[i];
        }
      }
    }
  }

  // out += j w rate
  BORESIGHT_VECTOR_CLONES static void add_rate(Lanes& out, const Lanes& rate, const double* w,
                                               int n) {
    for (int i = 0; i < n; ++i) {
      out.re[i] -= w[i] * rate.im[i];
      out.im[i] += w[i] * rate.re[i];
    }
  }

  // out += factor other, as a function of its own for the clones.
  BORESIGHT_VECTOR_CLONES static void accumulate(Lanes& out, const Lanes& factor,
                                                 const Lanes& other, int n) {
    add_product(out, factor, other, n);
  }

  // force = numerator/(1 - loop)
  BORESIGHT_VECTOR_CLONES static void close(Lanes& force, const Lanes& numerator, Lanes& loop,
                                            int n) {
    for (int i = 0; i < n; ++i) {
      loop.re[i] = 1.0 - loop.re[i];
      loop.im[i] = -loop.im[i];
    }
    divide(force, numerator, loop, n);
  }

  // The core's entries where its eigenvectors do not serve.
  static void dense_entries(const ModalResponse& response, const double* w, int n, Lanes* entries) {
    const StateSpace& core = response.reduction_.core;
    for (int i = 0; i < n; ++i) {
      const Eigen::MatrixXcd at = transfer_matrix(core.a, core.b, core.c, core.d, {0.0, w[i]});
      for (std::size_t e = 0; e < response.entries_.size(); ++e) {
        const Complex value = at(response.entries_[e].row, response.entries_[e].column);
        entries[e].re[i] = value.real();
        entries[e].im[i] = value.imag();
      }
    }
  }
};

namespace {

// Memory for the sums of a block: on the stack for any usual number of ports.
class Workspace {
 public:
  Lanes* take(std::size_t count) {
    return static_cast<Lanes*>(pool_.allocate(count * sizeof(Lanes), alignof(Lanes)));
  }

 private:
  alignas(64) std::array<std::byte, 64 * sizeof(Lanes)> memory_;
  std::pmr::monotonic_buffer_resource pool_{memory_.data(), memory_.size()};
};

// Solves the small system of a block frequency by frequency, Gaussian elimination with partial
// pivoting; matrix[i * count + j] and right[i] are Lanes, the solution replaces `right`.
void solve_small(Lanes* matrix, Lanes* right, std::size_t count, int n) {
  std::array<std::array<Complex, most_drives + 1>, most_drives> rows;
  for (int lane = 0; lane < n; ++lane) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        const Lanes& element = matrix[i * count + j];
        rows[i][j] = {element.re[lane], element.im[lane]};
      }
      rows[i][count] = {right[i].re[lane], right[i].im[lane]};
    }
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t pivot = i;
      for (std::size_t k = i + 1; k < count; ++k) {
        if (std::norm(rows[k][i]) > std::norm(rows[pivot][i])) pivot = k;
      }
      std::swap(rows[i], rows[pivot]);
      for (std::size_t k = i + 1; k < count; ++k) {
        const Complex factor = rows[k][i] / rows[i][i];
        for (std::size_t j = i; j <= count; ++j) rows[k][j] -= factor * rows[i][j];
      }
    }
    for (std::size_t i = count; i-- > 0;) {
      Complex value = rows[i][count];
      for (std::size_t j = i + 1; j < count; ++j) value -= rows[i][j] * rows[j][count];
      value /= rows[i][i];
      rows[i][count] = value;
      right[i].re[lane] = value.real();
      right[i].im[lane] = value.imag();
    }
  }
}

}  // namespace

ModalResponse::ModalResponse(const ModalSystem& system, std::string_view input,
                             std::string_view output)
    : reduction_(reduce(system, input, output)) {
  const StateSpace& core = reduction_.core;
  const Eigen::Index rows = core.d.rows(), columns = core.d.cols();
  entry_number_.assign(static_cast<std::size_t>(rows),
                       std::vector<int>(static_cast<std::size_t>(columns), -1));
  for (Eigen::Index r = 0; r < rows; ++r) {
    for (Eigen::Index c = 0; c < columns; ++c) {
      if (!reduction_.entry(r, c)) continue;
      entry_number_[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] =
          static_cast<int>(entries_.size());
      entries_.push_back({r, c});
      feedthrough_.push_back(core.d(r, c));
    }
  }
  try {
    core_ = modal_form(core);
    by_modes_ = core_.condition <= highest_modal_condition;
  } catch (const NumericalFailure&) {
    by_modes_ = false;
  }
  if (!by_modes_) core_ = {};
  for (Eigen::Index i = 0; i < core_.poles.size(); ++i) {
    Section section{core_.poles[i], {}, {}};
    for (const auto& entry : entries_) {
      const Complex residue = core_.output(entry.row, i) * core_.input(i, entry.column);
      const bool pair = section.pole.imag() > 0.0;
      section.level.push_back(pair ? -2.0 * (residue * std::conj(section.pole)).real()
                                   : residue.real());
      section.slope.push_back(pair ? 2.0 * residue.real() : 0.0);
    }
    sections_.push_back(std::move(section));
  }

  path_number_.assign(reduction_.returns.size(), std::vector<int>(reduction_.in_loop.size(), -1));
  for (std::size_t p = 0; p < reduction_.paths.size(); ++p) {
    const auto& path = reduction_.paths[p];
    path_number_[path.to_return][path.from_drive] = static_cast<int>(p);
    if (path.gain.size() > 0) mode_path_.push_back(p);
  }
  for (Eigen::Index i = 0; i < reduction_.mode_frequency.size(); ++i) {
    for (const std::size_t p : mode_path_) mode_gain_.push_back(reduction_.paths[p].gain[i]);
  }
}

void ModalResponse::evaluate_block(const double* w, int n, Complex* result) const {
  Workspace workspace;
  const std::size_t drives = reduction_.in_loop.size();
  const std::size_t returns = reduction_.returns.size();

  Lanes* entries = workspace.take(entries_.size());
  if (by_modes_) {
    ModalBlock::core_entries(*this, w, n, entries);
  } else {
    ModalBlock::dense_entries(*this, w, n, entries);
  }
  const auto entry = [&](std::size_t row, Eigen::Index column) -> Lanes* {
    const int number = column < 0 ? -1 : entry_number_[row][static_cast<std::size_t>(column)];
    return number < 0 ? nullptr : entries + number;
  };

  // The modes' sums and the dead times, [path].
  Lanes* sums = workspace.take(mode_path_.size());
  ModalBlock::mode_sums(
      reduction_.mode_frequency.data(), reduction_.mode_damping_ratio.data(), mode_gain_.data(),
      static_cast<std::size_t>(reduction_.mode_frequency.size()), mode_path_.size(), w, n, sums);
  std::array<Lanes*, most_drives * most_drives> few{};
  std::vector<Lanes*> many;
  Lanes** transfer = few.data();
  if (reduction_.paths.size() > few.size()) {
    many.resize(reduction_.paths.size());
    transfer = many.data();
  }
  for (std::size_t p = 0; p < mode_path_.size(); ++p) transfer[mode_path_[p]] = sums + p;
  for (std::size_t p = 0; p < reduction_.paths.size(); ++p) {
    if (reduction_.paths[p].gain.size() > 0) continue;
    transfer[p] = workspace.take(1);
    const double delay = reduction_.returns[reduction_.paths[p].to_return].delay;
    for (int i = 0; i < n; ++i) {
      transfer[p]->re[i] = std::cos(w[i] * delay);
      transfer[p]->im[i] = -std::sin(w[i] * delay);
    }
  }
  for (std::size_t p = 0; p < reduction_.paths.size(); ++p) {
    const double within = reduction_.paths[p].within_core;
    if (within == 0.0) continue;
    for (int i = 0; i < n; ++i) transfer[p]->re[i] -= within;
  }
  const auto path = [&](std::size_t to, std::size_t from) -> Lanes* {
    const int number = path_number_[to][from];
    return number < 0 ? nullptr : transfer[number];
  };

  const auto zero = [&] {
    Lanes* lanes = workspace.take(1);
    set(*lanes, 0.0, n);
    return lanes;
  };
  // What a row of the core makes of return j: its entry plus j w times that of the rate, in place.
  const auto from_return = [&](std::size_t row, std::size_t j) -> Lanes* {
    const auto& back = reduction_.returns[j];
    Lanes* direct = entry(row, back.column);
    Lanes* rate = entry(row, back.rate_column);
    if (direct == nullptr && rate != nullptr) direct = zero();
    if (rate != nullptr) ModalBlock::add_rate(*direct, *rate, w, n);
    return direct;
  };

  // Drives known from the input alone, and the returns that they make.
  std::array<Lanes*, most_drives> drive{};
  std::array<std::size_t, most_drives> looped{};
  std::size_t unknowns = 0;
  for (std::size_t k = 0; k < drives; ++k) {
    if (reduction_.in_loop[k]) {
      looped[unknowns++] = k;
    } else {
      drive[k] = entry(1 + k, 0);
    }
  }
  Lanes* moved = workspace.take(returns);
  for (std::size_t j = 0; j < returns; ++j) {
    set(moved[j], 0.0, n);
    for (std::size_t k = 0; k < drives; ++k) {
      const Lanes* through = path(j, k);
      if (through != nullptr && drive[k] != nullptr) {
        ModalBlock::accumulate(moved[j], *through, *drive[k], n);
      }
    }
  }

  // The drives in loops: (1 - loop) drive = right.
  Lanes* loop = workspace.take(unknowns * unknowns);
  Lanes* right = workspace.take(unknowns);
  for (std::size_t u = 0; u < unknowns; ++u) {
    const std::size_t row = 1 + looped[u];
    const Lanes* direct = entry(row, 0);
    set(right[u], 0.0, n);
    if (direct != nullptr) right[u] = *direct;
    for (std::size_t v = 0; v < unknowns; ++v) set(loop[u * unknowns + v], 0.0, n);
    for (std::size_t j = 0; j < returns; ++j) {
      const Lanes* back = from_return(row, j);
      if (back == nullptr) continue;
      ModalBlock::accumulate(right[u], *back, moved[j], n);
      for (std::size_t v = 0; v < unknowns; ++v) {
        const Lanes* through = path(j, looped[v]);
        if (through != nullptr) {
          ModalBlock::accumulate(loop[u * unknowns + v], *back, *through, n);
        }
      }
    }
  }
  if (unknowns == 1) {
    drive[looped[0]] = workspace.take(1);
    ModalBlock::close(*drive[looped[0]], right[0], loop[0], n);
  } else if (unknowns > 1) {
    for (std::size_t e = 0; e < unknowns * unknowns; ++e) {
      for (int i = 0; i < n; ++i) {
        loop[e].re[i] = (e % (unknowns + 1) == 0 ? 1.0 : 0.0) - loop[e].re[i];
        loop[e].im[i] = -loop[e].im[i];
      }
    }
    solve_small(loop, right, unknowns, n);
    for (std::size_t u = 0; u < unknowns; ++u) drive[looped[u]] = right + u;
  }
  for (std::size_t u = 0; u < unknowns; ++u) {
    for (std::size_t j = 0; j < returns; ++j) {
      const Lanes* through = path(j, looped[u]);
      if (through != nullptr) ModalBlock::accumulate(moved[j], *through, *drive[looped[u]], n);
    }
  }

  Lanes* output = entry(0, 0);
  if (output == nullptr) output = zero();
  for (std::size_t j = 0; j < returns; ++j) {
    const Lanes* back = from_return(0, j);
    if (back != nullptr) ModalBlock::accumulate(*output, *back, moved[j], n);
  }
  for (int i = 0; i < n; ++i) result[i] = {output->re[i], output->im[i]};
}

std::complex<double> ModalResponse::at(double angular_frequency) const {
  Complex result;
  evaluate_block(&angular_frequency, 1, &result);
  return result;
}

void ModalResponse::evaluate(const Eigen::ArrayXd& angular_frequency,
                             Eigen::ArrayXcd& response) const {
  response.resize(angular_frequency.size());
  for (Eigen::Index i = 0; i < angular_frequency.size(); i += block) {
    const Eigen::Index count = std::min<Eigen::Index>(block, angular_frequency.size() - i);
    evaluate_block(angular_frequency.data() + i, static_cast<int>(count), response.data() + i);
  }
}

}  // namespace boresight::plant

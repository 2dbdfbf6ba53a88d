#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory_resource>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/modal/modal_response.hpp>

namespace boresight::plant {
namespace {

using Complex = std::complex<double>;

// Memory for the sums of a block: on the stack for any usual number of ports.
// NOLINTNEXTLINE(*-member-init): memory to be handed out, written before it is read
class Workspace {
 public:
  FrequencyLanes* take(std::size_t count) {
    return static_cast<FrequencyLanes*>(
        pool_.allocate(count * sizeof(FrequencyLanes), alignof(FrequencyLanes)));
  }

 private:
  alignas(64) std::array<std::byte, 64 * sizeof(FrequencyLanes)> memory_;
  std::pmr::monotonic_buffer_resource pool_{memory_.data(), memory_.size()};
};

// Solves the small system of a block frequency by frequency, Gaussian elimination with partial
// pivoting; matrix[i * count + j] and right[i] are FrequencyLanes, the solution replaces `right`.
void solve_small(FrequencyLanes* matrix, FrequencyLanes* right, std::size_t count, std::size_t n) {
  std::array<std::array<Complex, max_drives + 1>, max_drives> rows;
  for (std::size_t lane = 0; lane < n; ++lane) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        const FrequencyLanes& element = matrix[i * count + j];
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
  bool by_modes = true;
  try {
    core_ = modal_form(core);
    by_modes = core_.condition <= highest_modal_condition;
  } catch (const NumericalFailure&) {
    by_modes = false;
  }
  if (!by_modes) {
    core_ = {};
    dense_.emplace(core);
  }
  for (Eigen::Index i = 0; i < core_.poles.size(); ++i) {
    PoleSection section{core_.poles[i], {}, {}};
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

// The core's entries where its eigenvectors do not serve; infinite at a pole.
void ModalResponse::dense_entries(DenseResponse& dense, const double* w, std::size_t n,
                                  FrequencyLanes* entries) const {
  for (std::size_t i = 0; i < n; ++i) {
    if (!dense.evaluate({0.0, w[i]}, dense_values_)) {
      dense_values_.fill(std::numeric_limits<double>::infinity());
    }
    for (std::size_t e = 0; e < entries_.size(); ++e) {
      const Complex value = dense_values_(entries_[e].row, entries_[e].column);
      entries[e].re[i] = value.real();
      entries[e].im[i] = value.imag();
    }
  }
}

void ModalResponse::evaluate_block(const double* w, std::size_t n, Complex* result) const {
  Workspace workspace;
  const std::size_t drives = reduction_.in_loop.size();
  const std::size_t returns = reduction_.returns.size();

  FrequencyLanes* entries = workspace.take(entries_.size());
  if (dense_) {
    dense_entries(*dense_, w, n, entries);
  } else {
    frequency_kernels::sum_sections(sections_, feedthrough_, w, n, entries);
  }
  const auto entry = [&](std::size_t row, Eigen::Index column) -> FrequencyLanes* {
    const int number = column < 0 ? -1 : entry_number_[row][static_cast<std::size_t>(column)];
    return number < 0 ? nullptr : entries + number;
  };

  // The modes' sums and the dead times, [path].
  FrequencyLanes* sums = workspace.take(mode_path_.size());
  frequency_kernels::sum_modes(
      reduction_.mode_frequency.data(), reduction_.mode_damping_ratio.data(), mode_gain_.data(),
      static_cast<std::size_t>(reduction_.mode_frequency.size()), mode_path_.size(), w, n, sums);
  std::array<FrequencyLanes*, max_drives * max_drives> few{};
  std::vector<FrequencyLanes*> many;
  FrequencyLanes** transfer = few.data();
  if (reduction_.paths.size() > few.size()) {
    many.resize(reduction_.paths.size());
    transfer = many.data();
  }
  for (std::size_t p = 0; p < mode_path_.size(); ++p) transfer[mode_path_[p]] = sums + p;
  for (std::size_t p = 0; p < reduction_.paths.size(); ++p) {
    if (reduction_.paths[p].gain.size() > 0) continue;
    transfer[p] = workspace.take(1);
    const double delay = reduction_.returns[reduction_.paths[p].to_return].delay;
    for (std::size_t i = 0; i < n; ++i) {
      transfer[p]->re[i] = std::cos(w[i] * delay);
      transfer[p]->im[i] = -std::sin(w[i] * delay);
    }
  }
  for (std::size_t p = 0; p < reduction_.paths.size(); ++p) {
    const double within = reduction_.paths[p].within_core;
    if (within == 0.0) continue;
    for (std::size_t i = 0; i < n; ++i) transfer[p]->re[i] -= within;
  }
  const auto path = [&](std::size_t to, std::size_t from) -> FrequencyLanes* {
    const int number = path_number_[to][from];
    return number < 0 ? nullptr : transfer[number];
  };

  const auto zero = [&] {
    FrequencyLanes* lanes = workspace.take(1);
    frequency_kernels::set(*lanes, 0.0, n);
    return lanes;
  };
  // What a row of the core makes of return j: its entry plus j w times that of the rate, in place.
  const auto from_return = [&](std::size_t row, std::size_t j) -> FrequencyLanes* {
    const auto& back = reduction_.returns[j];
    FrequencyLanes* direct = entry(row, back.column);
    FrequencyLanes* rate = entry(row, back.rate_column);
    if (direct == nullptr && rate != nullptr) direct = zero();
    if (rate != nullptr) frequency_kernels::add_rate(*direct, *rate, w, n);
    return direct;
  };

  // Drives known from the input alone, and the returns that they make.
  std::array<FrequencyLanes*, max_drives> drive{};
  std::array<std::size_t, max_drives> looped{};
  std::size_t unknowns = 0;
  for (std::size_t k = 0; k < drives; ++k) {
    if (reduction_.in_loop[k]) {
      looped[unknowns++] = k;
    } else {
      drive[k] = entry(1 + k, 0);
    }
  }
  FrequencyLanes* moved = workspace.take(returns);
  for (std::size_t j = 0; j < returns; ++j) {
    frequency_kernels::set(moved[j], 0.0, n);
    for (std::size_t k = 0; k < drives; ++k) {
      const FrequencyLanes* through = path(j, k);
      if (through != nullptr && drive[k] != nullptr) {
        frequency_kernels::accumulate(moved[j], *through, *drive[k], n);
      }
    }
  }

  // The drives in loops: (1 - loop) drive = right.
  FrequencyLanes* loop = workspace.take(unknowns * unknowns);
  FrequencyLanes* right = workspace.take(unknowns);
  for (std::size_t u = 0; u < unknowns; ++u) {
    const std::size_t row = 1 + looped[u];
    const FrequencyLanes* direct = entry(row, 0);
    frequency_kernels::set(right[u], 0.0, n);
    if (direct != nullptr) right[u] = *direct;
    for (std::size_t v = 0; v < unknowns; ++v)
      frequency_kernels::set(loop[u * unknowns + v], 0.0, n);
    for (std::size_t j = 0; j < returns; ++j) {
      const FrequencyLanes* back = from_return(row, j);
      if (back == nullptr) continue;
      frequency_kernels::accumulate(right[u], *back, moved[j], n);
      for (std::size_t v = 0; v < unknowns; ++v) {
        const FrequencyLanes* through = path(j, looped[v]);
        if (through != nullptr) {
          frequency_kernels::accumulate(loop[u * unknowns + v], *back, *through, n);
        }
      }
    }
  }
  if (unknowns == 1) {
    drive[looped[0]] = workspace.take(1);
    frequency_kernels::close_loop(*drive[looped[0]], right[0], loop[0], n);
  } else if (unknowns > 1) {
    for (std::size_t e = 0; e < unknowns * unknowns; ++e) {
      for (std::size_t i = 0; i < n; ++i) {
        loop[e].re[i] = (e % (unknowns + 1) == 0 ? 1.0 : 0.0) - loop[e].re[i];
        loop[e].im[i] = -loop[e].im[i];
      }
    }
    solve_small(loop, right, unknowns, n);
    for (std::size_t u = 0; u < unknowns; ++u) drive[looped[u]] = right + u;
  }
  for (std::size_t u = 0; u < unknowns; ++u) {
    for (std::size_t j = 0; j < returns; ++j) {
      const FrequencyLanes* through = path(j, looped[u]);
      if (through != nullptr)
        frequency_kernels::accumulate(moved[j], *through, *drive[looped[u]], n);
    }
  }

  FrequencyLanes* output = entry(0, 0);
  if (output == nullptr) output = zero();
  for (std::size_t j = 0; j < returns; ++j) {
    const FrequencyLanes* back = from_return(0, j);
    if (back != nullptr) frequency_kernels::accumulate(*output, *back, moved[j], n);
  }
  for (std::size_t i = 0; i < n; ++i) result[i] = {output->re[i], output->im[i]};
}

std::complex<double> ModalResponse::at(double angular_frequency) const {
  Complex result;
  evaluate_block(&angular_frequency, 1, &result);
  return result;
}

void ModalResponse::evaluate(const Eigen::ArrayXd& angular_frequency,
                             Eigen::ArrayXcd& response) const {
  response.resize(angular_frequency.size());
  const auto size = static_cast<std::size_t>(angular_frequency.size());
  for (std::size_t i = 0; i < size; i += frequency_block) {
    evaluate_block(angular_frequency.data() + i, std::min(frequency_block, size - i),
                   response.data() + i);
  }
}

}  // namespace boresight::plant

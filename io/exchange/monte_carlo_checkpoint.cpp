#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include <boresight/io/exchange/monte_carlo_checkpoint.hpp>
#include <boresight/io/files/input_files.hpp>
#include <boresight/io/files/write_atomically.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using design::MonteCarloRun;
using design::PlantOutcome;

constexpr std::string_view first_line = "boresight montecarlo checkpoint 2\n";

// A block's number, its outcomes (the last block filled up with empty ones), the digest of both.
constexpr std::size_t number_size = sizeof(std::uint64_t);
constexpr std::size_t outcomes_size = MonteCarloRun::block_size * sizeof(PlantOutcome);
constexpr std::size_t digest_size = 64;  // sha256_hex
constexpr std::size_t record_size = number_size + outcomes_size + digest_size;
// First line, digest of the run, its plants, digest of these.
constexpr std::size_t header_size = first_line.size() + digest_size + number_size + digest_size;

void append(std::string& bytes, std::uint64_t number) {
  std::array<char, number_size> raw{};
  std::memcpy(raw.data(), &number, raw.size());
  bytes.append(raw.data(), raw.size());
}

std::uint64_t number_at(std::string_view bytes, std::size_t place) {
  std::uint64_t number = 0;
  std::memcpy(&number, bytes.data() + place, number_size);
  return number;
}

std::vector<std::size_t> whole_blocks(const MonteCarloRun& run) {
  std::vector<std::size_t> blocks;
  for (std::size_t block = 0; block < run.blocks(); ++block) {
    if (run.whole(block)) blocks.push_back(block);
  }
  return blocks;
}

}  // namespace

std::string digest_of(std::string_view version, std::string_view input,
                      const design::MonteCarlo& study,
                      const design::PlantDistribution& distribution, std::uint64_t seed) {
  std::string all =
      fmt::format("{}\n{}\n{} {} {} {}\n{}", version, input, seed, study.plants, study.retune,
                  study.confirm_every, study.controller.structure.name());
  const auto add = [&](double number) { fmt::format_to(std::back_inserter(all), " {}", number); };
  for (const double gain : study.controller.gains) add(gain);
  if (const auto* system = study.controller.structure.state_space()) {
    for (const auto* matrix : {&system->a, &system->b, &system->c, &system->d}) {
      for (const double element : matrix->reshaped()) add(element);
    }
  }
  for (std::uint64_t index = 0; index < 8; ++index) {
    for (const double value : distribution.draw(seed, index).values) add(value);
  }
  const auto outcome = design::MonteCarloEvaluator(study).evaluate(0);
  add(outcome.boresight_rms);
  add(outcome.control_effort);
  add(outcome.worst_constraint);
  for (const double peak : outcome.sensitivity_peaks) add(peak);
  return sha256_hex(all);
}

std::string to_bytes(const MonteCarloRun& run, const std::vector<std::size_t>& blocks) {
  std::string bytes;
  bytes.reserve(blocks.size() * record_size);
  std::string record;
  for (const std::size_t block : blocks) {
    record.clear();
    append(record, block);
    const auto outcomes = run.outcomes(block);
    std::array<PlantOutcome, MonteCarloRun::block_size> all{};
    std::ranges::copy(outcomes, all.begin());
    const std::size_t start = record.size();
    record.resize(start + outcomes_size);
    std::memcpy(record.data() + start, all.data(), outcomes_size);
    bytes += record + sha256_hex(record);
  }
  return bytes;
}

std::size_t put_blocks(std::string_view bytes, MonteCarloRun& run) {
  std::size_t put = 0;
  for (; bytes.size() >= record_size; bytes.remove_prefix(record_size)) {
    const std::string_view record = bytes.substr(0, record_size - digest_size);
    const std::uint64_t block = number_at(record, 0);
    const std::string_view digest = bytes.substr(record.size(), digest_size);
    if (sha256_hex(record) != digest || block >= run.blocks()) continue;
    std::array<PlantOutcome, MonteCarloRun::block_size> all{};
    std::memcpy(all.data(), record.data() + number_size, outcomes_size);
    const auto place = static_cast<std::size_t>(block);
    run.put(place, {all.data(), run.outcomes(place).size()});
    ++put;
  }
  return put;
}

void write_checkpoint(const std::string& path, std::string_view digest, const MonteCarloRun& run) {
  std::string bytes(first_line);
  bytes += digest;
  append(bytes, run.study().plants);
  bytes += sha256_hex(bytes);
  write_atomically(path, bytes + to_bytes(run, whole_blocks(run)));
}

std::size_t read_checkpoint(const std::string& path, std::string_view digest, MonteCarloRun& run) {
  std::error_code none;
  if (!std::filesystem::exists(path, none)) return 0;
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const std::string_view all = bytes;
  const std::size_t checked = header_size - digest_size;
  if (!file || all.size() < header_size || !all.starts_with(first_line) ||
      sha256_hex(all.substr(0, checked)) != all.substr(checked, digest_size)) {
    throw InvalidInput(
        fmt::format("{}: expected a checkpoint of boresight montecarlo, found another file or one "
                    "whose beginning is damaged; remove it to begin anew",
                    path));
  }
  if (all.substr(first_line.size(), digest_size) != digest ||
      number_at(all, first_line.size() + digest_size) != run.study().plants) {
    throw InvalidInput(fmt::format(
        "{}: is the checkpoint of another run: case, records, options, controller or program "
        "differ; remove it to begin anew, or name another with --checkpoint",
        path));
  }
  return put_blocks(all.substr(header_size), run);
}

}  // namespace boresight::io

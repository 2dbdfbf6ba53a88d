#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/design/ensembles/monte_carlo.hpp>
#include <boresight/design/ensembles/plant_distribution.hpp>

namespace boresight::io {

/// Digest that identifies a run, 64 hexadecimal digits. It covers the program's version, the text
/// of its case, seed, options and controller. It also covers the first plants, which depend on the
/// case's other files, and one outcome, which depends on this program.
/// @throws as design::MonteCarloEvaluator.
std::string digest_of(std::string_view version, std::string_view input,
                      const design::MonteCarlo& study,
                      const design::PlantDistribution& distribution, std::uint64_t seed);

/// The complete blocks of a run, as bytes: for a checkpoint or another rank.
std::string to_bytes(const design::MonteCarloRun& run, const std::vector<std::size_t>& blocks);

/// Adds the complete, undamaged blocks in `bytes` to a run; returns their number. Truncated or
/// altered blocks are left out.
std::size_t put_blocks(std::string_view bytes, design::MonteCarloRun& run);

/// Writes a run's complete blocks with the digest of the run (digest_of). The write is atomic: the
/// file is always either the previous or the new one.
/// @throws InvalidInput if it cannot be written.
void write_checkpoint(const std::string& path, std::string_view digest,
                      const design::MonteCarloRun& run);

/// Resumes a run from its checkpoint; returns the number of blocks read, 0 without a file.
/// Truncated or altered blocks are left out and computed again.
/// @throws InvalidInput for a file that is not a checkpoint, or that of another run.
std::size_t read_checkpoint(const std::string& path, std::string_view digest,
                            design::MonteCarloRun& run);

}  // namespace boresight::io

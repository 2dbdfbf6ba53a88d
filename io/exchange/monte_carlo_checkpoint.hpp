#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/design/ensembles/monte_carlo.hpp>
#include <boresight/design/ensembles/plant_distribution.hpp>

namespace boresight::io {

/// What makes a run this one and no other, 64 hexadecimal digits: the program's version, the text
/// of its case, seed, options and law; its first plants, which hold what the case's other files
/// say, and the outcome of one, which holds what this program makes of it.
/// @throws as design::MonteCarloJudge.
std::string digest_of(std::string_view version, std::string_view input,
                      const design::MonteCarlo& study,
                      const design::PlantDistribution& distribution, std::uint64_t seed);

/// The whole blocks of a run, as bytes: for a checkpoint or another rank.
std::string to_bytes(const design::MonteCarloRun& run, const std::vector<std::size_t>& blocks);

/// Puts the whole, undamaged blocks of such bytes into a run; how many. What is cut off or altered
/// is left out.
std::size_t put_blocks(std::string_view bytes, design::MonteCarloRun& run);

/// Writes a run's whole blocks with the digest of what was run (digest_of): the file is whole
/// at any time, the one before or this one. @throws InvalidInput if it cannot be written.
void write_checkpoint(const std::string& path, std::string_view digest,
                      const design::MonteCarloRun& run);

/// Takes up a run where its checkpoint left it; how many blocks that gave, 0 without a file. Blocks
/// that are cut off or altered are left out and worked on again.
/// @throws InvalidInput for a file that is none, or one of another run.
std::size_t read_checkpoint(const std::string& path, std::string_view digest,
                            design::MonteCarloRun& run);

}  // namespace boresight::io

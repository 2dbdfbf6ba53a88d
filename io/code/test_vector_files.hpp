#pragma once

#include <vector>

#include <boresight/control/program/test_vectors.hpp>
#include <boresight/io/code/code_writer.hpp>

namespace boresight::io {

/// NAME.csv of each vector (a row per sample: number, inputs, outputs), and tolerances.csv (a row
/// per vector: its file, its number of samples, then per output the tolerance in double precision,
/// then those in single precision). Numbers have 17 digits; nan and inf are spelled so. Lines that
/// begin with # are comments.
std::vector<CodeFile> test_vector_files(const control::program::Program& program,
                                        const std::vector<control::program::TestVector>& vectors);

}  // namespace boresight::io

#include <algorithm>

#include <gtest/gtest.h>

#include <boresight/io/case/case_file.hpp>
#include <boresight/io/files/input_files.hpp>

namespace boresight::io {
namespace {

// FIPS 180-4's own examples.
TEST(InputFiles, DigestsArePublishedOnes) {
  EXPECT_EQ(io::sha256_hex("abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(io::sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(io::sha256_base64("abc"), "ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0=");
}

TEST(InputFiles, ACaseAndWhatItNamesAreNotedOnce) {
  const std::string path = BORESIGHT_SOURCE_DIR "/cases/dss14-70m/case.toml";
  io::read_case(path);
  io::read_case(path);
  const auto files = io::inputs_read();
  const auto is_case = [&](const io::InputFile& file) { return file.path == path; };
  ASSERT_EQ(std::ranges::count_if(files, is_case), 1);
  const auto found = std::ranges::find_if(files, is_case);
  EXPECT_GT(found->bytes, 1000U);
  EXPECT_EQ(found->sha256.size(), 64U);
}

}  // namespace
}  // namespace boresight::io

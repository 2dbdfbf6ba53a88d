#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace boresight::app {

/// Distinction of series: by colour (after Okabe and Ito, "Color universal design", 2008:
/// distinguishable for the colour-blind), in grey by dashes, marker shapes and hatching.
struct SeriesLook {
  const char* colour = "";
  const char* dashes = "";        // of lines; empty: solid
  const char* short_dashes = "";  // of dashed lines
  int marker = 0;
  double fill = 1.0;   // opacity of bars
  double hatch = 0.0;  // slope of the hatching of bars; 0: none
};

/// All different up to 64.
inline SeriesLook series_look(std::size_t index) {
  static constexpr std::array<SeriesLook, 8> looks{
      {{"#0072b2", "", "5 3", 0, 0.85, 0.0},
       {"#d55e00", "9 3", "3.5 2.5", 1, 0.22, 1.0},
       {"#009e73", "9 2.5 2 2.5", "6 2 2 2", 2, 0.5, 0.0},
       {"#b0508a", "2 2.2", "1.5 3", 3, 0.22, -1.0},
       {"#333333", "14 3", "4 4", 4, 0.7, 0.0},
       {"#e08e00", "9 2.5 2 2.5 2 2.5", "6 2 2 2 2 2", 5, 0.3, 0.5},
       {"#3a9bdc", "5 2", "3 3", 6, 0.15, 0.0},
       {"#7a7a7a", "14 3 2 3", "2 5", 7, 0.3, -0.5}}};
  SeriesLook look = looks.at(index % looks.size());
  const std::size_t round = index / looks.size();
  look.dashes = looks.at((index + 3 * round) % looks.size()).dashes;
  look.short_dashes = looks.at((index + 3 * round) % looks.size()).short_dashes;
  look.marker = looks.at((index + 5 * round) % looks.size()).marker;
  return look;
}

}  // namespace boresight::app

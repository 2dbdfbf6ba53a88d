#include <vector>

#include <toml++/toml.h>

#include "neighbour.hpp"
#include <boresight/plant/allowed.hpp>

#include "neighbour.hpp"
#include <boresight/app/io/case_file.hpp>
#include <boresight/design/tuner.hpp>

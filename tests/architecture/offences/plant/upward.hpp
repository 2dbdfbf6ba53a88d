#include <boresight/app/io/units.hpp>
#include <boresight/control/loop.hpp>
#include <boresight/plant/allowed.hpp>

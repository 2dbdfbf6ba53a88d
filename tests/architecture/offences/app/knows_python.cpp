#include <pybind11/pybind11.h>
#include <toml++/toml.h>

#include <boresight/design/tuner.hpp>
#include <boresight/python/bindings.hpp>

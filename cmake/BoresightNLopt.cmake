# Debian packs NLopt twice, with and without its C++ solvers; both packages answer to
# find_package(NLopt), each with another target name, and which one is found depends on the order
# of a folder listing. Either will do, and one may be found here and the other by a user of the
# installed package: both names are made known.
if(TARGET NLopt::nlopt AND NOT TARGET NLopt::nlopt_cxx)
  add_library(NLopt::nlopt_cxx ALIAS NLopt::nlopt)
elseif(TARGET NLopt::nlopt_cxx AND NOT TARGET NLopt::nlopt)
  add_library(NLopt::nlopt ALIAS NLopt::nlopt_cxx)
endif()

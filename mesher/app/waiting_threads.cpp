// How OpenMP's threads wait, said before its library starts: linked into `cbc3d` where that library is linked
// in too (see CMakeLists.txt). Elsewhere main() starts the program once more, which loads all its libraries
// twice.
#include "mesher/core/runtime.hpp"

namespace {
/// Constructors with a priority run before those without, which GCC's OpenMP is one of; 101 is the first that
/// is free.
[[gnu::constructor(101)]] void before_openmp_starts() {
  cbc3d::choose_sleeping_waits();
}
}  // namespace

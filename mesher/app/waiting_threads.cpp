// Sets how OpenMP's threads wait before its library starts. It is linked into `cbc3d` where that library is
// linked in too (see CMakeLists.txt); elsewhere main() starts the program once more, which loads all its
// libraries twice.
#include "mesher/core/runtime.hpp"

namespace {
/// Constructors with a priority run before those without, such as that of GCC's OpenMP; 101 is the first free
/// one.
[[gnu::constructor(101)]] void before_openmp_starts() {
  cbc3d::choose_sleeping_waits();
}
}  // namespace

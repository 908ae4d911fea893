// Debian's ITK, which GCC built, refuses every other compiler, so its header is read first under GCC's name.
// Read by force, before all else, by clang-tidy (ci/tidy) and by clang (ci/fuzz).
#pragma once
#if __has_include(<itk_compiler_detection.h>)
#pragma push_macro("__clang__")
#pragma push_macro("__GNUC__")
#undef __clang__
#undef __GNUC__
#define __GNUC__ 12
#include <itk_compiler_detection.h>
#pragma pop_macro("__GNUC__")
#pragma pop_macro("__clang__")
#endif

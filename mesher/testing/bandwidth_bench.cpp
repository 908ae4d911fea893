// This machine's memory bandwidth, to which the kernels are compared: bytes are what a kernel must at least
// move, its arrays read and written once.
#include "mesher/testing/bandwidth.hpp"

namespace cbc3d::bench {
namespace {

BENCHMARK(stream_copy)->Name("KernelStreamCopy")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(stream_triad)->Name("KernelStreamTriad")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace cbc3d::bench

BENCHMARK_MAIN();

#include "mesher/lattice/lattice.hpp"

#include <atomic>

namespace cbc3d {
namespace {
constexpr std::uint64_t kEmpty = ~0ULL;
constexpr std::size_t kFirstCapacity = 1U << 12U;
}  // namespace

std::uint64_t VertexTable::key_of(const LatticePoint& point) {
  return (static_cast<std::uint64_t>(point[2]) << 42U) | (static_cast<std::uint64_t>(point[1]) << 21U) |
         static_cast<std::uint64_t>(point[0]);
}

std::size_t VertexTable::first_slot_of(std::uint64_t key) const {
  // Coordinates of coarse vertices are multiples of high powers of two: mix upwards and downwards, twice.
  std::uint64_t h = key ^ (key >> 32U);
  h *= 0x9E3779B97F4A7C15ULL;
  h ^= h >> 29U;
  h *= 0xBF58476D1CE4E5B9ULL;
  h ^= h >> 32U;
  return h & (slots_.size() - 1);
}

std::size_t VertexTable::slot_of(std::uint64_t key) const {
  std::size_t slot = first_slot_of(key);
  while (slots_[slot].key != kEmpty && slots_[slot].key != key) {
    slot = (slot + 1) & (slots_.size() - 1);
  }
  return slot;
}

VertexId VertexTable::find(const LatticePoint& point) const {
  if (slots_.empty()) {
    return kNoVertex;
  }
  const Slot& slot = slots_[slot_of(key_of(point))];
  return slot.key == kEmpty ? kNoVertex : slot.vertex;
}

VertexId VertexTable::find_or_insert(const LatticePoint& point, VertexId next) {
  if (2 * (count_ + 1) > slots_.size()) {
    grow();
  }
  const std::uint64_t key = key_of(point);
  Slot& slot = slots_[slot_of(key)];
  if (slot.key == kEmpty) {
    slot = {key, next};
    ++count_;
  }
  return slot.vertex;
}

void VertexTable::reserve(std::size_t more) {
  while (2 * count_ > slots_.size() || 4 * (count_ + more) > 3 * slots_.size()) {
    grow();
  }
}

std::uint32_t VertexTable::claim(const LatticePoint& point, VertexId number) {
  const std::uint64_t key = key_of(point);
  std::size_t slot = first_slot_of(key);
  for (;; slot = (slot + 1) & (slots_.size() - 1)) {
    const std::atomic_ref<std::uint64_t> there(slots_[slot].key);
    std::uint64_t found = there.load(std::memory_order_relaxed);
    if (found == key ||
        (found == kEmpty &&
         (there.compare_exchange_strong(found, key, std::memory_order_relaxed) || found == key))) {
      break;
    }
  }
  const std::atomic_ref<VertexId> vertex(slots_[slot].vertex);
  VertexId least = vertex.load(std::memory_order_relaxed);
  while (number < least && !vertex.compare_exchange_weak(least, number, std::memory_order_relaxed)) {
  }
  return static_cast<std::uint32_t>(slot);
}

void VertexTable::grow() {
  std::vector<Slot> old(slots_.empty() ? kFirstCapacity : 2 * slots_.size(), Slot{kEmpty, kNoVertex});
  old.swap(slots_);
  for (const Slot& slot : old) {
    if (slot.key != kEmpty) {
      slots_[slot_of(slot.key)] = slot;
    }
  }
}

VertexId Lattice::vertex_at(const LatticePoint& point) {
  const VertexId vertex = table.find_or_insert(point, static_cast<VertexId>(points.size()));
  if (vertex == points.size()) {
    points.push_back(point);
    split_below.push_back(0);
  }
  return vertex;
}

std::vector<Vec3> local_points(const Lattice& lattice) {
  std::vector<Vec3> points;
  append_local_points(lattice, points);
  return points;
}

void append_local_points(const Lattice& lattice, std::vector<Vec3>& points) {
  const std::size_t known = points.size();
  points.resize(lattice.points.size());
#pragma omp parallel for schedule(static)
  for (std::size_t v = known; v < points.size(); ++v) {
    points[v] = lattice.frame.local(lattice.points[v]);
  }
}

}  // namespace cbc3d

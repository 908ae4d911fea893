#include "mesher/deform/block_matrix.hpp"

#include <algorithm>
#include <cmath>

namespace cbc3d {
namespace {

/// Rows that one thread works on at a time; sums are made in these chunks, then over the chunks in order.
constexpr std::size_t kChunk = 256;

std::size_t chunks_of(std::size_t count) {
  return (count + kChunk - 1) / kChunk;
}

/// Finds a vertex and those that share a cell with it.
class RowFinder {
 public:
  RowFinder(const MaterialMesh& mesh, const VertexCells& around)
      : mesh_(mesh), around_(around), last_row_(mesh.points.size(), kNoVertex) {}

  void append_row(VertexId v, std::vector<VertexId>& columns) {
    last_row_[v] = v;
    columns.push_back(v);
    for (const CellId c : around_.of(v)) {
      for (const VertexId n : mesh_.nodes_of(c)) {
        if (last_row_[n] != v) {
          last_row_[n] = v;
          columns.push_back(n);
        }
      }
    }
  }

 private:
  const MaterialMesh& mesh_;
  const VertexCells& around_;
  std::vector<VertexId> last_row_;  ///< of a vertex: the last row that has it
};

/// Lane 3 set to zero.
Float4 only_xyz(const Float4& a) {
  using Bits = std::int32_t __attribute__((vector_size(16)));
  constexpr Bits kMask = {-1, -1, -1, 0};
  return Float4(reinterpret_cast<Float4::Lanes>(reinterpret_cast<Bits>(a.lanes) & kMask));
}

/// Adds up products of 3-vectors, each lane in double.
class DotSum {
 public:
  void add(const Float4& a, const Float4& b) { sum_ += __builtin_convertvector((a * b).lanes, Doubles); }
  [[nodiscard]] double total() const { return sum_[0] + sum_[1] + sum_[2]; }

 private:
  using Doubles = double __attribute__((vector_size(32)));
  Doubles sum_{};
};

double sum_of(const std::vector<double>& partial) {
  double sum = 0;
  for (const double p : partial) {
    sum += p;
  }
  return sum;
}

/// The vectors of the method (p the search direction, q = A p) and its sums by chunks.
class ConjugateGradients {
 public:
  ConjugateGradients(const BlockMatrix& matrix, const std::vector<Vec3>& load, std::vector<Vec3>& start)
      : matrix_(matrix),
        count_(load.size()),
        u_(count_),
        r_(count_),
        z_(count_),
        p_(count_),
        q_(count_),
        pq_(chunks_of(count_)),
        rz_(chunks_of(count_)),
        rr_(chunks_of(count_)),
        ll_(chunks_of(count_)) {
    begin(load, start);
  }

  SolveReport run(const SolveOptions& options) {
    SolveReport report;
    const double scale = std::sqrt(sum_of(ll_));
    report.relative_residual = scale > 0 ? std::sqrt(sum_of(rr_)) / scale : 0;
    double rz = sum_of(rz_);
    while (report.iterations < options.max_iterations && report.relative_residual > options.tolerance) {
      rz = iterate(rz);
      report.relative_residual = std::sqrt(sum_of(rr_)) / scale;
      ++report.iterations;
    }
    return report;
  }

  void copy_solution(std::vector<Vec3>& u) const {
#pragma omp parallel for schedule(static)
    for (std::size_t v = 0; v < count_; ++v) {
      u[v] = u_[v].xyz();
    }
  }

 private:
  /// Calls visit(first, last, chunk) for every chunk of rows, in parallel.
  template <typename Visit>
  void for_chunks(const Visit& visit) const {
    const std::size_t chunks = chunks_of(count_);
#pragma omp for schedule(static)
    for (std::size_t c = 0; c < chunks; ++c) {
      visit(c * kChunk, std::min(count_, (c + 1) * kChunk), c);
    }
  }

  void begin(const std::vector<Vec3>& load, const std::vector<Vec3>& start) {
    const bool from_zero = std::all_of(start.begin(), start.end(), [](const Vec3& u) { return u == Vec3{}; });
#pragma omp parallel
    {
      if (!from_zero) {
        for_chunks([&](std::size_t first, std::size_t last, std::size_t) {
          for (std::size_t v = first; v < last; ++v) {
            u_[v] = Float4(start[v]);
          }
        });
      }
      for_chunks([&](std::size_t first, std::size_t last, std::size_t chunk) {
        DotSum ll;
        for (std::size_t v = first; v < last; ++v) {
          const Float4 l(load[v]);
          r_[v] = from_zero ? l : l - matrix_.row_times(static_cast<VertexId>(v), u_);
          ll.add(l, l);
        }
        ll_[chunk] = ll.total();
        precondition(first, last, chunk);
        std::copy(z_.begin() + static_cast<std::ptrdiff_t>(first),
                  z_.begin() + static_cast<std::ptrdiff_t>(last),
                  p_.begin() + static_cast<std::ptrdiff_t>(first));
      });
    }
  }

  void precondition(std::size_t first, std::size_t last, std::size_t chunk) {
    DotSum rz;
    DotSum rr;
    for (std::size_t v = first; v < last; ++v) {
      z_[v] = matrix_.precondition(static_cast<VertexId>(v), r_[v]);
      rz.add(r_[v], z_[v]);
      rr.add(r_[v], r_[v]);
    }
    rz_[chunk] = rz.total();
    rr_[chunk] = rr.total();
  }

  /// One step along p; the next p. Returns r z.
  double iterate(double rz) {
    double next_rz = 0;
#pragma omp parallel
    {
      for_chunks([&](std::size_t first, std::size_t last, std::size_t chunk) {
        DotSum pq;
        for (std::size_t v = first; v < last; ++v) {
          q_[v] = matrix_.row_times(static_cast<VertexId>(v), p_);
          pq.add(p_[v], q_[v]);
        }
        pq_[chunk] = pq.total();
      });
      const auto alpha = static_cast<float>(rz / sum_of(pq_));
      for_chunks([&](std::size_t first, std::size_t last, std::size_t chunk) {
        for (std::size_t v = first; v < last; ++v) {
          u_[v] += alpha * p_[v];
          r_[v] -= alpha * q_[v];
        }
        precondition(first, last, chunk);
      });
      const double next = sum_of(rz_);
      const auto beta = static_cast<float>(next / rz);
      for_chunks([&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t v = first; v < last; ++v) {
          p_[v] = z_[v] + beta * p_[v];
        }
      });
#pragma omp master
      next_rz = next;
    }
    return next_rz;
  }

  const BlockMatrix& matrix_;
  std::size_t count_;
  std::vector<Float4> u_, r_, z_, p_, q_;
  std::vector<double> pq_, rz_, rr_, ll_;  ///< of chunks
};

}  // namespace

Columns3 inverse_of(const Columns3& m) {
  const Vec3 a = m.c[0].xyz();
  const Vec3 b = m.c[1].xyz();
  const Vec3 c = m.c[2].xyz();
  const Vec3 bc = b.cross(c);
  const double det = a.dot(bc);
  Columns3 inverse;
  if (!(det > 0)) {
    inverse.c[0] = Float4(1, 0, 0, 0);
    inverse.c[1] = Float4(0, 1, 0, 0);
    inverse.c[2] = Float4(0, 0, 1, 0);
    return inverse;
  }
  const Float4 rows[3] = {Float4((1 / det) * bc), Float4((1 / det) * c.cross(a)),
                          Float4((1 / det) * a.cross(b))};
  transpose(rows, inverse.c);
  return {only_xyz(inverse.c[0]), only_xyz(inverse.c[1]), only_xyz(inverse.c[2])};
}

BlockMatrix::BlockMatrix(const MaterialMesh& mesh, const VertexCells& around) {
  const std::size_t count = mesh.points.size();
  first_.assign(count + 1, 0);
  inverse_diagonal_.resize(count);
  std::vector<std::vector<VertexId>> columns(chunks_of(count));
#pragma omp parallel
  {
    RowFinder finder(mesh, around);
#pragma omp for schedule(static)
    for (std::size_t c = 0; c < columns.size(); ++c) {
      columns[c].reserve(16 * kChunk);
      for (std::size_t v = c * kChunk; v < std::min(count, (c + 1) * kChunk); ++v) {
        const std::size_t before = columns[c].size();
        finder.append_row(static_cast<VertexId>(v), columns[c]);
        first_[v + 1] = columns[c].size() - before;
      }
    }
  }
  for (std::size_t v = 0; v < count; ++v) {
    first_[v + 1] += first_[v];
  }
  column_.resize(first_[count]);
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::copy(columns[c].begin(), columns[c].end(),
              column_.begin() + static_cast<std::ptrdiff_t>(first_[c * kChunk]));
    columns[c] = {};
  }
  // Not filled: whatever thread sets a row first gets its memory.
  values_ = std::make_unique_for_overwrite<float[]>(9 * column_.size() + 1);
  values_[9 * column_.size()] = 0;
}

Float4 BlockMatrix::row_times(VertexId v, const std::vector<Float4>& x) const {
  Float4 sum[3]{};
  const float* block = values_.get() + 9 * first_[v];
  for (const VertexId column : columns(v)) {
    const Float4& at = x[column];
    sum[0] += spread<0>(at) * Float4::load(block);
    sum[1] += spread<1>(at) * Float4::load(block + 3);
    sum[2] += spread<2>(at) * Float4::load(block + 6);
    block += 9;
  }
  return only_xyz(sum[0] + sum[1] + sum[2]);
}

SolveReport solve(const BlockMatrix& matrix, const std::vector<Vec3>& load, const SolveOptions& options,
                  std::vector<Vec3>& u) {
  ConjugateGradients method(matrix, load, u);
  const SolveReport report = method.run(options);
  method.copy_solution(u);
  return report;
}

}  // namespace cbc3d

#include "mesher/topology/vertex_star.hpp"

#include <algorithm>

namespace cbc3d {

void VertexStar::load(VertexId vertex, const std::vector<ClassId>& class_of_tet, ClassId outside) {
  const TetId* const begin = around_.cells.data() + around_.first[vertex];
  const TetId* const end = around_.cells.data() + around_.first[vertex + 1];
  members_.assign(begin, end);
  classes_.clear();
  adjacent_.assign(members_.size(), {});
  const auto outside_member = static_cast<std::int16_t>(members_.size());
  bool open = false;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const TetId t = members_[i];
    classes_.push_back(class_of_tet[t]);
    std::size_t face = 0;
    for (std::size_t n = 0; n < 4; ++n) {
      if (tets_[t][n] != vertex) {  // the face opposite to another node holds the vertex
        const TetId across = neighbours_[t][n];
        open = open || across == kNoTet;
        adjacent_[i][face++] = across == kNoTet
                                   ? outside_member
                                   : static_cast<std::int16_t>(std::lower_bound(begin, end, across) - begin);
      }
    }
  }
  if (open) {
    members_.push_back(kNoTet);
    classes_.push_back(outside);
  }
  distinct_ = classes_;
  std::sort(distinct_.begin(), distinct_.end());
  distinct_.erase(std::unique(distinct_.begin(), distinct_.end()), distinct_.end());
}

int VertexStar::split(ClassId of, bool inside) {
  piece_.assign(members_.size(), -1);
  int pieces = 0;
  const auto belongs = [&](std::size_t i) { return (classes_[i] == of) == inside; };
  const auto visit = [&](std::size_t i) {
    if (piece_[i] < 0 && belongs(i)) {
      piece_[i] = pieces;
      stack_.push_back(static_cast<std::int16_t>(i));
    }
  };
  for (std::size_t start = 0; start < members_.size(); ++start) {
    if (piece_[start] >= 0 || !belongs(start)) {
      continue;
    }
    visit(start);
    while (!stack_.empty()) {
      const auto i = static_cast<std::size_t>(stack_.back());
      stack_.pop_back();
      if (i < adjacent_.size()) {
        for (const std::int16_t n : adjacent_[i]) {
          visit(static_cast<std::size_t>(n));
        }
      } else {  // the outside touches every member with an open face
        for (std::size_t m = 0; m < adjacent_.size(); ++m) {
          if (std::find(adjacent_[m].begin(), adjacent_[m].end(), static_cast<std::int16_t>(i)) !=
              adjacent_[m].end()) {
            visit(m);
          }
        }
      }
    }
    ++pieces;
  }
  return pieces;
}

}  // namespace cbc3d
